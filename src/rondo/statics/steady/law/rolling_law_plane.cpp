// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "rondo/core/index.hpp"
#include "rondo/statics/condensed_contact.hpp"
#include "rondo/statics/steady/law/rolling_law.hpp"
#include "rondo/statics/steady/rolling_groups.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;
using PlaneProblem = RollingProblem<2>;

constexpr std::size_t few_pairs = 16;  // whose solution needs no start

int side_of(const RollingStatus& s) {
  return s.direction.x > 0.0 ? 1 : s.direction.x < 0.0 ? -1 : 0;
}

std::vector<int> key_of(const RollingStatuses& statuses) {
  std::vector<int> key;
  for (const RollingStatus& s : statuses)
    key.push_back(3 * static_cast<int>(s.status) + side_of(s));
  return key;
}

Lcp complementary(const PlaneProblem& w, const RollingDrive& d) {
  VectorXd free = w.base;
  free(Eigen::seqN(0, w.n_pairs(), 2)).array() += d.height;
  free(Eigen::seqN(1, w.n_pairs(), 2)).array() += d.speed * w.time;
  std::vector<double> friction(w.pairs.size());
  for (std::size_t j = 0; j < friction.size(); ++j) friction[j] = d.coefficients()[j];
  return make_complementary({w.matrix, std::move(free), CandidateFriction(std::move(friction))})
      .lcp;
}

RollingStatuses pivoted_statuses(const LcpSolution& lcp, const PairCoefficients& friction) {
  const std::size_t m = lcp.basic.size() / 3;
  RollingStatuses statuses(m);
  for (std::size_t j = 0; j < m; ++j) {
    const bool off_lower = lcp.basic[m + j] != 0, off_upper = lcp.basic[2 * m + j] == 0;
    if (lcp.basic[j] == 0 || (!off_lower && !off_upper)) continue;
    if (off_lower && off_upper && friction[j] > 0.0)
      statuses[j].status = Status::stick;
    else
      statuses[j] = {Status::slip, {off_lower ? 1.0 : -1.0, 0.0}};
  }
  return statuses;
}

void pivot(const PlaneProblem& problem, const RollingDrive& drive, RollingState& s) {
  const Index m = problem.n_pairs();
  LcpSolution z;
  const double a_pivot = 20.0 * std::pow(static_cast<double>(3 * m), 2);
  const double affordable = (s.effort.most - s.effort.work) / a_pivot;
  if (affordable < 1.0) return;
  const auto most = static_cast<int>(std::min(30.0 * static_cast<double>(m) + 100.0, affordable));
  const LemkeReport end = solve_lemke(complementary(problem, drive), most, z);
  s.effort.pivots += end.pivots;
  s.effort.work += a_pivot * end.pivots;
  if (end.end != LemkeEnd::solved) return;
  RollingState other = s;
  other.statuses = pivoted_statuses(z, drive.coefficients());
  other.touches = !all_open(other.statuses);
  if (other.touches) {
    RollingSystem<2> system(problem, drive, other.statuses, s.point);
    other.point = system.solve();
    other.slopes = system.slopes(other.point);
  }
  other.residual = rolling_residual(problem, other.point, {}, drive.coefficients());
  if (other.residual < s.residual || !std::isfinite(s.residual)) s = std::move(other);
}

/// Groups that stick, and those beside them: a zone of stick that is too long shrinks in a few
/// steps of Newton's method, one that is too short grows by a pair a step.
std::set<std::pair<std::size_t, int>> stick_zone(const PlaneProblem& coarse,
                                                 const RollingStatuses& statuses) {
  std::set<std::pair<std::size_t, int>> zone;
  for (std::size_t g = 0; g < statuses.size(); ++g) {
    if (statuses[g].status != Status::stick) continue;
    const RollingPair& p = coarse.pairs[g];
    for (const int beside : {-1, 0, 1}) zone.insert({p.candidate, p.sample + beside});
  }
  return zone;
}

/// Spreads forces, height and speed over the pairs of the groups, with statuses that lead to
/// theirs.
RollingState spread_state(const RollingGroups<2>& groups, const RollingState& of) {
  const auto zone = stick_zone(groups.problem, of.statuses);
  RollingState s{.point = {spread(groups, of.point.force), of.point.height, of.point.speed}};
  for (const std::size_t group : groups.of) {
    s.statuses.push_back(of.statuses[group]);
    const RollingPair& p = groups.problem.pairs[group];
    if (s.statuses.back().status == Status::slip && zone.contains({p.candidate, p.sample}))
      s.statuses.back() = {Status::stick};
  }
  return s;
}

/// Statuses near those of the solution, by groups of pairs, and these by groups of groups.
RollingState coarse_start(const PlaneProblem& problem, const RollingDrive& drive,
                          const RollingPoint& point) {
  if (problem.pairs.size() > few_pairs) {
    const RollingGroups<2> groups = grouped(problem);
    if (2 * groups.problem.pairs.size() <= problem.pairs.size()) {
      RollingDrive of_groups = drive;
      of_groups.pairs = gathered(groups, drive.pairs);
      RollingState start = coarse_start(groups.problem, of_groups, point);
      newton(groups.problem, of_groups, start);
      if (start.touches && start.point.force.allFinite()) return spread_state(groups, start);
    }
  }
  return without_forces(problem, drive, point);
}

}  // namespace

/// With a load the height of the point must be in the ground.
template <>
void begin(const RollingProblem<2>& problem, const RollingDrive& drive, RollingState& s) {
  if (s.statuses.empty()) {
    RollingState start = coarse_start(problem, drive, s.point);
    start.effort = s.effort;
    s = std::move(start);
  }
  s.statuses.resize(problem.pairs.size());
}

template <>
void newton(const RollingProblem<2>& problem, const RollingDrive& drive, RollingState& s) {
  std::set<std::vector<int>> seen;
  s.touches = true;
  for (int n = 0; n < most_newton_steps && !s.effort.spent(); ++n) {
    ++s.effort.newton_steps;
    s.touches = !all_open(s.statuses);
    if (!s.touches) return;
    const RollingPoint before = s.point;
    RollingSystem<2> system(problem, drive, s.statuses, before);
    s.effort.work += system.work();
    s.point = system.solve();
    const VectorXd moved = gaps_and_ways(problem, s.point, {});
    s.residual = residual_of(problem, s.point, moved, drive.coefficients());
    if (!s.point.force.allFinite()) return;
    RollingStatuses next = statuses_of(problem, s.point, moved, drive.coefficients());
    const bool settled = next == s.statuses;
    const bool done = settled && (!drive.torque || is_near(s.point, before));
    const bool cycles = !settled && !seen.insert(key_of(next)).second;
    if (s.solved() && (done || cycles)) s.slopes = system.slopes(s.point);
    if (done || cycles) return;
    s.statuses = std::move(next);
  }
  s.residual = std::numeric_limits<double>::infinity();  // no end
}

/// From no forces; then by pivoting.
template <>
void rescue(const RollingProblem<2>& problem, const RollingDrive& drive, RollingState& s) {
  RollingState other = without_forces(problem, drive, s.point);
  other.effort = s.effort;
  newton(problem, drive, other);
  if (other.touches && !other.solved()) pivot(problem, drive, other);
  s.effort = other.effort;
  if (other.solved()) s = std::move(other);
}

}  // namespace rondo::statics
