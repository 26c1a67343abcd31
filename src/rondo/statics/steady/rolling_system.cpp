// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_system.hpp"

#include <lapacke.h>

#include <limits>
#include <utility>

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;

}  // namespace

RollingSystem::RollingSystem(const RollingProblem& problem, const RollingDrive& drive,
                             const std::vector<RollingStatus>& found, const RollingPoint& around)
    : problem_(problem),
      drive_(drive),
      found_(found),
      has_height_(drive.load.has_value()),
      has_speed_(drive.traction || drive.torque) {
  for (std::size_t j = 0; j < found.size(); ++j) {
    if (found[j].status == Status::open) continue;
    rows_.push_back(static_cast<Index>(2 * j));
    if (found[j].status == Status::stick) rows_.push_back(static_cast<Index>(2 * j + 1));
  }
  const auto n = static_cast<Index>(rows_.size());
  const Index size = n + (has_height_ ? 1 : 0) + (has_speed_ ? 1 : 0);
  matrix_ = Eigen::MatrixXd::Zero(size, size);
  right_ = Eigen::VectorXd::Zero(size);
  for (Index k = 0; k < n; ++k) {
    const Index column = rows_[static_cast<std::size_t>(k)];
    matrix_.col(k).head(n) = problem.matrix.col(column)(rows_);
    const double mu = column % 2 == 0 ? edge(static_cast<std::size_t>(column / 2)) : 0.0;
    if (mu != 0.0) matrix_.col(k).head(n) += mu * problem.matrix.col(column + 1)(rows_);
  }
  right_.head(n) = -problem.base(rows_);
  add_border(around);
  factorise();
}

void RollingSystem::factorise() {
  const auto n = static_cast<lapack_int>(matrix_.rows());
  pivots_.resize(static_cast<std::size_t>(n));
  singular_ = LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, matrix_.data(), n, pivots_.data()) != 0;
}

/// Not finite: the system is singular.
Eigen::VectorXd RollingSystem::solved(Eigen::VectorXd right) const {
  const auto n = static_cast<lapack_int>(matrix_.rows());
  if (singular_)
    right.setConstant(std::numeric_limits<double>::quiet_NaN());
  else
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, 1, matrix_.data(), n, pivots_.data(),
                        right.data(), n);
  return right;
}

/// μ with its sign where a pair slips.
double RollingSystem::edge(std::size_t pair) const noexcept {
  const RollingStatus& f = found_[pair];
  return f.status == Status::slip ? f.side * drive_.friction : 0.0;
}

/// By (r_n, r_x) of all pairs: how the arms change is part of it.
RollingSystem::Torque RollingSystem::torque_at(const RollingPoint& around) const {
  const Index n = around.force.size() / 2;
  const Eigen::VectorXd normal = around.force(Eigen::seqN(0, n, 2));
  const Eigen::VectorXd arm = problem_.base_x + problem_.matrix_x * around.force;
  Eigen::VectorXd row = problem_.matrix_x.transpose() * normal;
  row(Eigen::seqN(0, n, 2)) += arm;
  row(Eigen::seqN(1, n, 2)).array() += around.height;
  row += problem_.pass * problem_.weight;
  return {std::move(row), around.force(Eigen::seqN(1, n, 2)).sum()};
}

/// Height and speed as columns; load, traction or torque as rows.
void RollingSystem::add_border(const RollingPoint& around) {
  const auto n = static_cast<Index>(rows_.size());
  Index at = n;
  const Index of_height = at;
  if (has_height_) ++at;
  const Index of_speed = at;
  for (Index k = 0; k < n; ++k) {
    const Index row = rows_[static_cast<std::size_t>(k)];
    const bool is_gap = row % 2 == 0;
    if (has_height_ && is_gap) matrix_(k, of_height) = 1.0;
    if (!has_height_ && is_gap) right_[k] -= drive_.height;
    if (has_speed_ && !is_gap) matrix_(k, of_speed) = problem_.time;
    if (!has_speed_ && !is_gap) right_[k] -= drive_.speed * problem_.time;
  }
  const auto sum = [&](Index to, const Eigen::VectorXd& row) {  // of all forces
    for (Index k = 0; k < n; ++k) {
      const Index c = rows_[static_cast<std::size_t>(k)];
      matrix_(to, k) = row[c];
      if (c % 2 == 0) matrix_(to, k) += edge(static_cast<std::size_t>(c / 2)) * row[c + 1];
    }
  };
  Eigen::VectorXd ones = Eigen::VectorXd::Zero(problem_.base.size());
  const Index m = ones.size() / 2;
  if (has_height_) {
    ones(Eigen::seqN(0, m, 2)).setOnes();
    sum(of_height, ones);
    right_[of_height] = *drive_.load * problem_.pass;
  }
  if (!has_speed_) return;
  if (drive_.traction) {
    ones.setZero();
    ones(Eigen::seqN(1, m, 2)).setOnes();
    sum(of_speed, ones);
    right_[of_speed] = *drive_.traction * problem_.pass;
    return;
  }
  const Torque torque = torque_at(around);
  sum(of_speed, torque.row);
  const double now = forces_of(problem_, around).torque;
  right_[of_speed] = (*drive_.torque - now) * problem_.pass + torque.row.dot(around.force);
  if (has_height_) {
    matrix_(of_speed, of_height) = torque.shear;
    right_[of_speed] += torque.shear * around.height;
  }
}

