// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/latin/pgd.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/dense.hpp"
#include "rondo/core/index.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double share_left = 0.3;  ///< of the load that modes may leave out, over the indicator
constexpr int most_added = 3;       ///< an iteration

/// Eigenvector of the largest eigenvalue, by its powers. @pre symmetric, positive semidefinite
VectorXd dominant(const MatrixXd& s) {
  constexpr int most_powers = 200;
  constexpr double close = 1e-6;
  Index largest = 0;
  s.diagonal().maxCoeff(&largest);
  VectorXd v = s.col(largest).normalized(), next(v.size());
  for (int k = 0; k < most_powers; ++k) {
    next.noalias() = s * v;
    next.normalize();
    const double change = (next - v).norm();
    v.swap(next);
    if (change <= close) break;
  }
  return v;
}

void append_column(MatrixXd& m, const VectorXd& column) {
  m.conservativeResize(column.size(), m.cols() + 1);
  m.rightCols(1) = column;
}

/// H u of each node of `nodes`.
VectorXd on_contact(const VectorXd& field, const std::vector<int>& nodes) {
  VectorXd h(static_cast<Index>(2 * nodes.size()));
  for (std::size_t j = 0; j < nodes.size(); ++j)
    h.segment<2>(static_cast<Index>(2 * j)) << field[2 * nodes[j] + 1], -field[2 * nodes[j]];
  return h;
}

}  // namespace

Fields orthonormal(const Fields& fields) {
  constexpr double dependent = 1e-12;
  const MatrixXd work = fields.contact.transpose() * fields.load;
  const VectorXd scale = work.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd even = scale.asDiagonal() * (0.5 * (work + work.transpose())) * scale.asDiagonal();
  const auto [values, vectors] = axes_of(even);
  Index kept = 0;
  for (const double value : values) kept += value > dependent * values[values.size() - 1] ? 1 : 0;
  const MatrixXd turn = scale.asDiagonal() * vectors.rightCols(kept) *
                        values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  return {fields.field * turn, fields.contact * turn, fields.load * turn};
}

Pgd::Pgd(const Condensation& stiffened, std::vector<int> nodes, const PgdOptions& options)
    : body_(stiffened), nodes_(std::move(nodes)), options_(options) {
  RONDO_DEMAND(options.direction > 0.0 && options.downsizing >= 0.0, options.direction);
  const auto rows = static_cast<Index>(2 * nodes_.size());
  contact_.resize(rows, 0);
  load_.resize(rows, 0);
  solved_.contact.resize(rows, 0);
  solved_.load.resize(rows, 0);
  rotation_.resize(0, 0);
}

void Pgd::begin_with(const Fields& fields) {
  RONDO_DEMAND(rotation_.cols() == 0 && fields.contact.rows() == contact_.rows(), rotation_.cols(),
               fields.contact.rows());
  take_all(fields);
}

/// As modes, of which none goes any more.
void Pgd::take_all(const Fields& fields) {
  solved_ = orthonormal(fields);
  contact_ = solved_.contact;
  load_ = solved_.load;
  rotation_ = MatrixXd::Identity(contact_.cols(), contact_.cols());
  keeps_all_ = true;
  most_modes_ = modes();
}

void Pgd::append(const VectorXd& field, const VectorXd& load) {
  append_column(solved_.field, field);
  append_column(solved_.contact, on_contact(field, nodes_));
  append_column(solved_.load, load);
  const MatrixXd before = rotation_;
  rotation_ = MatrixXd::Zero(before.rows() + 1, before.cols() + 1);
  rotation_.topLeftCorner(before.rows(), before.cols()) = before;
}

/// A φ = Hᵀ load, made orthonormal to the modes.
void Pgd::add_mode(const VectorXd& load) {
  std::vector<Vec2> force(body_.n_nodes());
  for (std::size_t j = 0; j < nodes_.size(); ++j)
    force[at(nodes_[j])] = {-load[static_cast<Index>(2 * j) + 1], load[static_cast<Index>(2 * j)]};
  const std::vector<Vec2> found = body_.displacement(force);
  ++solves_;
  VectorXd field(static_cast<Index>(2 * found.size()));
  for (std::size_t i = 0; i < found.size(); ++i)
    field.segment<2>(static_cast<Index>(2 * i)) << found[i].x, found[i].y;
  append(field, load);
  VectorXd contact = solved_.contact.rightCols(1), rest = load;
  VectorXd turn = VectorXd::Zero(rotation_.rows());
  turn[rotation_.rows() - 1] = 1.0;
  const Index modes = contact_.cols();
  for (int pass = 0; pass < 2; ++pass) {  // once more for what round-off leaves
    const VectorXd part = load_.transpose() * contact;
    contact -= contact_ * part;
    rest -= load_ * part;
    turn -= rotation_.leftCols(modes) * part;
  }
  const double length = std::sqrt(contact.dot(rest));
  append_column(contact_, contact / length);
  append_column(load_, rest / length);
  rotation_.rightCols(1) = turn / length;
}

