// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_system.hpp"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/core/index.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;

/// What slides where it should stick has a way against its force. It sticks next where that way is
/// small beside the force, and slides backwards else, from where Newton's method may cycle: in
/// space ways count less than one over their own compliances makes them.
constexpr double weight_of_ways = 0.4;

}  // namespace

template <int D>
RollingStiffness stiffness_of(const RollingProblem<D>& problem) {
  const VectorXd own = problem.matrix.diagonal().cwiseAbs();
  if constexpr (D == 2) return {1.0 / own.mean(), 1.0 / own.mean()};
  const Index n = problem.n_pairs();
  const double normal = own(Eigen::seqN(0, n, D)).mean();
  return {1.0 / normal, weight_of_ways * (D - 1) / (own.sum() / static_cast<double>(n) - normal)};
}

template <int D>
RollingStatuses statuses_of(const RollingProblem<D>& problem, const RollingPoint& p,
                            const VectorXd& moved, const PairCoefficients& friction) {
  const RollingStiffness stiffness = stiffness_of(problem);
  RollingStatuses statuses(static_cast<std::size_t>(problem.n_pairs()));
  for (std::size_t j = 0; j < statuses.size(); ++j) {
    const auto row = static_cast<Index>(D * j);
    RollingStatus& s = statuses[j];
    const double normal = p.force[row] - stiffness.normal * moved[row];
    if (!(normal > 0.0)) continue;
    const NodeVector<D - 1> across =
        p.force.segment<D - 1>(row + 1) - stiffness.across * moved.segment<D - 1>(row + 1);
    const double coefficient = friction[j], bound = coefficient * normal,
                 length = D == 2 ? std::abs(across[0]) : across.norm();
    const bool sticks = coefficient > 0.0 && length <= bound;
    s.status = sticks ? Status::stick : Status::slip;
    if (sticks) continue;
    s.direction =
        coefficient > 0.0 ? Vec2{across[0], D == 2 ? 0.0 : across[D - 2]} / length : Vec2{1.0, 0.0};
    s.share = coefficient > 0.0 ? bound / length : 0.0;
  }
  return statuses;
}

template <int D>
RollingSystem<D>::RollingSystem(const RollingProblem<D>& problem, const RollingDrive& drive,
                                const RollingStatuses& statuses, const RollingPoint& around,
                                NearFactors* near)
    : problem_(problem),
      drive_(drive),
      statuses_(statuses),
      scale_(1.0 / stiffness_of(problem).across),
      around_(around),
      near_(near) {
  number();
  const Index size = n_forces_ + (has_height() ? 1 : 0) + (has_speed() ? 1 : 0);
  matrix_ = Eigen::MatrixXd::Zero(size, size);
  right_ = VectorXd::Zero(size);
  fill(around);
  add_border(around);
  if (near_) name_rows();
}

template <int D>
NodeVector<D - 1> RollingSystem<D>::direction(Index pair) const noexcept {
  const Vec2 d = statuses_[at(pair)].direction;
  NodeVector<D - 1> e;
  e[0] = d.x;
  if constexpr (D == 3) e[1] = d.y;
  return e;
}

/// How fast the direction of a sliding pair turns: (μ q_n/|q_t|)(I - e eᵀ); 0 in the plane.
template <int D>
NodeMatrix<D - 1> RollingSystem<D>::turning(Index pair) const noexcept {
  const NodeVector<D - 1> e = direction(pair);
  return statuses_[at(pair)].share * (NodeMatrix<D - 1>::Identity() - e * e.transpose());
}

/// How the row of a sliding pair depends on its way, over the row of a sticking one: by the turn of
/// its direction, and by the slip speed that its coefficient depends on.
template <int D>
NodeMatrix<D - 1> RollingSystem<D>::by_way(Index pair,
                                           const PairFriction& friction) const noexcept {
  if (friction.by_way == 0.0) return turning(pair);
  const NodeVector<D - 1> e = direction(pair);
  return turning(pair) + scale_ * friction.by_way * e * e.transpose();
}

