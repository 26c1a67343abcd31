// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady_solid/solid_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "rondo/core/process_wide.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;

constexpr int contact_rounds = 60;

/// The speed is asked for, and nothing that sticks tells it.
bool slides(const SolidRollingDrive& drive, const SolidRollingState& s) {
  const bool sticks = std::ranges::find(s.statuses.of, Status::stick) != s.statuses.of.end();
  return (drive.traction || drive.torque) && !sticks;
}

void fill(const SolidRollingProblem& problem, const SolidRollingState& state,
          SolidRollingSolution& s) {
  const SolidRollingPoint& p = state.point;
  s.height = p.height;
  s.speed = p.speed;
  s.force = p.force;
  s.status = state.statuses.of;
  s.residual = state.residual;
  s.gap_and_slip = gaps_and_ways(problem, s.slip_angle, p);
  for (Index j = 0; j < s.force.size(); j += 3) s.gap_and_slip.segment<2>(j + 1) /= problem.time;
  s.place = places(problem, p.force);
  s.forces = forces_of(problem, p);
  s.slopes = state.slopes;
}

/// Load, traction and torque are those asked for, of the size of what bears them.
bool brings(const SolidRollingDrive& drive, const SolidRollingSolution& s) {
  const double size = std::abs(s.forces.heading) + std::abs(s.forces.normal);
  const auto near = [&](const std::optional<double>& asked, double found, double arm) {
    return !asked || std::abs(found - *asked) <= 1e-10 * size * arm;
  };
  return near(drive.load, s.forces.normal, 1.0) && near(drive.traction, s.forces.heading, 1.0) &&
         near(drive.torque, s.forces.torque, s.height);
}

/// Nothing of the height that was tried is left, or nothing was found.
SolidRollingSolution nothing(const SolidRollingProblem& problem, const SolidRollingPoint& point,
                             SolidRollingSolution s) {
  s.height = point.height;
  s.speed = point.speed;
  s.force = Eigen::VectorXd::Zero(problem.size());
  s.gap_and_slip = s.force;
  s.place = Eigen::VectorXd::Zero(problem.base_place.size());
  s.status.assign(problem.pairs.size(), Status::open);
  return s;
}

}  // namespace

SolidRollingSolution solve_rolling(SolidWindow& window, const SolidRollingDrive& drive) {
  const OneBlasThread one_thread;
  const double radius = window.lowest();
  SolidRollingSolution s;
  s.slip_angle = drive.slip_angle;
  SolidRollingState state;
  state.point.height = drive.load ? radius * (1.0 - 1e-3) : drive.height;
  state.point.speed = drive.speed;
  window.include_below(state.point.height);
  int unsolved = 0;
  for (int round = 0; round < contact_rounds; ++round) {
    const SolidRollingProblem& problem = window.problem();
    s.end = problem.pairs.empty() ? RollingEnd::no_contact : RollingEnd::not_solved;
    if (problem.pairs.empty()) break;
    state.point.force.conservativeResizeLike(Eigen::VectorXd::Zero(problem.size()));
    solve_rolling(problem, drive, window.back(), state);
    s.newton_steps += std::exchange(state.newton_steps, 0);
    s.sweeps += std::exchange(state.sweeps, 0);
    s.work = state.work;
    if (!state.touches) {
      s.end = RollingEnd::no_contact;
      if (!drive.load) break;
      // Nothing is left that touches: from further down.
      state.point = {{}, radius * (1.0 - 2e-3 * (round + 1)), drive.speed};
      window.include_below(state.point.height);
      continue;
    }
    // Forces that are no solution leave all sorts of pairs in the ground: no further than once
    // more.
    const bool may_grow = state.solved() || ++unsolved < 2;
    if (may_grow && window.include_touching(state.point.height, state.point.force)) continue;
    fill(window.problem(), state, s);
    if (state.solved() && brings(drive, s))
      s.end = RollingEnd::solved;
    else if (slides(drive, state))
      s.end = RollingEnd::sliding;
    return s;
  }
  return nothing(window.problem(), state.point, std::move(s));
}

}  // namespace rondo::statics
