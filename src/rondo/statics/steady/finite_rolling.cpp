// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/finite_rolling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/core/process_wide.hpp"
#include "rondo/statics/anderson.hpp"
#include "rondo/statics/steady/rolling_power.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t depth = 24;
constexpr int most_turns = 200;
constexpr int turns_without_gain = 40;  // that do not halve the residual
// The stiffness near the ground is factored after so many turns, far out of balance and near.
constexpr double far_out_of_balance = 5e-3;
constexpr int turns_far = 3, turns_near = 30;
constexpr double near_enough = 1e-3;  // residual at the end of a part before the last
constexpr double least_part = 1.0 / 64.0;
constexpr double largest_change = 10.0;  // over the displacement: beyond it nothing converges

Eigen::Map<const Eigen::VectorXd> flat(const MatrixXd& a) noexcept {
  return {a.data(), a.size()};
}

class Solver {
 public:
  Solver(RollingWindow<3>& window, RollingRemainder& remainder)
      : window_(window), remainder_(remainder) {}

  /// From the fields so far to the state under a drive. @return whether it was found
  bool go(const RollingDrive& drive, double bound, FiniteRolling& state);

 private:
  bool turn(const RollingDrive& drive, const MatrixXd& u, FiniteRolling& state);
  [[nodiscard]] std::vector<RollingPair> pressed(const RollingSolution& solution) const;

  RollingWindow<3>& window_;
  RollingRemainder& remainder_;
};

std::vector<RollingPair> Solver::pressed(const RollingSolution& solution) const {
  std::vector<RollingPair> pairs;
  for (std::size_t j = 0; j < window_.pairs().size(); ++j)
    if (solution.force[static_cast<Index>(3 * j)] > 0.0) pairs.push_back(window_.pairs()[j]);
  return pairs;
}

/// The state under the remainder at u.
bool Solver::turn(const RollingDrive& drive, const MatrixXd& u, FiniteRolling& state) {
  if (!remainder_.find(u, state.remainder) || !state.remainder.allFinite()) return false;
  window_.take_response(window_.harmonics().response(-state.remainder));
  const RollingEffort before = state.solution.effort;
  state.solution = solve_rolling_from(window_, drive, state.solution);
  state.solution.effort.newton_steps += before.newton_steps;
  state.solution.effort.sweeps += before.sweeps;
  ++state.effort.turns;
  if (state.solution.end != RollingEnd::solved) return false;
  state.spectrum = spectrum_of(window_, state.solution);
  state.u = window_.harmonics().fields(state.spectrum, 0.0, false);
  return true;
}

bool Solver::go(const RollingDrive& drive, double bound, FiniteRolling& state) {
  Anderson acceleration(depth);
  MatrixXd u = state.u, left;
  double best = std::numeric_limits<double>::infinity();
  int factored = -turns_near, gained = 0;
  for (int n = 0; state.effort.turns < most_turns; ++n) {
    if (!turn(drive, u, state) || !remainder_.find(state.u, left)) return false;
    left -= state.remainder;
    const double residual = left.cwiseAbs().maxCoeff() / std::abs(state.solution.forces.normal);
    state.effort.residual = residual;
    if (residual <= bound) return true;
    if (residual < 0.5 * best) best = residual, gained = n;
    const double change = (state.u - u).cwiseAbs().maxCoeff();
    if (!(change < largest_change * state.u.cwiseAbs().maxCoeff()) ||
        n - gained > turns_without_gain)
      return false;
    if (n - factored >= (residual > far_out_of_balance ? turns_far : turns_near)) {
      remainder_.take_stiffness(state.u, pressed(state.solution));
      acceleration.restart();
      factored = n;
    }
    MatrixXd to = state.u;
    remainder_.correct(left, to);
    const Eigen::VectorXd next = acceleration.next(flat(u), flat(to));
    u = Eigen::Map<const MatrixXd>(next.data(), u.rows(), u.cols());
  }
  return false;
}

/// Where the way to a state begins: where the body just touches, or at another state.
struct Beginning {
  double height = 0.0, load = 0.0;
};

/// A part of the way.
RollingDrive part_of(const RollingDrive& drive, const Beginning& from, double part) {
  RollingDrive d = drive;
  if (d.load)
    d.load = from.load + part * (*drive.load - from.load);
  else
    d.height = from.height + part * (drive.height - from.height);
  return d;
}

/// Not even the linear problem has a solution: a smaller part has none either, or tells nothing.
bool never(const FiniteRolling& state, double done) {
  return done == 0.0 && state.effort.turns == 1 && state.solution.end != RollingEnd::solved;
}

}  // namespace

FiniteRolling solve_finite_rolling(RollingWindow<3>& window, const RollingDrive& drive,
                                   RollingRemainder& remainder, const FiniteRolling* near) {
  const OneBlasThread one_thread;
  const RollingHarmonics<3>& h = window.harmonics();
  Beginning from{window.lowest(), 0.0};
  FiniteRolling found;
  if (near) {
    found = *near;
    found.effort = {};
    found.solution.effort = {};
    from = {near->solution.height, near->solution.forces.normal};
  } else {
    found.u = MatrixXd::Zero(static_cast<Index>(3 * h.body().stiffness.n_local()), h.turn());
  }
  Solver solver(window, remainder);
  double done = 0.0, step = 1.0;
  while (done < 1.0) {
    FiniteRolling next = found;
    const double to = std::min(1.0, done + step);
    const bool there =
        solver.go(part_of(drive, from, to), to < 1.0 ? near_enough : finite_rolling_bound, next);
    found.effort.turns = next.effort.turns;
    if (!there) {
      step *= 0.5;
      if (step >= least_part && next.effort.turns < most_turns && !never(next, done)) continue;
      found.solution = std::move(next.solution);
      if (found.solution.end == RollingEnd::solved) found.solution.end = RollingEnd::not_solved;
      found.effort = next.effort;
      return found;
    }
    next.effort.parts = found.effort.parts + 1;
    done = to;
    found = std::move(next);
  }
  return found;
}

}  // namespace rondo::statics