/// The shear of a pair that slides follows from its normal force in the plane, where its direction
/// has a sign alone, and where there is no friction.
template <int D>
void RollingSystem<D>::number() {
  for (Index j = 0; j < problem_.n_pairs(); ++j) {
    const Status status = statuses_[at(j)].status;
    if (status == Status::open) continue;
    const bool sticks = status == Status::stick;
    const PairFriction friction = drive_.of_pair(at(j));
    const double coefficient = drive_.friction * friction.factor;
    const bool is_linearised = friction.by_normal != 0.0 || friction.by_way != 0.0;
    const bool follows = coefficient == 0.0 || (D == 2 && !sticks && !is_linearised);
    const double edge = follows ? coefficient * direction(j)[0] : 0.0;
    closed_.push_back({j, n_forces_, follows ? 1 : D, sticks, edge, friction, by_way(j, friction)});
    n_forces_ += closed_.back().unknowns;
  }
}

template <int D>
template <class Moved>
void RollingSystem<D>::reduce(const Moved& moved, Eigen::Ref<VectorXd> rows) const {
  for (const Pair& p : closed_) {
    rows[p.at] = moved.coeff(D * p.pair);
    if (p.unknowns == 1) continue;
    const NodeVector<D - 1> way = moved.template segment<D - 1>(D * p.pair + 1);
    rows.template segment<D - 1>(p.at + 1) = p.sticks ? way : NodeVector<D - 1>(p.by_way * way);
  }
}

/// With a turn slip the ways by speed times displacement are linearised: what forces add to them is
/// in the matrix, at the speed so far.
template <int D>
void RollingSystem<D>::fill(const RollingPoint& around) {
  const double turn = drive_.turn_slip * around.speed * problem_.time;
  Eigen::MatrixXd with_turn;
  if (turn != 0.0) with_turn = yawing_matrix(problem_, turn);
  const Eigen::MatrixXd& matrix = turn != 0.0 ? with_turn : problem_.matrix;
  for (const Pair& column : closed_) {
    const Index first = D * column.pair;
    if (column.edge == 0.0)
      reduce(matrix.col(first), matrix_.col(column.at));
    else
      reduce(matrix.col(first) + column.edge * matrix.col(first + 1), matrix_.col(column.at));
    for (Index c = 1; c < column.unknowns; ++c)
      reduce(matrix.col(first + c), matrix_.col(column.at + c));
  }
  VectorXd right = -problem_.base;
  if (turn != 0.0) {  // both factors of the product have what the forces so far add to it
    const VectorXd displaced = places(problem_, around.force) - problem_.base_place;
    right += turn * yawed<D>(displaced).reshaped();
  }
  reduce(right, right_);
  add_edges();
  add_linearised(around);
}

/// Row of a sliding pair whose direction turns: r_t - μ r_n e - C (r_t - w/c) = 0, in ways; C q_t
/// is 0.
template <int D>
void RollingSystem<D>::add_edges() {
  for (const Pair& p : closed_) {
    if (p.sticks || p.unknowns == 1) continue;
    const double edge = drive_.friction * p.friction.factor + p.friction.by_normal;
    matrix_.template block<D - 1, 1>(p.at + 1, p.at) -= scale_ * edge * direction(p.pair);
    matrix_.template block<D - 1, D - 1>(p.at + 1, p.at + 1) +=
        scale_ * (NodeMatrix<D - 1>::Identity() - turning(p.pair));
  }
}

/// A sliding pair has |r_t| = μ r_n + by_normal (r_n - r_n') + by_way (|w| - |w'|) about its state
/// r', w', and |w| = -e·w: what is of that state is on the right.
template <int D>
void RollingSystem<D>::add_linearised(const RollingPoint& around) {
  const bool any = std::ranges::any_of(closed_, [](const Pair& p) {
    return p.unknowns > 1 && (p.friction.by_normal != 0.0 || p.friction.by_way != 0.0);
  });
  if (!any) return;
  const VectorXd moved = gaps_and_ways(problem_, around, drive_.path());
  for (const Pair& p : closed_) {
    if (p.sticks || p.unknowns == 1) continue;
    const NodeVector<D - 1> e = direction(p.pair), way = moved.segment<D - 1>(D * p.pair + 1);
    const double known =
        p.friction.by_way * e.dot(way) - p.friction.by_normal * around.force[D * p.pair];
    right_.template segment<D - 1>(p.at + 1) += scale_ * known * e;
  }
}

