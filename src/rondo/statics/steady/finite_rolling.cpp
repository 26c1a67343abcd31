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
using Eigen::VectorXd;

constexpr std::size_t depth = 24;  // of the acceleration
constexpr int most_turns = 200;
constexpr int turns_without_gain = 30;       // that do not halve the residual
constexpr double far_out_of_balance = 5e-3;  // residual above which each step has its own tangent
constexpr double much_nearer = 0.2;          // a residual over that of the tangent
constexpr double near_the_end = 1e-4;        // residual where the last tangent may be taken
constexpr double at_rest = 1e-11;            // residual below which the iteration has come to rest
constexpr double hopeless = 20.0;            // a residual that is so many times the least
constexpr double near_enough = 1e-2;         // residual at the end of a part before the last
constexpr double least_part = 1.0 / 64.0;
constexpr double largest_change = 10.0;  // over the displacement: beyond it nothing converges

double largest(const MatrixXd& a) noexcept {
  return a.cwiseAbs().maxCoeff();
}

VectorXd as_long_as(VectorXd force, Index size) {
  force.conservativeResizeLike(VectorXd::Zero(size));
  return force;
}

/// Where a step begins.
struct Point {
  MatrixXd u;
  VectorXd force;  ///< (D pairs so far) of contact
};

class Solver {
 public:
  Solver(RollingWindow<3>& window, RollingRemainder& remainder)
      : window_(window), remainder_(remainder) {}

  /// From a state on: with its tangent, or from where the body just touches. @return whether the
  /// tangent is positive definite
  bool begin(const FiniteRolling& state, bool has_moved);
  /// From the fields so far to the state under a drive, or near it if more of the way follows.
  /// @return whether it was found
  bool go(const RollingDrive& drive, bool is_last, FiniteRolling& state);

 private:
  bool turn(const RollingDrive& drive, const Point& at, FiniteRolling& state);
  bool take_tangent(const MatrixXd& u);
  void foresee(const Point& at);
  [[nodiscard]] bool is_balanced(FiniteRolling& state);
  [[nodiscard]] Point next(const FiniteRolling& state, Point at, const MatrixXd& left);
  [[nodiscard]] Point accelerated(const Point& at, const Point& next);

  RollingWindow<3>& window_;
  RollingRemainder& remainder_;
  Anderson acceleration_{depth};
  bool has_tangent_ = false;
};

bool Solver::take_tangent(const MatrixXd& u) {
  acceleration_.restart();
  has_tangent_ = remainder_.take_tangent(u, window_.pairs());
  if (has_tangent_)
    window_.soften([&remainder = remainder_](const RollingPair& of, const RollingPair& by) {
      return remainder.softness(of, by);
    });
  return has_tangent_;
}

bool Solver::begin(const FiniteRolling& state, bool has_moved) {
  if (has_moved) return take_tangent(state.u);
  has_tangent_ = false;
  window_.soften({});
  return true;
}

/// Contact is solved for where Newton's step leads to under forces λ, u + K'^-1 (r + λ - λ'), of
/// which the harmonics alone have where K leads to. At u and the forces λ' so far, r is what is out
/// of balance.
void Solver::foresee(const Point& at) {
  RollingSolution now;
  now.force = as_long_as(at.force, window_.problem().size());
  const MatrixXd way = window_.harmonics().fields(spectrum_of(window_, now), 0.0, false) - at.u;
  MatrixXd more = -way;
  remainder_.move(remainder_.linear(way), more);
  window_.foresee(now.force, more);
}