void Pgd::enrich(const MatrixXd& load, double indicator) {
  MatrixXd left = load - load_ * temporal_.transpose();
  // Where the pairs have met and the iterations still go on, it is the modes that the laws lack.
  const bool met = indicator < 0.1 * options_.tolerance;
  const double least = met ? indicator : share_left * options_.tolerance;
  const double allowed = share_left * std::max(indicator, least) * load.norm();
  MatrixXd squares;
  for (int added = 0;
       added < most_added && left.norm() > allowed && contact_.cols() < contact_.rows(); ++added) {
    if (added == 0) squares = left * left.transpose();
    add_mode(dominant(squares));
    const VectorXd f = load_.rightCols(1);
    const VectorXd psi = load.transpose() * contact_.rightCols(1);
    const VectorXd along = left * psi;
    squares +=
        psi.squaredNorm() * f * f.transpose() - along * f.transpose() - f * along.transpose();
    left -= f * psi.transpose();
    append_column(temporal_, psi);
  }
}

/// Nothing goes where the iterations have left the range of numbers, which the solver then tells.
void Pgd::downsize(double indicator) {
  if (!temporal_.allFinite()) return;
  const Svd svd = thin_svd(temporal_);
  const VectorXd& sigma = svd.sigma;
  Index kept = 0;
  while (kept < sigma.size() && sigma[kept] >= 0.3 * options_.downsizing * indicator * sigma[0])
    ++kept;
  kept = std::max<Index>(kept, 1);
  const MatrixXd turn = svd.v.leftCols(kept);
  temporal_ = svd.u.leftCols(kept) * sigma.head(kept).asDiagonal();
  contact_ *= turn;
  load_ *= turn;
  rotation_ *= turn;
}

/// Where what is dropped has to be found again and again, or twice as much was solved for as there
/// are rows, all of it is kept from there on.
void Pgd::watch(double indicator) {
  constexpr double better = 0.9;
  constexpr int patience = 8;
  if (keeps_all_) return;
  waited_ = indicator <= better * best_ ? 0 : waited_ + 1;
  best_ = waited_ == 0 ? indicator : best_;
  if (waited_ >= patience || solved_.contact.cols() >= 2 * contact_.rows())
    take_all(Fields(solved_));
}

void Pgd::solve(const MatrixXd& load, double indicator, MatrixXd& displacement) {
  watch(indicator);
  const int before = solves_;
  temporal_ = load.transpose() * contact_;
  enrich(load, indicator);
  most_modes_ = std::max(most_modes_, modes());
  if (solves_ > before && options_.downsizing > 0.0 && !keeps_all_) downsize(indicator);
  displacement.noalias() = contact_ * temporal_.transpose();
}

MatrixXd Pgd::balanced_force(const MatrixXd& /*load*/, const MatrixXd& displacement) const {
  return load_ * temporal_.transpose() - options_.direction * displacement;
}

Index values_kept(const VectorXd& sigma, double share) {
  Index kept = sigma.size();
  double tail = 0.0;
  while (kept > 1) {
    tail = std::hypot(tail, sigma[kept - 1]);
    if (tail > share * sigma.norm()) break;
    --kept;
  }
  return kept;
}

Separated Pgd::separated(double share) const {
  MatrixXd destroyed = temporal_;
  const Svd svd = thin_svd(destroyed);
  const Index kept = values_kept(svd.sigma, share);
  const MatrixXd turn = svd.v.leftCols(kept);
  Separated s;
  s.modes = {solved_.field * (rotation_ * turn), contact_ * turn, load_ * turn};
  s.sigma = svd.sigma.head(kept);
  s.temporal = svd.u.leftCols(kept);
  return s;
}

Fields Pgd::basis() const {
  return orthonormal(solved_);
}

}  // namespace rondo::statics
