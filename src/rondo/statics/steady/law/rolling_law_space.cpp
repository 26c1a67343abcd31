// SPDX-License-Identifier: BSD-3-Clause
/// Pair after pair as the material passes them: Jourdan, Alart, Jean, CMAME 155 (1998) 31;
/// Vollebregt's SteadyGS.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "rondo/contact/cone.hpp"
#include "rondo/core/index.hpp"
#include "rondo/statics/steady/law/rolling_law.hpp"
#include "rondo/statics/steady/rolling_groups.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using SpaceProblem = RollingProblem<3>;

constexpr int newton_rounds = 8, sweeps_a_round = 40;
constexpr int most_without_gain = 15;  // steps of Newton's method
constexpr double as_good_as_zero = 1e-14;

/// A point, and how well it meets the law.
struct Judged {
  RollingPoint point;
  RollingStatuses statuses;  ///< by that point
  double residual;
};

Judged judged(const SpaceProblem& problem, const RollingDrive& drive, RollingPoint point) {
  const VectorXd moved = gaps_and_ways(problem, point, drive.path());
  const double residual = residual_of(problem, point, moved, drive.coefficients());
  RollingStatuses statuses = statuses_of(problem, point, moved, drive.coefficients());
  return {std::move(point), std::move(statuses), residual};
}

void keep(const Judged& found, RollingState& s) {
  s.point = found.point;
  s.statuses = found.statuses;
  s.residual = found.residual;
}

/// Until the residual is round-off, or no longer falls; the best point stays.
/// @return whether its system is solved as exactly as by factors of its own
bool search(const SpaceProblem& problem, const RollingDrive& drive, RollingState& s) {
  NearFactors near;
  RollingPoint point = s.point;
  RollingStatuses statuses = s.statuses;
  s.residual = std::numeric_limits<double>::infinity();
  int without_gain = 0;
  bool is_exact = true;
  for (int n = 0; n < most_newton_steps && !s.effort.spent(); ++n) {
    ++s.effort.newton_steps;
    s.touches = !all_open(statuses);
    if (!s.touches) break;
    RollingSystem<3> system(problem, drive, statuses, point, &near);
    s.effort.work += system.work();
    RollingPoint next = system.solve();
    if (!next.force.allFinite()) break;
    const bool is_torque_near = !drive.torque || is_near(next, point);
    Judged found = judged(problem, drive, std::move(next));
    const bool better = found.residual < s.residual;
    without_gain = better ? 0 : without_gain + 1;
    const bool settled = s.solved() && !(found.residual < 0.1 * s.residual);
    if (better || (s.solved() && found.residual <= rolling_residual_bound)) {
      keep(found, s);
      is_exact = system.is_exact();
    }
    const bool done =
        system.is_exact() && is_torque_near && (s.residual <= as_good_as_zero || settled);
    if (done || without_gain == most_without_gain) break;
    point = std::move(found.point);
    statuses = std::move(found.statuses);
  }
  return is_exact;
}

/// A step by factors of its own ends a search that has given up at a point that meets the law, but
/// whose loads are those of a system that is not solved to its end.
void iterate(const SpaceProblem& problem, const RollingDrive& drive, RollingState& s) {
  if (search(problem, drive, s) || !s.solved()) return;
  const RollingPoint around = s.point;
  RollingPoint last = RollingSystem<3>(problem, drive, s.statuses, around).solve();
  if (!last.force.allFinite()) return;
  const Judged found = judged(problem, drive, std::move(last));
  if (found.residual <= rolling_residual_bound) keep(found, s);
}

/// In the order in which the material comes by.
std::vector<Index> order_of(const SpaceProblem& problem) {
  std::vector<Index> order(problem.pairs.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](Index pair) {
    return problem.back * problem.pairs[at(pair)].sample;
  });
  return order;
}

/// Each pair's force by the law, those of all others as they are.
void sweep(const SpaceProblem& problem, const RollingDrive& drive, RollingState& s) {
  VectorXd moved = gaps_and_ways(problem, s.point, drive.path());
  const Eigen::MatrixXd matrix =
      yawing_matrix(problem, drive.turn_slip * s.point.speed * problem.time);
  const std::vector<Index> order = order_of(problem);
  for (int n = 0; n < sweeps_a_round; ++n, ++s.effort.sweeps)
    for (const Index pair : order) {
      const Index row = 3 * pair;
      const NodeMatrix<3> own = matrix.block<3, 3>(row, row);
      const double friction = drive.coefficients()[at(pair)];
      // The law of this pair alone has no single solution: it is left to the others.
      if (!(own(0, 0) > friction * std::hypot(own(0, 1), own(0, 2)))) continue;
      contact::SpatialProblem local;
      const NodeVector<3> before = s.point.force.segment<3>(row);
      local.free = vec_of(NodeVector<3>(moved.segment<3>(row) - own * before));
      for (Index c = 0; c < 3; ++c) local.delassus[at(c)] = {own(c, 0), own(c, 1), own(c, 2)};
      const NodeVector<3> change =
          node_vector(contact::solve_spatial(local, friction).impulse) - before;
      if (change.isZero(0.0) || !change.allFinite()) continue;
      s.point.force.segment<3>(row) += change;
      moved += matrix.middleCols<3>(row) * change;
    }
  const auto size = static_cast<double>(problem.size());
  s.effort.work += 2.0 * sweeps_a_round * size * size;
  s.statuses = statuses_of(problem, s.point, moved, drive.coefficients());
}