Eigen::VectorXd RollingSystem::expand(const Eigen::VectorXd& part) const {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(problem_.base.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Index row = rows_[k];
    r[row] = part[static_cast<Index>(k)];
    if (row % 2 == 0) {
      const double mu = edge(static_cast<std::size_t>(row / 2));
      if (mu != 0.0) r[row + 1] = mu * r[row];
    }
  }
  return r;
}

RollingPoint RollingSystem::solve() const {
  RollingPoint p;
  const Eigen::VectorXd z = solved(right_);
  p.force = expand(z);
  auto at = static_cast<Index>(rows_.size());
  p.height = has_height_ ? z[at++] : drive_.height;
  p.speed = has_speed_ ? z[at] : drive_.speed;
  return p;
}

/// @param right of the system. @param by_itself change of the forces that is not an unknown's
RollingSlope RollingSystem::slope(const Torque& torque, const Eigen::VectorXd& right,
                                  const Eigen::VectorXd& by_itself, double height,
                                  double speed) const {
  const Eigen::VectorXd z = solved(right);
  const Eigen::VectorXd change = expand(z) + by_itself;
  auto at = static_cast<Index>(rows_.size());
  RollingSlope s;
  s.height = has_height_ ? z[at++] : height;
  s.speed = has_speed_ ? z[at] : speed;
  const Index m = change.size() / 2;
  s.forces.y = change(Eigen::seqN(0, m, 2)).sum() / problem_.pass;
  s.forces.x = change(Eigen::seqN(1, m, 2)).sum() / problem_.pass;
  s.forces.torque = (torque.row.dot(change) + torque.shear * s.height) / problem_.pass;
  return s;
}

RollingSlopes RollingSystem::slopes(const RollingPoint& around) const {
  const Torque torque = torque_at(around);
  RollingSlopes s;
  const auto n = static_cast<Index>(rows_.size());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(problem_.base.size());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(right_.size());
  const Index of_height = n, of_speed = n + (has_height_ ? 1 : 0);
  if (has_height_) {
    right[of_height] = problem_.pass;
  } else {
    for (Index k = 0; k < n; ++k) right[k] = rows_[static_cast<std::size_t>(k)] % 2 == 0 ? -1.0 : 0;
    if (drive_.torque) right[of_speed] = -torque.shear;
  }
  s.by_height = slope(torque, right, none, 1.0, 0.0);
  right.setZero();
  if (has_speed_)
    right[of_speed] = problem_.pass;
  else
    for (Index k = 0; k < n; ++k)
      right[k] = rows_[static_cast<std::size_t>(k)] % 2 == 0 ? 0.0 : -problem_.time;
  s.by_speed = slope(torque, right, none, 0.0, 1.0);
  Eigen::VectorXd slipping = none;  // by μ alone
  for (std::size_t j = 0; j < found_.size(); ++j)
    if (found_[j].status == Status::slip)
      slipping[static_cast<Index>(2 * j + 1)] =
          found_[j].side * around.force[static_cast<Index>(2 * j)];
  right.setZero();
  right.head(n) = -(problem_.matrix * slipping)(rows_);
  if (drive_.traction) right[of_speed] = -slipping.sum();
  if (drive_.torque) right[of_speed] = -torque.row.dot(slipping);
  s.by_friction = slope(torque, right, slipping, 0.0, 0.0);
  return s;
}

}  // namespace rondo::statics
