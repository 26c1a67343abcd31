// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/contact_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/core/complex.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/rom/reduced_model.hpp"

namespace rondo::rom {

using Eigen::Index;
using Eigen::MatrixXd;

double contact_weight(double distance, int stride) noexcept {
  return std::max(0.0, 1.0 - std::abs(distance) / stride) / stride;
}

MatrixXd between_weights(int n_sectors, int phases) {
  RONDO_DEMAND(n_sectors > 0 && phases > 0, n_sectors, phases);
  MatrixXd weights = MatrixXd::Zero(n_sectors, static_cast<Index>(n_sectors) * phases);
  for (Index k = 0; k < weights.cols(); ++k) {
    const double part = static_cast<double>(k % phases) / phases;
    weights(k / phases, k) = 1.0 - part;
    if (part > 0.0) weights((k / phases + 1) % n_sectors, k) = part;
  }
  return weights;
}

MatrixXd hat_weights(int n_sectors, int stride) {
  RONDO_DEMAND(stride > 0 && n_sectors % stride == 0, n_sectors, stride);
  MatrixXd weights = MatrixXd::Zero(n_sectors, n_sectors / stride);
  for (Index k = 0; k < weights.cols(); ++k)
    for (int d = 1 - stride; d < stride; ++d)
      weights((k * stride + d + n_sectors) % n_sectors, k) += contact_weight(d, stride);
  return weights;
}

namespace {

/// The two neighbours of each of m points in order around a closed boundary.
std::vector<std::array<int, 2>> beside_in_ring(int m) {
  std::vector<std::array<int, 2>> beside;
  for (int k = 0; k < m; ++k) beside.push_back({(k + m - 1) % m, (k + 1) % m});
  return beside;
}

/// The two neighbours of each candidate, in the order of the rings.
std::vector<std::array<int, 2>> beside_in(const mesh::Mesh& mesh, const pod::Rings& rings) {
  std::vector<int> place(mesh.n_nodes(), -1);
  std::vector<std::array<int, 2>> beside(rings.point.size(), {-1, -1});
  for (std::size_t k = 0; k < rings.point.size(); ++k)
    place[static_cast<std::size_t>(mesh.boundary[static_cast<std::size_t>(rings.point[k])])] =
        static_cast<int>(k);
  for (const auto& [a, b] : mesh.contact_edges) {
    const int from = place[static_cast<std::size_t>(a)], to = place[static_cast<std::size_t>(b)];
    beside[static_cast<std::size_t>(from)][1] = to;
    beside[static_cast<std::size_t>(to)][0] = from;
  }
  return beside;
}

/// Point k · phases + j is the position j / phases of a sector after that of sector k.
ContactRows rows_between(const mesh::Mesh& mesh, const ReducedModel& model) {
  const Index n = mesh.n_sectors, phases = model.weights.cols() / n;
  NodeRows nodes(mesh, model);
  const auto points = static_cast<std::size_t>(n * phases);
  ContactRows out{MatrixXd(2 * n * phases, model.size()), std::vector<Vec2>(points),
                  std::vector<double>(points), beside_in_ring(static_cast<int>(points))};
  const double sector = 2.0 * std::numbers::pi / static_cast<double>(n);
  for (Index j = 0; j < phases; ++j) {
    const ContactRows at = nodes.at(sector * static_cast<double>(j) / static_cast<double>(phases));
    for (Index k = 0; k < n; ++k) {
      const Index to = k * phases + j;
      const auto point = static_cast<std::size_t>(to), from = static_cast<std::size_t>(k);
      out.rows.middleRows(2 * to, 2) = at.rows.middleRows(2 * k, 2);
      out.points[point] = at.points[from];
      out.share[point] = at.share[from] / static_cast<double>(phases);
    }
  }
  return out;
}

}  // namespace

ContactRows standing_rows(const mesh::Mesh& mesh, const ReducedModel& model) {
  if (model.weights.cols() > mesh.n_sectors) return rows_between(mesh, model);
  const pod::Rings ring = pod::boundary_rings(mesh);
  RONDO_DEMAND(ring.n_rings() == 1 && model.weights.rows() == mesh.n_sectors, ring.n_rings(),
               model.weights.rows());
  const auto points = static_cast<std::size_t>(model.weights.cols());
  ContactRows out{MatrixXd::Zero(2 * model.weights.cols(), model.size()), std::vector<Vec2>(points),
                  std::vector<double>(points), beside_in_ring(static_cast<int>(points))};
  // A sector that contributes to k points counts in each of them with its part.
  const Eigen::VectorXd all = model.weights.rowwise().sum();
  for (std::size_t k = 0; k < points; ++k)
    for (int sector = 0; sector < mesh.n_sectors; ++sector) {
      const auto column = static_cast<Index>(k);
      const double weight = model.weights(sector, column);
      if (weight == 0.0) continue;
      const auto candidate = static_cast<std::size_t>(ring.point[static_cast<std::size_t>(sector)]);
      const auto node = static_cast<std::size_t>(mesh.boundary[candidate]);
      out.rows.middleRows(2 * column, 2) +=
          weight * model.basis.middleRows(static_cast<Index>(2 * node), 2);
      out.points[k] += weight * mesh.coordinates[node];
      out.share[k] += weight / all[sector] * mesh.tributary[candidate];
    }
  return out;
}

NodeRows::NodeRows(const mesh::Mesh& mesh, const ReducedModel& model)
    : mesh_(mesh),
      model_(model),
      rings_(pod::boundary_rings(mesh)),
      beside_(beside_in(mesh, rings_)),
      rectifier_(rings_.n_sectors, rings_.n_rings() * static_cast<std::size_t>(model.size()),
                 pod::Components::cartesian, pod::Shift::fourier),
      modes_(static_cast<Index>(2 * rings_.point.size()), model.size()) {
  RONDO_DEMAND(rings_.point.size() == mesh.boundary.size(), rings_.point.size(),
               mesh.boundary.size());
  for (std::size_t k = 0; k < rings_.point.size(); ++k) {
    const Index node = mesh.boundary[static_cast<std::size_t>(rings_.point[k])];
    modes_.middleRows(static_cast<Index>(2 * k), 2) = model.basis.middleRows(2 * node, 2);
  }
}

ContactRows NodeRows::at(double phase) {
  const std::size_t m = rings_.point.size();
  const bool moves = model_.frame == ModelFrame::rectified && phase != 0.0;
  const Complex turned = moves ? rotation(phase) : Complex{1.0, 0.0};
  ContactRows out{modes_, std::vector<Vec2>(m), std::vector<double>(m), beside_};
  for (std::size_t k = 0; k < m; ++k) {
    const auto candidate = static_cast<std::size_t>(rings_.point[k]);
    out.points[k] = turned * mesh_.coordinates[static_cast<std::size_t>(mesh_.boundary[candidate])];
    out.share[k] = mesh_.tributary[candidate];
  }
  if (!moves) return out;
  const std::span<Vec2> values(reinterpret_cast<Vec2*>(out.rows.data()),
                               static_cast<std::size_t>(out.rows.size() / 2));
  rectifier_.apply(-phase, values);  // mode after mode, ring after ring
  for (Vec2& v : values) v = turned * v;
  return out;
}

}  // namespace rondo::rom