/// The state under the remainder at a point.
bool Solver::turn(const RollingDrive& drive, const Point& at, FiniteRolling& state) {
  if (!remainder_.find(at.u, state.remainder) || !state.remainder.allFinite()) return false;
  window_.take_response(window_.harmonics().response(-state.remainder));
  if (has_tangent_) foresee(at);
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

/// By how much the load that the state is in equilibrium with differs from that of its own fields.
bool Solver::is_balanced(FiniteRolling& state) {
  if (!remainder_.find(state.u, state.own_remainder)) return false;
  state.effort.residual =
      largest(state.own_remainder - state.remainder) / std::abs(state.solution.forces.normal);
  return state.effort.residual <= finite_rolling_bound;
}

/// Newton's step: K' (next - u) = K (state - u), with the tangent K' near u.
Point Solver::next(const FiniteRolling& state, Point at, const MatrixXd& left) {
  if (has_tangent_)
    remainder_.move(left, at.u);
  else
    at.u = state.u;
  at.force = state.solution.force;
  return at;
}

/// Fields, and forces as the displacements that they make.
Point Solver::accelerated(const Point& at, const Point& next) {
  const Index fields = at.u.size(), forces = next.force.size();
  if (at.force.size() != forces) acceleration_.restart();
  const double compliance = window_.problem().matrix.diagonal().cwiseAbs().mean();
  VectorXd from(fields + forces), to(fields + forces);
  from << at.u.reshaped(), compliance * as_long_as(at.force, forces);
  to << next.u.reshaped(), compliance * next.force;
  const VectorXd found = acceleration_.next(from, to);
  return {found.head(fields).reshaped(at.u.rows(), at.u.cols()), found.tail(forces) / compliance};
}

/// Far out of balance each step of Newton's method has its own tangent. Near it the tangent stays,
/// and what it lacks, inertia and damping, is left to the acceleration.
bool Solver::go(const RollingDrive& drive, bool is_last, FiniteRolling& state) {
  acceleration_.restart();
  Point at{state.u, state.solution.force};
  double best = std::numeric_limits<double>::infinity();
  double last = best;
  double of_tangent = best;  // the residual where it was taken
  bool is_old = false;       // the tangent
  int gained = 0;
  for (int n = 0; state.effort.turns < most_turns; ++n) {
    if (is_old && !take_tangent(at.u)) return false;
    if (!turn(drive, at, state)) return false;
    const MatrixXd way = state.u - at.u, left = remainder_.linear(way);
    const double residual = largest(left) / std::abs(state.solution.forces.normal);
    state.effort.residual = residual;
    if (is_old) of_tangent = residual;
    const bool rests = residual <= at_rest || residual > 0.5 * last;  // or is down to round-off
    if (is_last && rests && residual <= finite_rolling_bound && of_tangent <= near_the_end &&
        is_balanced(state))
      return true;
    if (!is_last && residual <= near_enough) {
      state.u = next(state, std::move(at), left).u;
      return true;
    }
    if (n > 0 && residual < 0.5 * best) best = residual, gained = n;
    if (!(largest(way) < largest_change * largest(state.u)) || n - gained > turns_without_gain ||
        residual > hopeless * best)
      return false;
    is_old = residual > far_out_of_balance ||
             (is_last && of_tangent > near_the_end && residual < much_nearer * of_tangent);
    last = residual;
    Point to = next(state, at, left);
    at = is_old ? std::move(to) : accelerated(at, to);
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
  bool can_go_on = solver.begin(found, near != nullptr);
  while (can_go_on && done < 1.0) {
    FiniteRolling next = found;
    const double to = std::min(1.0, done + step);
    if (solver.go(part_of(drive, from, to), to == 1.0, next)) {
      next.effort.parts = found.effort.parts + 1;
      done = to;
      found = std::move(next);
      continue;
    }
    step *= 0.5;
    can_go_on = step >= least_part && next.effort.turns < most_turns && !never(next, done) &&
                solver.begin(found, near || done > 0.0);
    found.effort.turns = next.effort.turns;
    if (can_go_on) continue;
    found.solution = std::move(next.solution);
    found.effort = next.effort;
  }
  // What leaves the ground on the way, after the linear problem had a solution, tells nothing.
  if (done < 1.0 && (found.solution.end == RollingEnd::solved || found.effort.turns > 1))
    found.solution.end = RollingEnd::not_solved;
  window.soften({});  // the tangent is not the window's
  return found;
}

}  // namespace rondo::statics
