// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady_solid/solid_system.hpp"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;

Status status(const SolidStatuses& s, Index pair) noexcept {
  return s.of[static_cast<std::size_t>(pair)];
}

}  // namespace

SolidScales scales_of(const SolidRollingProblem& problem) {
  const Eigen::VectorXd own = problem.matrix.diagonal().cwiseAbs();
  const Index n = own.size() / 3;
  const double normal = own(Eigen::seqN(0, n, 3)).mean();
  return {normal, (own.sum() / static_cast<double>(n) - normal) / 2.0};
}

SolidStatuses statuses_of(const SolidRollingProblem& problem, const SolidRollingPoint& p,
                          const Eigen::VectorXd& moved, double friction) {
  const SolidScales scales = scales_of(problem);
  const Index n = p.force.size() / 3;
  SolidStatuses s{std::vector(static_cast<std::size_t>(n), Status::open),
                  Eigen::MatrixXd::Zero(2, n), Eigen::VectorXd::Zero(n)};
  for (Index j = 0; j < n; ++j) {
    const double normal = p.force[3 * j] - moved[3 * j] / scales.normal;
    if (!(normal > 0.0)) continue;
    const Eigen::Vector2d across =
        p.force.segment<2>(3 * j + 1) - moved.segment<2>(3 * j + 1) / scales.across;
    const double length = across.norm(), bound = friction * normal;
    const bool sticks = friction > 0.0 && length <= bound;
    s.of[static_cast<std::size_t>(j)] = sticks ? Status::stick : Status::slip;
    if (sticks || length == 0.0) continue;
    s.direction.col(j) = across / length;
    s.share[j] = bound / length;
  }
  return s;
}

SolidSystem::SolidSystem(const SolidRollingProblem& problem, const SolidRollingDrive& drive,
                         const SolidStatuses& statuses, const SolidRollingPoint& around)
    : problem_(problem),
      drive_(drive),
      statuses_(statuses),
      around_(around),
      scale_(scales_of(problem).across) {
  number();
  const Index size = n_forces_ + (has_height() ? 1 : 0) + (has_speed() ? 1 : 0);
  matrix_ = Eigen::MatrixXd::Zero(size, size);
  right_ = Eigen::VectorXd::Zero(size);
  fill();
  add_border();
  factorise();
}

/// Without friction there are normal forces alone.
void SolidSystem::number() {
  const Index each = drive_.friction > 0.0 ? 3 : 1;
  for (Index j = 0; j < problem_.size() / 3; ++j) {
    if (status(statuses_, j) == Status::open) continue;
    closed_.push_back({j, n_forces_, status(statuses_, j) == Status::stick});
    n_forces_ += each;
  }
}

/// How fast the direction of a sliding pair turns: (μ q_n/|q_t|)(I - e eᵀ).
Eigen::Matrix2d SolidSystem::turning(Index pair) const {
  const Eigen::Vector2d e = statuses_.direction.col(pair);
  return statuses_.share[pair] * (Eigen::Matrix2d::Identity() - e * e.transpose());
}

Eigen::VectorXd SolidSystem::reduced(const Eigen::VectorXd& moved) const {
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(matrix_.rows());
  for (const Pair& p : closed_) {
    rows[p.at] = moved[3 * p.pair];
    if (drive_.friction == 0.0) continue;
    const Eigen::Vector2d way = moved.segment<2>(3 * p.pair + 1);
    rows.segment<2>(p.at + 1) = p.sticks ? way : Eigen::Vector2d(turning(p.pair) * way);
  }
  return rows;
}

/// Of a sliding pair r_t - μ r_n e - C (r_t - w/c) = 0, in ways; C q_t is 0.
void SolidSystem::fill() {
  const Index each = drive_.friction > 0.0 ? 3 : 1;
  for (const Pair& column : closed_)
    for (Index c = 0; c < each; ++c)
      matrix_.col(column.at + c) = reduced(problem_.matrix.col(3 * column.pair + c));
  right_ = -reduced(problem_.base);
  if (each == 1) return;
  for (const Pair& p : closed_) {
    if (p.sticks) continue;
    matrix_.block<2, 1>(p.at + 1, p.at) -=
        scale_ * drive_.friction * statuses_.direction.col(p.pair);
    matrix_.block<2, 2>(p.at + 1, p.at + 1) +=
        scale_ * (Eigen::Matrix2d::Identity() - turning(p.pair));
  }
}

/// Of all gaps and ways, as the center moves.
Eigen::VectorXd SolidSystem::rigid(double height, double ahead, double aside) const {
  Eigen::VectorXd all(problem_.size());
  for (Index j = 0; j < all.size(); j += 3)
    all.segment<3>(j) << height, ahead * problem_.time, aside * problem_.time;
  return reduced(all);
}

void SolidSystem::add_sum(Index row, const Eigen::VectorXd& by_force) {
  const Index each = drive_.friction > 0.0 ? 3 : 1;
  for (const Pair& p : closed_)
    for (Index c = 0; c < each; ++c) matrix_(row, p.at + c) = by_force[3 * p.pair + c];
}

