// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/near_factors.hpp"

#include <lapacke.h>

#include <Eigen/Jacobi>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rondo::statics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// So many steps of GMRES take about as long as factors in single precision: new ones are better.
Index most_steps(Index size) {
  return std::clamp<Index>(size / 60, 12, 24);
}
constexpr double of_a_round = 1e-6;  // of what is left, in one round of GMRES
constexpr int most_refinements = 6;
constexpr double round_off = 1e-16;
/// What a step of Newton's method leaves of its system: this share of what was left before it, and
/// less the nearer that is to 0, so that convergence stays quadratic.
constexpr double most_left = 0.1, left_of_square = 10.0;

/// Least squares of GMRES by Givens rotations, a column at a time.
class Hessenberg {
 public:
  Hessenberg(Index most, double left) : h_(MatrixXd::Zero(most + 1, most)), g_(most + 1) {
    g_.setZero();
    g_[0] = left;
  }
  /// @param column (j + 2) the products with the basis, and the length of the next vector
  void add(const VectorXd& column) {
    const Index j = n_++;
    h_.col(j).head(j + 2) = column;
    for (Index i = 0; i < j; ++i) rotate(turns_[static_cast<std::size_t>(i)], h_.col(j), i);
    Eigen::JacobiRotation<double> turn;
    turn.makeGivens(h_(j, j), h_(j + 1, j));
    turns_.push_back(turn);
    rotate(turn, h_.col(j), j);
    rotate(turn, g_, j);
  }
  [[nodiscard]] double left() const { return std::abs(g_[n_]); }
  [[nodiscard]] VectorXd solved() const {
    return h_.topLeftCorner(n_, n_).triangularView<Eigen::Upper>().solve(g_.head(n_));
  }

 private:
  static void rotate(const Eigen::JacobiRotation<double>& turn, Eigen::Ref<VectorXd> v, Index i) {
    v.applyOnTheLeft(i, i + 1, turn.adjoint());
  }
  MatrixXd h_;
  VectorXd g_;
  std::vector<Eigen::JacobiRotation<double>> turns_;
  Index n_ = 0;
};

}  // namespace

std::optional<VectorXd> NearFactors::solve(const NamedSystem& system, const VectorXd& right,
                                           const VectorXd& from) {
  if (made_ > 0) {
    renumber(system);
    if (auto found = refined(system, right, from)) return found;
  }
  if (!make(system)) return std::nullopt;
  return refined(system, right, from);
}

/// @return whether the factors exist
bool NearFactors::make(const NamedSystem& system) {
  factors_ = (system.weights.asDiagonal() * system.matrix).cast<float>();
  const auto n = static_cast<lapack_int>(factors_.rows());
  pivots_.resize(static_cast<std::size_t>(n));
  names_ = system.names;
  ++made_;
  renumber(system);
  return LAPACKE_sgetrf_work(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data()) == 0;
}

void NearFactors::renumber(const NamedSystem& system) {
  const Index most = names_.empty() ? -1 : *std::ranges::max_element(names_);
  std::vector<Index> place(static_cast<std::size_t>(most + 1), -1);
  for (std::size_t i = 0; i < names_.size(); ++i)
    place[static_cast<std::size_t>(names_[i])] = static_cast<Index>(i);
  places_.clear();
  for (const Index name : system.names)
    places_.push_back(name <= most ? place[static_cast<std::size_t>(name)] : -1);
  diagonal_ = system.weights.cwiseProduct(system.matrix.diagonal());
}

/// By the factors; unknowns that these do not have, by the diagonal.
VectorXd NearFactors::applied(const VectorXd& v) const {
  Eigen::VectorXf some = Eigen::VectorXf::Zero(factors_.rows());
  const double size = v.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (places_[i] >= 0) some[places_[i]] = static_cast<float>(v[static_cast<Index>(i)] / size);
  const auto n = static_cast<lapack_int>(factors_.rows());
  LAPACKE_sgetrs_work(LAPACK_COL_MAJOR, 'N', n, 1, factors_.data(), n, pivots_.data(), some.data(),
                      n);
  VectorXd x(v.size());
  for (Index i = 0; i < v.size(); ++i) {
    const Index at = places_[static_cast<std::size_t>(i)];
    x[i] = at >= 0 ? size * static_cast<double>(some[at]) : v[i] / diagonal_[i];
  }
  return x;
}

/// One round of GMRES, which gives up where it is too slow to end within its steps.
/// @param left weighted. @param enough that may be left. @param steps that may be taken; less those
/// that were
VectorXd NearFactors::correction(const NamedSystem& system, const VectorXd& left, double enough,
                                 Index& steps) const {
  const double norm = left.norm(), to = std::max(enough, of_a_round * norm);
  MatrixXd basis(left.size(), steps + 1), by_factors(left.size(), steps);
  Hessenberg least(steps, norm);
  basis.col(0) = left / norm;
  Index n = 0;
  while (n < steps && least.left() > to) {
    by_factors.col(n) = applied(basis.col(n));
    VectorXd next = system.weights.cwiseProduct(system.matrix * by_factors.col(n));
    VectorXd column(n + 2);
    for (Index j = 0; j <= n; ++j) {
      column[j] = basis.col(j).dot(next);
      next -= column[j] * basis.col(j);
    }
    column[n + 1] = next.norm();
    if (!std::isfinite(column[n + 1])) break;
    least.add(column);
    ++n;
    if (column[n] == 0.0) break;  // the vectors so far have the solution
    basis.col(n) = next / column[n];
    if (3 * n == steps && std::pow(least.left() / norm, 3) * norm > to) break;
  }
  steps -= n;
  if (n == 0) return VectorXd::Zero(left.size());
  return by_factors.leftCols(n) * least.solved();
}

std::optional<VectorXd> NearFactors::refined(const NamedSystem& system, const VectorXd& right,
                                             VectorXd x) {
  const VectorXd weighted = system.weights.cwiseProduct(right);
  const auto left_of = [&](const VectorXd& at) -> VectorXd {
    return weighted - system.weights.cwiseProduct(system.matrix * at);
  };
  const double whole = weighted.norm();
  if (whole == 0.0) {
    left_ = 0.0;
    return VectorXd::Zero(right.size());
  }
  VectorXd left = left_of(x);
  double size = left.norm();
  const double before = size / whole,
               enough = before * std::min(most_left, left_of_square * before) * whole;
  Index steps = most_steps(right.size());
  for (int n = 0; n < most_refinements && steps > 0 && size > round_off * whole; ++n) {
    if (n > 0 && size <= enough) break;
    const VectorXd to = x + correction(system, left, 0.5 * enough, steps);
    const VectorXd next = left_of(to);
    const double smaller = next.norm();
    if (!(smaller < size)) break;  // round-off, or not finite
    const bool rests = smaller > 0.1 * size && smaller > enough;
    x = to;
    left = next;
    size = smaller;
    if (rests) break;
  }
  if (!(size <= std::max(enough, as_good_as_direct * whole))) return std::nullopt;
  left_ = size / whole;
  return x;
}

}  // namespace rondo::statics