/// Rows by which all gaps and ways change as the center moves.
template <int D>
VectorXd RollingSystem<D>::rigid(double height, double ahead, double aside) const {
  const NodeVector<3> move{height, ahead * problem_.time, aside * problem_.time};
  const VectorXd all = move.head<D>().replicate(problem_.n_pairs(), 1);
  VectorXd rows = VectorXd::Zero(right_.size());
  reduce(all, rows);
  return rows;
}

/// Rows by which all ways change with φ V: time n × x at the places of a point.
template <int D>
VectorXd RollingSystem<D>::yawing(const RollingPoint& around) const {
  VectorXd rows = VectorXd::Zero(right_.size());
  reduce(problem_.time * yawed<D>(places(problem_, around.force)).reshaped(), rows);
  return rows;
}

/// Rows by which all ways change with the speed.
template <int D>
VectorXd RollingSystem<D>::by_speed(const RollingPoint& around) const {
  VectorXd rows = rigid(0.0, std::cos(drive_.slip_angle), std::sin(drive_.slip_angle));
  if (drive_.turn_slip != 0.0) rows += drive_.turn_slip * yawing(around);
  return rows;
}

template <int D>
void RollingSystem<D>::add_sum(Index row, const VectorXd& by_force) {
  for (const Pair& p : closed_) {
    for (Index c = 0; c < p.unknowns; ++c) matrix_(row, p.at + c) = by_force[D * p.pair + c];
    if (p.unknowns == 1) matrix_(row, p.at) += p.edge * by_force[D * p.pair + 1];
  }
}

/// Height and speed as columns; load, traction or torque as rows.
template <int D>
void RollingSystem<D>::add_border(const RollingPoint& around) {
  const VectorXd up = rigid(1.0, 0.0, 0.0);
  const VectorXd on = by_speed(around);
  const auto sum_of = [&](Index component) {
    VectorXd ones = VectorXd::Zero(problem_.size());
    ones(Eigen::seqN(component, problem_.n_pairs(), D)).setOnes();
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
  const TorqueChange torque = torque_change(problem_, around);
  add_sum(of_speed(), torque.row);
  const double now = forces_of(problem_, around).torque;
  right_[of_speed()] = (*drive_.torque - now) * problem_.pass + torque.row.dot(around.force);
  if (has_height()) {
    matrix_(of_speed(), of_height()) = torque.by_height;
    right_[of_speed()] += torque.by_height * around.height;
  }
}

template <int D>
void RollingSystem<D>::factorise() {
  is_factorised_ = true;
  const auto n = static_cast<lapack_int>(matrix_.rows());
  pivots_.resize(static_cast<std::size_t>(n));
  singular_ = LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, matrix_.data(), n, pivots_.data()) != 0;
}

template <int D>
double RollingSystem<D>::work() const noexcept {
  return 2.0 / 3.0 * std::pow(static_cast<double>(matrix_.rows()), 3);
}

/// An unknown of pair j has a number from D j on; height and speed are the first two.
template <int D>
void RollingSystem<D>::name_rows() {
  for (const Pair& p : closed_)
    for (Index c = 0; c < p.unknowns; ++c) names_.push_back(2 + D * p.pair + c);
  if (has_height()) names_.push_back(0);
  if (has_speed()) names_.push_back(1);
  weights_ = VectorXd::Ones(matrix_.rows());
  for (Index row = n_forces_; row < matrix_.rows(); ++row)
    weights_[row] = scale_ / matrix_.row(row).cwiseAbs().maxCoeff();
}

template <int D>
VectorXd RollingSystem<D>::unknowns_of(const RollingPoint& point) const {
  VectorXd unknowns = VectorXd::Zero(right_.size());
  if (point.force.size() == problem_.size())
    for (const Pair& p : closed_)
      unknowns.segment(p.at, p.unknowns) = point.force.segment(D * p.pair, p.unknowns);
  if (has_height()) unknowns[of_height()] = point.height;
  if (has_speed()) unknowns[of_speed()] = point.speed;
  return unknowns;
}

template <int D>
VectorXd RollingSystem<D>::solved(const VectorXd& right) {
  return solved(right, VectorXd::Zero(right.size()));
}

/// Not finite: the system is singular.
template <int D>
VectorXd RollingSystem<D>::solved(VectorXd right, const VectorXd& from) {
  if (near_) {
    if (auto found = near_->solve({matrix_, names_, weights_}, right, from)) return *found;
    near_ = nullptr;
  }
  if (!is_factorised_) factorise();
  const auto n = static_cast<lapack_int>(matrix_.rows());
  if (singular_)
    right.setConstant(std::numeric_limits<double>::quiet_NaN());
  else
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, 1, matrix_.data(), n, pivots_.data(),
                        right.data(), n);
  return right;
}