/// Height and speed as columns; load, traction or torque as rows.
void SolidSystem::add_border() {
  const Eigen::VectorXd up = rigid(1.0, 0.0, 0.0);
  const Eigen::VectorXd on = rigid(0.0, std::cos(drive_.slip_angle), std::sin(drive_.slip_angle));
  const auto sum_of = [&](Index component) {
    Eigen::VectorXd ones = Eigen::VectorXd::Zero(problem_.size());
    ones(Eigen::seqN(component, ones.size() / 3, 3)).setOnes();
    return ones;
  };
  if (has_height()) {
    matrix_.col(of_height()) = up;
    add_sum(of_height(), sum_of(0));
    right_[of_height()] = *drive_.load * problem_.pass;
  } else {
    right_ -= drive_.height * up;
  }
  if (!has_speed()) {
    right_ -= drive_.speed * on;
    return;
  }
  matrix_.col(of_speed()) = on;
  if (drive_.traction) {
    add_sum(of_speed(), sum_of(1));
    right_[of_speed()] = *drive_.traction * problem_.pass;
    return;
  }
  const Eigen::VectorXd row = torque_row(problem_, around_);
  const double now = forces_of(problem_, around_).torque;
  add_sum(of_speed(), row);
  right_[of_speed()] = (*drive_.torque - now) * problem_.pass + row.dot(around_.force);
}

void SolidSystem::factorise() {
  const auto n = static_cast<lapack_int>(matrix_.rows());
  pivots_.resize(static_cast<std::size_t>(n));
  singular_ = LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, matrix_.data(), n, pivots_.data()) != 0;
}

double SolidSystem::work() const noexcept {
  return 2.0 / 3.0 * std::pow(static_cast<double>(matrix_.rows()), 3);
}

/// Not finite: the system is singular.
Eigen::VectorXd SolidSystem::solved(Eigen::VectorXd right) const {
  const auto n = static_cast<lapack_int>(matrix_.rows());
  if (singular_)
    right.setConstant(std::numeric_limits<double>::quiet_NaN());
  else
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, 1, matrix_.data(), n, pivots_.data(),
                        right.data(), n);
  return right;
}

Eigen::VectorXd SolidSystem::expand(const Eigen::VectorXd& part) const {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(problem_.size());
  const Index each = drive_.friction > 0.0 ? 3 : 1;
  for (const Pair& p : closed_) r.segment(3 * p.pair, each) = part.segment(p.at, each);
  return r;
}

SolidRollingPoint SolidSystem::solve() const {
  const Eigen::VectorXd z = solved(right_);
  SolidRollingPoint p;
  p.force = expand(z);
  p.height = has_height() ? z[of_height()] : drive_.height;
  p.speed = has_speed() ? z[of_speed()] : drive_.speed;
  return p;
}

/// Forces but for the torque and the moments are linear: those have parts by the arms as well, and
/// are taken as differences of what is of the second order.
SolidRollingSlope SolidSystem::slope(const Eigen::VectorXd& right, double height,
                                     double speed) const {
  const Eigen::VectorXd z = solved(right);
  const Eigen::VectorXd change = expand(z);
  SolidRollingSlope s;
  s.height = has_height() ? z[of_height()] : height;
  s.speed = has_speed() ? z[of_speed()] : speed;
  // The moments are of the second degree in forces and height: a difference to either side is
  // exact, whatever its length.
  const double size = change.cwiseAbs().maxCoeff(), force = around_.force.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return s;
  const double by = force / size;
  const auto at = [&](double step) {
    return forces_of(
        problem_, {around_.force + step * change, around_.height + step * s.height, around_.speed});
  };
  const SolidRollingForces more = at(by), less = at(-by);
  const auto of = [&](double SolidRollingForces::*which) {
    return (more.*which - less.*which) / (2.0 * by);
  };
  using F = SolidRollingForces;
  s.forces = {of(&F::normal), of(&F::heading),  of(&F::lateral),
              of(&F::torque), of(&F::aligning), of(&F::overturning)};
  return s;
}

SolidRollingSlopes SolidSystem::slopes() const {
  SolidRollingSlopes s;
  const double angle = drive_.slip_angle, cosine = std::cos(angle), sine = std::sin(angle);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(right_.size());
  if (has_height())
    right[of_height()] = problem_.pass;
  else
    right = -rigid(1.0, 0.0, 0.0);
  s.by_height = slope(right, 1.0, 0.0);
  right.setZero();
  if (has_speed())
    right[of_speed()] = problem_.pass;
  else
    right = -rigid(0.0, cosine, sine);
  s.by_speed = slope(right, 0.0, 1.0);
  s.by_slip_angle = slope(-around_.speed * rigid(0.0, -sine, cosine), 0.0, 0.0);
  right.setZero();
  for (const Pair& p : closed_)
    if (!p.sticks && drive_.friction > 0.0)
      right.segment<2>(p.at + 1) =
          scale_ * around_.force[3 * p.pair] * statuses_.direction.col(p.pair);
  s.by_friction = slope(right, 0.0, 0.0);
  return s;
}

}  // namespace rondo::statics
