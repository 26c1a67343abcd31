// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/contact/cone.hpp"
#include "rondo/contact/residual.hpp"
#include "rondo/core/index.hpp"
#include "rondo/statics/steady/law/rolling_law.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;

constexpr int most_trials = 40;
constexpr double most_systems = 80.0;  // of all pairs, in space

/// In space what so many steps of Newton's method take where all pairs are closed, and twice as
/// many where only some are, as it mostly is: enough to raise the friction in parts.
template <int D>
double most_work(const RollingProblem<D>& problem, const RollingEffort& effort) {
  if (D == 2) return effort.most;
  return std::max(effort.most,
                  most_systems * 2.0 / 3.0 * std::pow(static_cast<double>(problem.size()), 3));
}

/// In space from the forces of a state that is solved; where they are not near enough, from the
/// solution on groups of pairs; where that does not lead to one, and in the plane, from where the
/// law begins.
template <int D>
void attempt(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& s) {
  if (D == 3 && s.solved()) {
    RollingState near = s;
    look(problem, drive, near);
    newton(problem, drive, near);
    s.effort = near.effort;
    if (near.solved()) {
      s = std::move(near);
      return;
    }
  }
  begin(problem, drive, s);
  if (!s.touches) return;
  if constexpr (D == 3) {
    RollingState coarse = s;
    const bool has_start = refine(problem, drive, coarse);
    if (has_start) newton(problem, drive, coarse);
    s.effort = coarse.effort;
    if (has_start && coarse.solved()) {
      s = std::move(coarse);
      return;
    }
  }
  newton(problem, drive, s);
}

/// With height and speed as they are.
template <int D>
void solve_at(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& s) {
  attempt(problem, drive, s);
  if (s.touches && !s.solved()) rescue(problem, drive, s);
}

/// What is left of load, and of traction or torque, and how it changes with height and speed; of
/// what is not asked for, height and speed stay.
struct Miss {
  Eigen::Vector2d left = Eigen::Vector2d::Zero();
  Eigen::Matrix2d change = Eigen::Matrix2d::Identity();
};

template <int D>
Miss miss_of(const RollingProblem<D>& problem, const RollingDrive& drive, const RollingState& s) {
  using F = RollingForces;
  const F now = forces_of(problem, s.point);
  const auto row = [&](double wanted, double F::*of, Index at, Miss& miss) {
    miss.left[at] = wanted - now.*of;
    miss.change.row(at) << s.slopes.by_height.forces.*of, s.slopes.by_speed.forces.*of;
  };
  Miss miss;
  if (drive.load) row(*drive.load, &F::normal, 0, miss);
  if (drive.traction) row(*drive.traction, &F::heading, 1, miss);
  if (drive.torque) row(*drive.torque, &F::torque, 1, miss);
  return miss;
}

/// Height and speed that bring load, traction or torque, by Newton's method: each trial is solved
/// at a given height and speed, and a step that brings it no nearer is halved.
template <int D>
void find_drive(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& s) {
  RollingDrive fixed = drive;
  fixed.load.reset();
  fixed.traction.reset();
  fixed.torque.reset();
  Eigen::Vector2d at{s.point.height, s.point.speed}, step = Eigen::Vector2d::Zero();
  double nearest = std::numeric_limits<double>::infinity();
  RollingState trial = s;
  for (int n = 0; n < most_trials && at.allFinite() && !trial.effort.spent(); ++n) {
    fixed.height = trial.point.height = at[0];
    fixed.speed = trial.point.speed = at[1];
    solve_at(problem, fixed, trial);
    if constexpr (D == 3) add_slopes(problem, fixed, trial);
    const Miss miss = trial.solved() ? miss_of(problem, drive, trial) : Miss{};
    const double distance = miss.left.norm();
    if (trial.solved() && distance < nearest) {
      nearest = distance;
      RollingState last = trial;  // exactly, if its statuses are those asked for
      newton(problem, drive, last);
      trial.effort = last.effort;
      if (last.solved()) {
        s = std::move(last);
        return;
      }
      step = miss.change.fullPivLu().solve(miss.left);
    } else if (step.isZero(0.0)) {
      break;  // nothing to halve: the same trial would end the same
    } else {
      at -= step;
      step *= 0.5;
    }
    at += step;
  }
  s = std::move(trial);
  s.residual = std::numeric_limits<double>::infinity();  // of another load or traction
}

}  // namespace