/// Without friction; where that does not end, from the solution on groups of pairs, and that from
/// the one on groups of these.
void start_smooth(const SpaceProblem& problem, const RollingDrive& drive, RollingState& s) {
  look(problem, drive, s);
  const RollingState first = s;
  iterate(problem, drive, s);
  if (s.solved()) return;
  const RollingGroups<3> groups = grouped(problem);
  if (2 * groups.problem.pairs.size() > problem.pairs.size()) return;
  RollingState few = first;
  few.effort = s.effort;
  few.point.force = gathered(groups, first.point.force);
  start_smooth(groups.problem, drive, few);
  if (!few.touches) return;
  s = std::move(few);
  s.point.force = spread(groups, s.point.force);
  look(problem, drive, s);
  iterate(problem, drive, s);
}

/// The statuses of the groups, where pairs are closed.
void take_statuses(const RollingGroups<3>& groups, const RollingStatuses& few,
                   RollingStatuses& all) {
  for (std::size_t j = 0; j < all.size(); ++j)
    if (all[j].status != contact::Status::open && few[groups.of[j]].status != contact::Status::open)
      all[j] = few[groups.of[j]];
}

/// By less friction first: what slides there shows where it does with more.
void raise_friction(const SpaceProblem& problem, const RollingDrive& drive, RollingState& s) {
  RollingDrive less = drive;
  for (const double share : {0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0}) {
    less.friction = share * drive.friction;
    if (share == 0.1)
      begin(problem, less, s);
    else
      look(problem, less, s);
    if (s.touches) iterate(problem, less, s);
    if (!s.touches) return;
  }
}

}  // namespace

/// What sticks and slides by the forces without friction.
template <>
void begin(const RollingProblem<3>& problem, const RollingDrive& drive, RollingState& s) {
  RollingDrive smooth = drive;
  smooth.friction = 0.0;
  smooth.law = nullptr;
  smooth.pairs.clear();
  smooth.traction.reset();
  smooth.torque.reset();
  smooth.speed = s.point.speed;
  start_smooth(problem, smooth, s);
  if (s.touches) look(problem, drive, s);
}

bool refine(const SpaceProblem& problem, const RollingDrive& drive, RollingState& s) {
  if (problem.before.size() > 0) return false;  // groups do not have what the step before added
  const RollingGroups<3> groups = grouped(problem);
  if (2 * groups.problem.pairs.size() > problem.pairs.size()) return false;
  RollingDrive of_groups = drive;
  of_groups.pairs = gathered(groups, drive.pairs);
  RollingState few = s;
  few.point.force = gathered(groups, s.point.force);
  look(groups.problem, of_groups, few);
  iterate(groups.problem, of_groups, few);
  s.effort = few.effort;
  if (!few.touches || !few.solved()) return false;
  take_statuses(groups, few.statuses, s.statuses);
  s.point = {spread(groups, few.point.force), few.point.height, few.point.speed};
  return true;
}

template <>
void newton(const RollingProblem<3>& problem, const RollingDrive& drive, RollingState& s) {
  iterate(problem, drive, s);
}

/// By less friction; then from sweeps.
template <>
void rescue(const RollingProblem<3>& problem, const RollingDrive& drive, RollingState& s) {
  raise_friction(problem, drive, s);
  RollingState from = s;
  if (s.touches && !s.solved()) {
    from = without_forces(problem, drive, s.point);
    begin(problem, drive, from);
  }
  for (int n = 0; n < newton_rounds && s.touches && !s.solved(); ++n) {
    if (s.effort.spent()) break;
    from.effort = s.effort;
    sweep(problem, drive, from);
    s = from;
    iterate(problem, drive, s);
  }
}

/// Several right sides: factors in double precision are as fast.
void add_slopes(const SpaceProblem& problem, const RollingDrive& drive, RollingState& s) {
  if (s.solved()) s.slopes = RollingSystem<3>(problem, drive, s.statuses, s.point).slopes(s.point);
}

}  // namespace rondo::statics
