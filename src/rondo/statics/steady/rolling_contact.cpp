// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "rondo/core/process_wide.hpp"
#include "rondo/statics/steady/law/rolling_law.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;

constexpr int most_rounds = 60;

/// The speed is asked for, and nothing that sticks tells it.
bool slides(const RollingDrive& drive, const RollingState& s) {
  const bool sticks = std::ranges::any_of(
      s.statuses, [](const RollingStatus& f) { return f.status == Status::stick; });
  return (drive.traction || drive.torque) && !sticks;
}

template <int D>
void fill(const RollingProblem<D>& problem, const RollingState& state, RollingSolution& s) {
  const RollingPoint& p = state.point;
  s.height = p.height;
  s.speed = p.speed;
  s.force = p.force;
  s.status = state.statuses;
  s.residual = state.residual;
  s.gap_and_slip = gaps_and_ways(problem, p, s.path);
  for (Index j = 0; j < s.force.size(); j += D)
    s.gap_and_slip.segment<D - 1>(j + 1) /= problem.time;
  s.place = places(problem, p.force);
  s.forces = forces_of(problem, p);
  s.slopes = state.slopes;
  s.pairs = state.pairs;
  s.friction = state.friction;
}

/// Load, traction and torque are those asked for, of the size of what bears them.
bool brings(const RollingDrive& drive, const RollingSolution& s) {
  const double size = std::abs(s.forces.heading) + std::abs(s.forces.normal);
  const auto near = [&](const std::optional<double>& asked, double found, double arm) {
    return !asked || std::abs(found - *asked) <= 1e-10 * size * arm;
  };
  return near(drive.load, s.forces.normal, 1.0) && near(drive.traction, s.forces.heading, 1.0) &&
         near(drive.torque, s.forces.torque, s.height);
}

/// In space, where friction makes the systems three times as large: what touches without friction
/// is most of what touches with it. @return whether the window grew by it
template <int D>
bool grows_without_friction(RollingWindow<D>& window, const RollingDrive& drive,
                            RollingState& state) {
  if (D == 2 || state.solved()) return false;
  RollingState smooth = state;
  begin(window.problem(), drive, smooth);
  state.effort = smooth.effort;
  if (!smooth.solved()) return false;
  state.point.force = smooth.point.force;
  if (drive.load) state.point.height = smooth.point.height;
  return window.include_touching(smooth.point.height, smooth.point.force);
}

/// Nothing of the height that was tried is left, or nothing was found.
template <int D>
RollingSolution nothing(const RollingProblem<D>& problem, const RollingPoint& point,
                        RollingSolution s) {
  s.height = point.height;
  s.speed = point.speed;
  s.force = Eigen::VectorXd::Zero(problem.size());
  s.gap_and_slip = s.force;
  s.place = Eigen::VectorXd::Zero(problem.base_place.size());
  s.status.assign(problem.pairs.size(), {});
  return s;
}

/// What is solved, to start from.
template <int D>
RollingState state_of(const RollingSolution& s, const RollingDrive& drive) {
  RollingState state;
  state.point = {s.force, drive.load ? s.height : drive.height,
                 drive.traction || drive.torque ? s.speed : drive.speed};
  if (D == 2) state.statuses = s.status;
  state.residual = s.residual;
  state.pairs = s.pairs;
  return state;
}

/// From a state of the window's pairs on, or of none. With a law of friction a state that has no
/// coefficients grows with the constant one first.
template <int D>
RollingSolution grow(RollingWindow<D>& window, const RollingDrive& drive, RollingState state) {
  if (drive.law && state.pairs.empty()) {
    RollingDrive constant = drive;
    constant.law = nullptr;
    const RollingSolution found = grow(window, constant, std::move(state));
    if (found.end != RollingEnd::solved) return found;
    state = state_of<D>(found, drive);
  }
  const OneBlasThread one_thread;
  const double radius = window.lowest();
  RollingSolution s;
  s.path = drive.path();
  int unsolved = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const RollingProblem<D>& problem = window.problem();
    s.end = problem.pairs.empty() ? RollingEnd::no_contact : RollingEnd::not_solved;
    if (problem.pairs.empty()) break;
    state.point.force.conservativeResizeLike(Eigen::VectorXd::Zero(problem.size()));
    if (grows_without_friction(window, drive, state)) continue;
    solve_rolling(problem, drive, state);
    s.effort = state.effort;
    if (!state.touches) {
      s.end = RollingEnd::no_contact;
      if (!drive.load) break;
      // Nothing is left that touches: from further down.
      state.point = {{}, radius * (1.0 - 2e-3 * (round + 1)), drive.speed};
      state.statuses.clear();
      window.include_below(state.point.height);
      continue;
    }
    // Forces that are no solution leave all sorts of pairs in the ground: no further than once
    // more.
    const bool may_grow = state.solved() || ++unsolved < 2;
    if (may_grow && window.include_touching(state.point.height, state.point.force)) continue;
    if constexpr (D == 3)
      if (!drive.law) add_slopes(window.problem(), drive, state);
    fill(window.problem(), state, s);
    if (state.solved() && brings(drive, s))
      s.end = RollingEnd::solved;
    else if (state.friction.solved && slides(drive, state))
      s.end = RollingEnd::sliding;
    return s;
  }
  return nothing(window.problem(), state.point, std::move(s));
}

}  // namespace

template <int D>
RollingSolution solve_rolling(RollingWindow<D>& window, const RollingDrive& drive,
                              const RollingStatuses& from) {
  RollingState state;
  const double height = drive.load ? window.lowest() * (1.0 - 1e-3) : drive.height;
  state.point = {{}, height, drive.speed};
  state.statuses = from;
  window.include_below(height);
  return grow(window, drive, std::move(state));
}

template <int D>
RollingSolution solve_rolling_from(RollingWindow<D>& window, const RollingDrive& drive,
                                   const RollingSolution& near) {
  if (near.end != RollingEnd::solved) return solve_rolling(window, drive);
  RollingState state = state_of<D>(near, drive);
  if (state.pairs.empty()) state.statuses.clear();
  return grow(window, drive, std::move(state));
}

template RollingSolution solve_rolling(RollingWindow<2>&, const RollingDrive&,
                                       const RollingStatuses&);
template RollingSolution solve_rolling(RollingWindow<3>&, const RollingDrive&,
                                       const RollingStatuses&);
template RollingSolution solve_rolling_from(RollingWindow<2>&, const RollingDrive&,
                                            const RollingSolution&);
template RollingSolution solve_rolling_from(RollingWindow<3>&, const RollingDrive&,
                                            const RollingSolution&);

}  // namespace rondo::statics
