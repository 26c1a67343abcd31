// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady_solid/solid_newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "rondo/contact/cone.hpp"
#include "rondo/statics/steady_solid/solid_groups.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;

constexpr int most_newton_steps = 60, most_trials = 40, newton_rounds = 8, sweeps_a_round = 40;
constexpr int most_without_gain = 15;  // steps of Newton's method
constexpr double as_good_as_zero = 1e-14;

Vec3 vec3(const Eigen::VectorXd& all, Index at) noexcept {
  return {all[at], all[at + 1], all[at + 2]};
}

double residual_of(const SolidRollingProblem& problem, const SolidRollingPoint& p,
                   const Eigen::VectorXd& moved, double friction) {
  double largest = 0.0, force = 0.0;
  for (Index row = 0; row < p.force.size(); row += 3) {
    const double stiffness = 1.0 / std::abs(problem.matrix(row, row));
    const Vec3 r = vec3(p.force, row);
    const double residual = contact::law_residual(r, vec3(moved, row), 0.0, friction, stiffness);
    if (!std::isfinite(residual)) return residual;
    largest = std::max(largest, residual);
    force = std::max(force, norm(r));
  }
  return largest == 0.0 ? 0.0 : largest / force;
}

bool all_open(const SolidStatuses& s) {
  return std::ranges::all_of(s.of, [](Status f) { return f == Status::open; });
}

/// The torque, which is not linear, is as asked for to round-off: the square of what is left.
bool is_near(const SolidRollingPoint& point, const SolidRollingPoint& before) {
  const double change = (point.force - before.force).cwiseAbs().maxCoeff();
  return change <= 1e-8 * point.force.cwiseAbs().maxCoeff();
}

/// Until the residual is round-off, or no longer falls; the best point stays.
void newton(const SolidRollingProblem& problem, const SolidRollingDrive& drive,
            SolidRollingState& s) {
  SolidRollingPoint point = s.point;
  SolidStatuses statuses = s.statuses;
  s.residual = std::numeric_limits<double>::infinity();
  int without_gain = 0;
  for (int n = 0; n < most_newton_steps && s.work < most_solid_work; ++n) {
    ++s.newton_steps;
    s.touches = !all_open(statuses);
    if (!s.touches) return;
    const SolidSystem system(problem, drive, statuses, point);
    s.work += system.work();
    SolidRollingPoint next = system.solve();
    if (!next.force.allFinite()) return;
    const Eigen::VectorXd moved = gaps_and_ways(problem, drive.slip_angle, next);
    const double residual = residual_of(problem, next, moved, drive.friction);
    const bool better = residual < s.residual;
    without_gain = better ? 0 : without_gain + 1;
    const bool settled = s.solved() && !(residual < 0.1 * s.residual);
    const bool near = !drive.torque || is_near(next, point);
    point = std::move(next);
    statuses = statuses_of(problem, point, moved, drive.friction);
    if (better || (s.solved() && residual <= solid_residual_bound)) {
      s.point = point;
      s.statuses = statuses;
      s.residual = residual;
    }
    const bool done = near && (s.residual <= as_good_as_zero || settled);
    if (done || without_gain == most_without_gain) return;
  }
}

/// In the order in which the material comes by.
std::vector<Index> order_of(const SolidRollingProblem& problem, int back) {
  std::vector<Index> order(problem.pairs.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, [&](Index a, Index b) {
    return back * problem.pairs[static_cast<std::size_t>(a)].sample >
           back * problem.pairs[static_cast<std::size_t>(b)].sample;
  });
  return order;
}

/// Each pair's force by the law, those of all others as they are.
void sweep(const SolidRollingProblem& problem, const SolidRollingDrive& drive, int back,
           SolidRollingState& s) {
  Eigen::VectorXd moved = gaps_and_ways(problem, drive.slip_angle, s.point);
  const std::vector<Index> order = order_of(problem, back);
  for (int n = 0; n < sweeps_a_round; ++n, ++s.sweeps)
    for (const Index pair : order) {
      const Index row = 3 * pair;
      const Eigen::Matrix3d own = problem.matrix.block<3, 3>(row, row);
      contact::SpatialProblem local;
      const Eigen::Vector3d before = s.point.force.segment<3>(row);
      const Eigen::Vector3d free = moved.segment<3>(row) - own * before;
      local.free = {free[0], free[1], free[2]};
      for (Index c = 0; c < 3; ++c)
        local.delassus[static_cast<std::size_t>(c)] = {own(c, 0), own(c, 1), own(c, 2)};
      const Vec3 r = contact::solve_spatial(local, drive.friction).impulse;
      const Eigen::Vector3d change = Eigen::Vector3d{r.x, r.y, r.z} - before;
      if (change.isZero(0.0) || !change.allFinite()) continue;
      s.point.force.segment<3>(row) += change;
      moved += problem.matrix.middleCols<3>(row) * change;
    }
  const auto size = static_cast<double>(problem.size());
  s.work += 2.0 * sweeps_a_round * size * size;
  s.statuses = statuses_of(problem, s.point, moved, drive.friction);
}

void look(const SolidRollingProblem& problem, const SolidRollingDrive& drive,
          SolidRollingState& s) {
  const Eigen::VectorXd moved = gaps_and_ways(problem, drive.slip_angle, s.point);
  s.statuses = statuses_of(problem, s.point, moved, drive.friction);
}