template <int D>
VectorXd RollingSystem<D>::expand(const VectorXd& part) const {
  VectorXd r = VectorXd::Zero(problem_.size());
  for (const Pair& p : closed_) {
    r.segment(D * p.pair, p.unknowns) = part.segment(p.at, p.unknowns);
    if (p.unknowns == 1) r[D * p.pair + 1] = p.edge * part[p.at];
  }
  return r;
}

/// @param height where it is not an unknown; speed likewise
template <int D>
RollingPoint RollingSystem<D>::point_of(const VectorXd& unknowns, double height,
                                        double speed) const {
  return {expand(unknowns), has_height() ? unknowns[of_height()] : height,
          has_speed() ? unknowns[of_speed()] : speed};
}

template <int D>
RollingPoint RollingSystem<D>::solve() {
  return point_of(solved(right_, unknowns_of(around_)), drive_.height, drive_.speed);
}

/// How the solution changes with μ alone.
template <int D>
RollingPoint RollingSystem<D>::by_friction(const RollingPoint& around, const TorqueChange& torque) {
  const auto shear = [&](const Pair& p) -> NodeVector<D - 1> {
    return p.friction.factor * around.force[D * p.pair] * direction(p.pair);
  };
  VectorXd slipping = VectorXd::Zero(problem_.size());  // forces that no unknown stands for
  VectorXd right = VectorXd::Zero(right_.size());
  for (const Pair& p : closed_)
    if (!p.sticks && p.unknowns == 1) slipping.template segment<D - 1>(D * p.pair + 1) = shear(p);
  if constexpr (D == 2) {
    reduce(VectorXd(-(problem_.matrix * slipping)), right);
    if (drive_.traction) right[of_speed()] = -slipping.sum();
    if (drive_.torque) right[of_speed()] = -torque.row.dot(slipping);
  }
  for (const Pair& p : closed_)
    if (!p.sticks && p.unknowns > 1) right.template segment<D - 1>(p.at + 1) += scale_ * shear(p);
  RollingPoint change = point_of(solved(right), 0.0, 0.0);
  change.force += slipping;
  return change;
}

template <int D>
RollingSlopes RollingSystem<D>::slopes(const RollingPoint& around) {
  const TorqueChange torque = torque_change(problem_, around);
  const auto slope = [&](const RollingPoint& change) {
    return RollingSlope{forces_change(problem_, around, torque, change), change.height,
                        change.speed};
  };
  RollingSlopes s;
  VectorXd right = VectorXd::Zero(right_.size());
  if (has_height()) {
    right[of_height()] = problem_.pass;
  } else {
    right = -rigid(1.0, 0.0, 0.0);
    if (drive_.torque) right[of_speed()] = -torque.by_height;
  }
  s.by_height = slope(point_of(solved(right), 1.0, 0.0));
  right.setZero();
  if (has_speed())
    right[of_speed()] = problem_.pass;
  else
    right = -by_speed(around);
  s.by_speed = slope(point_of(solved(right), 0.0, 1.0));
  if constexpr (D == 3) {
    const double angle = drive_.slip_angle;
    const VectorXd across = rigid(0.0, -std::sin(angle), std::cos(angle));
    s.by_slip_angle = slope(point_of(solved(-around.speed * across), 0.0, 0.0));
    s.by_turn_slip = slope(point_of(solved(-around.speed * yawing(around)), 0.0, 0.0));
  }
  if (D == 2 || drive_.friction > 0.0) s.by_friction = slope(by_friction(around, torque));
  return s;
}

template RollingStiffness stiffness_of(const RollingProblem<2>&);
template RollingStiffness stiffness_of(const RollingProblem<3>&);
template RollingStatuses statuses_of(const RollingProblem<2>&, const RollingPoint&, const VectorXd&,
                                     const PairCoefficients&);
template RollingStatuses statuses_of(const RollingProblem<3>&, const RollingPoint&, const VectorXd&,
                                     const PairCoefficients&);
template class RollingSystem<2>;
template class RollingSystem<3>;

}  // namespace rondo::statics
