// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "rondo/core/process_wide.hpp"
#include "rondo/statics/steady/rolling_newton.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;

constexpr int most_rounds = 60;

/// The speed is asked for, and nothing that sticks tells it.
bool slides(const RollingDrive& drive, const RollingState& s) {
  const bool sticks =
      std::ranges::any_of(s.found, [](const auto& f) { return f.status == Status::stick; });
  return (drive.traction || drive.torque) && !sticks;
}

void fill(const RollingProblem& problem, const RollingState& state, RollingSolution& s) {
  const RollingPoint& p = state.point;
  s.height = p.height;
  s.speed = p.speed;
  s.force = p.force;
  s.status = state.found;
  s.residual = state.residual;
  s.gap_and_slip = gaps_and_ways(problem, p);
  s.gap_and_slip(Eigen::seqN(1, p.force.size() / 2, 2)) /= problem.time;
  s.forces = forces_of(problem, p);
  s.slopes = state.slopes;
}

/// Load, traction and torque are those asked for, of the size of what bears them.
bool brings(const RollingDrive& drive, const RollingSolution& s) {
  const double size = std::abs(s.forces.x) + std::abs(s.forces.y);
  const auto near = [&](const std::optional<double>& asked, double found, double arm) {
    return !asked || std::abs(found - *asked) <= 1e-10 * size * arm;
  };
  return near(drive.load, s.forces.y, 1.0) && near(drive.traction, s.forces.x, 1.0) &&
         near(drive.torque, s.forces.torque, s.height);
}

/// Nothing of the height that was tried is left, or nothing was found.
RollingSolution nothing(const RollingWindow& window, const RollingPoint& point, RollingSolution s) {
  s.height = point.height;
  s.speed = point.speed;
  s.force = Eigen::VectorXd::Zero(window.problem().base.size());
  s.gap_and_slip = s.force;
  s.status.assign(window.pairs().size(), {});
  return s;
}

}  // namespace

double lowest_place(const RollingWindow& w) {
  const RollingHarmonics& h = w.harmonics();
  double least = 0.0;
  for (std::size_t a = 0; a < h.n_candidates(); ++a) least = std::max(least, norm(h.place(a, 0)));
  return least;
}

RollingSolution solve_rolling(RollingWindow& window, const RollingDrive& drive,
                              const std::vector<RollingStatus>& from) {
  const OneBlasThread one_thread;
  const double radius = lowest_place(window);
  RollingSolution s;
  RollingState state;
  state.point.height = drive.load ? radius * (1.0 - 1e-3) : drive.height;
  state.point.speed = drive.speed;
  window.include_below(state.point.height);
  state.found = from;
  int unsolved = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const RollingProblem& problem = window.problem();
    s.end = problem.pairs.empty() ? RollingEnd::no_contact : RollingEnd::not_solved;
    if (problem.pairs.empty()) break;
    if (state.found.empty()) state = rolling_start(problem, drive, state.point);
    state.found.resize(problem.pairs.size());
    state.point.force.conservativeResizeLike(Eigen::VectorXd::Zero(problem.base.size()));
    solve_rolling(problem, drive, state);
    s.newton_steps += std::exchange(state.newton_steps, 0);
    s.pivots += std::exchange(state.pivots, 0);
    if (!state.touches) {
      s.end = RollingEnd::no_contact;
      if (!drive.load) break;
      // Nothing is left that touches: from further down.
      state.point.height = radius * (1.0 - 2e-3 * (round + 1));
      window.include_below(state.point.height);
      state.found.clear();
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
  return nothing(window, state.point, std::move(s));
}

double rolling_residual(const RollingWindow& window, const RollingSolution& s, double friction) {
  return rolling_residual(window.problem(), {s.force, s.height, s.speed}, friction);
}

}  // namespace rondo::statics
