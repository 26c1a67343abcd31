// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/reduced_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/pod/dense.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::span<Vec2> as_field(double* numbers, Index rows) {
  return {reinterpret_cast<Vec2*>(numbers), static_cast<std::size_t>(rows / 2)};
}

/// Reorders a field ring by ring, calls the function, and restores the order.
template <class Change>
void in_rings(const pod::Rings& rings, std::span<Vec2> field, std::vector<Vec2>& ordered,
              Change&& change) {
  for (std::size_t i = 0; i < ordered.size(); ++i) ordered[i] = field[at(rings.point[i])];
  change(std::span<Vec2>(ordered));
  for (std::size_t i = 0; i < ordered.size(); ++i) field[at(rings.point[i])] = ordered[i];
}

MatrixXd skew_part(const MatrixXd& a) {
  return 0.5 * (a - a.transpose());
}

/// A uniform field or the positions of the nodes, each column multiplied by √M.
VectorXd weighted_field(std::span<const Vec2> field, const VectorXd& roots) {
  VectorXd out(roots.size());
  for (Index i = 0; i < out.size() / 2; ++i) {
    const Vec2 v = field[at(i)];
    out[2 * i] = roots[2 * i] * v.x;
    out[2 * i + 1] = roots[2 * i + 1] * v.y;
  }
  return out;
}

MatrixXd rows_of(const MatrixXd& basis, const std::vector<int>& nodes) {
  MatrixXd rows(static_cast<Index>(2 * nodes.size()), basis.cols());
  for (std::size_t k = 0; k < nodes.size(); ++k)
    rows.middleRows(static_cast<Index>(2 * k), 2) = basis.middleRows(Index{2} * nodes[k], 2);
  return rows;
}

}  // namespace

VectorXd mass_roots(std::span<const double> mass) {
  VectorXd roots(static_cast<Index>(2 * mass.size()));
  for (std::size_t i = 0; i < mass.size(); ++i)
    roots.segment(static_cast<Index>(2 * i), 2).setConstant(std::sqrt(mass[i]));
  return roots;
}

MatrixXd differentiate(const mesh::Mesh& mesh, const MatrixXd& fields) {
  const pod::Rings rings = pod::node_rings(mesh);
  RONDO_DEMAND(rings.n_sectors > 0 && fields.rows() == static_cast<Index>(2 * mesh.n_nodes()),
               rings.n_sectors, fields.rows());
  pod::Rectifier rectifier(rings.n_sectors, rings.n_rings(), pod::Components::cartesian,
                           pod::Shift::fourier);
  MatrixXd out = fields;
  std::vector<Vec2> ordered(mesh.n_nodes());
  for (Index j = 0; j < out.cols(); ++j)
    in_rings(rings, as_field(out.col(j).data(), out.rows()), ordered,
             [&](std::span<Vec2> values) { rectifier.differentiate(values); });
  return out;
}

MatrixXd join(std::span<const MatrixXd> parts, double dependent) {
  RONDO_DEMAND(!parts.empty());
  Index columns = 0, rank = 0;
  for (const MatrixXd& part : parts) columns += part.cols();
  MatrixXd q(parts.front().rows(), columns);
  for (const MatrixXd& part : parts)
    for (Index j = 0; j < part.cols(); ++j) {
      VectorXd v = part.col(j);
      const double norm = v.norm();
      for (int twice = 0; twice < 2; ++twice)
        v -= q.leftCols(rank) * (q.leftCols(rank).transpose() * v);
      const double left = v.norm();
      if (!(left > dependent * norm)) continue;
      v /= left;  // again: a vector nearly in the span of the others is not yet orthogonal
      v -= q.leftCols(rank) * (q.leftCols(rank).transpose() * v);
      q.col(rank++) = v / v.norm();
    }
  return q.leftCols(rank);
}