template <int D>
double residual_of(const RollingProblem<D>& problem, const RollingPoint& p,
                   const Eigen::VectorXd& moved, const PairCoefficients& friction) {
  double largest = 0.0, force = 0.0;
  for (Index row = 0; row < p.force.size(); row += D) {
    const double stiffness = 1.0 / std::abs(problem.matrix(row, row));
    const auto r = vec_of(NodeVector<D>(p.force.segment<D>(row)));
    const auto v = vec_of(NodeVector<D>(moved.segment<D>(row)));
    const double residual = contact::law_residual(r, v, 0.0, friction[at(row / D)], stiffness);
    if (!std::isfinite(residual)) return residual;
    largest = std::max(largest, residual);
    force = std::max(force, norm(r));
  }
  return largest == 0.0 ? 0.0 : largest / force;
}

bool all_open(const RollingStatuses& statuses) {
  return std::ranges::all_of(
      statuses, [](const RollingStatus& s) { return s.status == contact::Status::open; });
}

bool is_near(const RollingPoint& point, const RollingPoint& before) {
  const double change = (point.force - before.force).cwiseAbs().maxCoeff();
  return change <= 1e-8 * point.force.cwiseAbs().maxCoeff();
}

template <int D>
RollingState without_forces(const RollingProblem<D>& problem, const RollingDrive& drive,
                            const RollingPoint& point) {
  RollingState s{.point = {Eigen::VectorXd::Zero(problem.size()), point.height, point.speed}};
  look(problem, drive, s);
  return s;
}

template <int D>
void look(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& s) {
  const Eigen::VectorXd moved = gaps_and_ways(problem, s.point, drive.path());
  s.statuses = statuses_of(problem, s.point, moved, drive.coefficients());
}

template <int D>
double rolling_residual(const RollingProblem<D>& problem, const RollingPoint& point,
                        const RollingPath& path, const PairCoefficients& friction) {
  return residual_of(problem, point, gaps_and_ways(problem, point, path), friction);
}

/// In space less friction leads to load, traction and torque at once, and fixed heights and speeds
/// are the last resort. In the plane what the whole search did not solve is left as Newton's method
/// left it: where all slides, its statuses tell.
template <int D>
void solve_rolling(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& s) {
  if (drive.law) {
    solve_by_law(problem, drive, s);
    return;
  }
  const RollingPoint first = s.point;
  s.effort.most = most_work(problem, s.effort);
  attempt(problem, drive, s);
  if (!s.touches || s.solved()) return;
  if (D == 3 || drive.is_fixed()) rescue(problem, drive, s);
  if (drive.is_fixed() || s.solved()) return;
  RollingState found = without_forces(problem, drive, first);
  found.effort = s.effort;
  find_drive(problem, drive, found);
  s.effort = found.effort;
  if (D == 3 || found.solved()) s = std::move(found);
}

template double residual_of(const RollingProblem<2>&, const RollingPoint&, const Eigen::VectorXd&,
                            const PairCoefficients&);
template double residual_of(const RollingProblem<3>&, const RollingPoint&, const Eigen::VectorXd&,
                            const PairCoefficients&);
template RollingState without_forces(const RollingProblem<2>&, const RollingDrive&,
                                     const RollingPoint&);
template RollingState without_forces(const RollingProblem<3>&, const RollingDrive&,
                                     const RollingPoint&);
template void look(const RollingProblem<2>&, const RollingDrive&, RollingState&);
template void look(const RollingProblem<3>&, const RollingDrive&, RollingState&);
template double rolling_residual(const RollingProblem<2>&, const RollingPoint&, const RollingPath&,
                                 const PairCoefficients&);
template double rolling_residual(const RollingProblem<3>&, const RollingPoint&, const RollingPath&,
                                 const PairCoefficients&);
template void solve_rolling(const RollingProblem<2>&, const RollingDrive&, RollingState&);
template void solve_rolling(const RollingProblem<3>&, const RollingDrive&, RollingState&);

}  // namespace rondo::statics