/// Without friction; where that does not end, from the solution on groups of pairs, and that from
/// the one on groups of these.
void start_smooth(const SolidRollingProblem& problem, const SolidRollingDrive& drive,
                  SolidRollingState& s) {
  look(problem, drive, s);
  const SolidRollingState begin = s;
  newton(problem, drive, s);
  if (s.solved()) return;
  const SolidGroups groups = grouped(problem);
  if (2 * groups.problem.pairs.size() > problem.pairs.size()) return;
  SolidRollingState few = begin;
  few.work = s.work;
  few.newton_steps = s.newton_steps;
  few.point.force = gathered(groups, begin.point.force);
  start_smooth(groups.problem, drive, few);
  if (!few.touches) return;
  s = std::move(few);
  s.point.force = spread(groups, s.point.force);
  look(problem, drive, s);
  newton(problem, drive, s);
}

/// What sticks and slides by the forces without friction.
void start(const SolidRollingProblem& problem, const SolidRollingDrive& drive,
           SolidRollingState& s) {
  SolidRollingDrive smooth = drive;
  smooth.friction = 0.0;
  smooth.traction.reset();
  smooth.torque.reset();
  smooth.speed = s.point.speed;
  start_smooth(problem, smooth, s);
  if (s.touches) look(problem, drive, s);
}

bool is_fixed(const SolidRollingDrive& d) {
  return !d.load && !d.traction && !d.torque;
}

/// By less friction first: what slides there shows where it does with more.
void raise_friction(const SolidRollingProblem& problem, const SolidRollingDrive& drive,
                    SolidRollingState& s) {
  SolidRollingDrive less = drive;
  for (const double share : {0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0}) {
    less.friction = share * drive.friction;
    if (share == 0.1)
      start(problem, less, s);
    else
      look(problem, less, s);
    if (s.touches) newton(problem, less, s);
    if (!s.touches) return;
  }
}

/// With height and speed as they are.
void solve_at(const SolidRollingProblem& problem, const SolidRollingDrive& drive, int back,
              SolidRollingState& s) {
  start(problem, drive, s);
  SolidRollingState from = s;
  if (s.touches) newton(problem, drive, s);
  if (s.touches && !s.solved()) raise_friction(problem, drive, s);
  for (int n = 0; n < newton_rounds && s.touches && !s.solved() && s.work < most_solid_work; ++n) {
    from.newton_steps = s.newton_steps;
    from.work = s.work;
    from.sweeps = s.sweeps;
    sweep(problem, drive, back, from);
    s = from;
    newton(problem, drive, s);
  }
}

/// What is left of load, and of traction or torque, and how it changes with height and speed; of
/// what is not asked for, height and speed stay.
struct Miss {
  Eigen::Vector2d left = Eigen::Vector2d::Zero();
  Eigen::Matrix2d change = Eigen::Matrix2d::Identity();
};

Miss miss_of(const SolidRollingProblem& problem, const SolidRollingDrive& drive,
             const SolidRollingState& s) {
  using F = SolidRollingForces;
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

void find_slopes(const SolidRollingProblem& problem, const SolidRollingDrive& drive,
                 SolidRollingState& s) {
  s.slopes = SolidSystem(problem, drive, s.statuses, s.point).slopes();
}

/// Height and speed that bring load, traction or torque, by Newton's method: each trial is solved
/// at a given height and speed, and a step that brings it no nearer is halved.
void find_drive(const SolidRollingProblem& problem, const SolidRollingDrive& drive, int back,
                SolidRollingState& s) {
  SolidRollingDrive fixed = drive;
  fixed.load.reset();
  fixed.traction.reset();
  fixed.torque.reset();
  Eigen::Vector2d at{s.point.height, s.point.speed}, step = Eigen::Vector2d::Zero();
  double nearest = std::numeric_limits<double>::infinity();
  SolidRollingState trial = s;
  for (int n = 0; n < most_trials && at.allFinite() && trial.work < most_solid_work; ++n) {
    fixed.height = trial.point.height = at[0];
    fixed.speed = trial.point.speed = at[1];
    solve_at(problem, fixed, back, trial);
    if (trial.solved()) find_slopes(problem, fixed, trial);
    const Miss miss = trial.solved() ? miss_of(problem, drive, trial) : Miss{};
    const double distance = miss.left.norm();
    if (trial.solved() && distance < nearest) {
      nearest = distance;
      SolidRollingState last = trial;  // exactly, if its statuses are those asked for
      newton(problem, drive, last);
      trial.newton_steps = last.newton_steps;
      trial.work = last.work;
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

double solid_residual(const SolidRollingProblem& problem, double slip_angle,
                      const SolidRollingPoint& point, double friction) {
  return residual_of(problem, point, gaps_and_ways(problem, slip_angle, point), friction);
}

void solve_rolling(const SolidRollingProblem& problem, const SolidRollingDrive& drive, int back,
                   SolidRollingState& state) {
  const SolidRollingPoint begin = state.point;
  if (is_fixed(drive)) {
    solve_at(problem, drive, back, state);
  } else {
    start(problem, drive, state);
    if (state.touches) newton(problem, drive, state);
    if (state.touches && !state.solved()) {
      state.point = begin;
      find_drive(problem, drive, back, state);
    }
  }
  if (state.solved()) find_slopes(problem, drive, state);
}

}  // namespace rondo::statics