ReducedModel make_reduced_model(const FullModel& full, const MatrixXd& weighted, ModelFrame frame) {
  const auto n = static_cast<Index>(full.mesh.n_nodes());
  RONDO_DEMAND(weighted.rows() == 2 * n && full.mass.size() == full.mesh.n_nodes(), weighted.rows(),
               n, full.mass.size());
  const VectorXd roots = mass_roots(full.mass);
  ReducedModel m;
  m.n_sectors = full.mesh.n_sectors;
  m.frame = frame;
  m.basis = roots.cwiseInverse().asDiagonal() * weighted;
  MatrixXd of_basis(2 * n, m.size());
  for (Index j = 0; j < m.size(); ++j)
    full.stiffness(as_field(m.basis.col(j).data(), 2 * n), as_field(of_basis.col(j).data(), 2 * n));
  m.stiffness = m.basis.transpose() * of_basis;
  m.stiffness = 0.5 * (m.stiffness + m.stiffness.transpose()).eval();
  m.generator.setZero(m.size(), m.size());
  if (frame == ModelFrame::rectified)
    m.generator =
        skew_part(weighted.transpose() * (roots.asDiagonal() * differentiate(full.mesh, m.basis)));
  MatrixXd turned(2 * n, m.size());
  for (Index i = 0; i < n; ++i) {
    turned.row(2 * i) = -weighted.row(2 * i + 1);
    turned.row(2 * i + 1) = weighted.row(2 * i);
  }
  m.turn = skew_part(weighted.transpose() * turned);
  std::vector<Vec2> field = full.mesh.coordinates;
  m.reference = weighted.transpose() * weighted_field(field, roots);
  for (Vec2& x : field) x = turn90(x);
  m.turned_reference = weighted.transpose() * weighted_field(field, roots);
  m.translation.resize(m.size(), 2);
  for (Index k = 0; k < 2; ++k) {
    std::fill(field.begin(), field.end(), k == 0 ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0});
    m.translation.col(k) = weighted.transpose() * weighted_field(field, roots);
  }
  return m;
}

void set_contact(const mesh::Mesh& mesh, ContactForm form, MatrixXd weights, ReducedModel& model) {
  model.form = form;
  model.weights = std::move(weights);
  model.contact = form == ContactForm::nodes ? ContactRows{} : standing_rows(mesh, model);
}

Lift::Lift(const mesh::Mesh& mesh, const ReducedModel& model)
    : Lift(model.basis, model.frame, pod::node_rings(mesh)) {}

Lift::Lift(const MatrixXd& basis, ModelFrame frame, pod::Rings rings)
    : basis_(basis),
      moves_(frame == ModelFrame::rectified),
      rings_(std::move(rings)),
      rectifier_(rings_.n_sectors, rings_.n_rings(), pod::Components::cartesian,
                 pod::Shift::fourier),
      ordered_(rings_.point.size()),
      field_(basis.rows()) {}

void Lift::lift(double theta, const VectorXd& q, std::span<Vec2> out) {
  // By the library, which adapts to the processor: this product is most of the cost of a snapshot.
  const OneBlasThread one;
  pod::multiply(basis_, q, field_);
  const std::span<Vec2> rectified = as_field(field_.data(), field_.size());
  std::copy(rectified.begin(), rectified.end(), out.begin());
  if (moves_)
    in_rings(rings_, out, ordered_,
             [&](std::span<Vec2> values) { rectifier_.apply(-theta, values); });
}

VectorXd Lift::restrict_to_modes(double theta, std::span<const Vec2> field,
                                 std::span<const double> mass) {
  const std::span<Vec2> rectified = as_field(field_.data(), field_.size());
  std::copy(field.begin(), field.end(), rectified.begin());
  if (moves_)
    in_rings(rings_, rectified, ordered_,
             [&](std::span<Vec2> values) { rectifier_.apply(theta, values); });
  for (std::size_t i = 0; i < mass.size(); ++i) rectified[i] = mass[i] * rectified[i];
  return basis_.transpose() * field_;
}

BoundaryLift::BoundaryLift(const mesh::Mesh& mesh, const ReducedModel& model)
    : boundary_(mesh.boundary),
      basis_(rows_of(model.basis, mesh.boundary)),
      lift_(basis_, model.frame, pod::boundary_rings(mesh)),
      values_(mesh.boundary.size()) {}

void BoundaryLift::lift(double theta, const VectorXd& q, std::span<Vec2> u) {
  lift_.lift(theta, q, values_);
  for (std::size_t k = 0; k < values_.size(); ++k) u[at(boundary_[k])] = values_[k];
}

}  // namespace rondo::rom
