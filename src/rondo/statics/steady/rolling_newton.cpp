// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "rondo/contact/residual.hpp"
#include "rondo/statics/lemke.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;
using Findings = std::vector<RollingStatus>;

constexpr int most_newton_steps = 60, most_trials = 40;
constexpr std::size_t few_pairs = 16;  // whose solution needs no start

double residual_of(const RollingProblem& problem, const RollingPoint& p,
                   const Eigen::VectorXd& moved, double friction) {
  double largest = 0.0, force = 0.0;
  for (Index j = 0; j < p.force.size() / 2; ++j) {
    const double stiffness = 1.0 / std::abs(problem.matrix(2 * j, 2 * j));
    const Vec2 r{p.force[2 * j], p.force[2 * j + 1]}, v{moved[2 * j], moved[2 * j + 1]};
    const double residual = contact::law_residual(r, v, 0.0, friction, stiffness);
    if (!std::isfinite(residual)) return residual;
    largest = std::max(largest, residual);
    force = std::max(force, norm(r));
  }
  return largest == 0.0 ? 0.0 : largest / force;
}

/// The active set that the law says of these forces: of r - w/compliance, which lies in the cone
/// where a pair sticks, beyond its side where it slips, and opposite where it is open.
Findings next_findings(const RollingProblem& problem, const RollingPoint& p,
                       const Eigen::VectorXd& moved, double friction) {
  const double stiffness = 1.0 / problem.matrix.diagonal().cwiseAbs().mean();
  Findings next(problem.pairs.size());
  for (std::size_t j = 0; j < next.size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    const double normal = p.force[row] - stiffness * moved[row];
    const double shear = p.force[row + 1] - stiffness * moved[row + 1];
    if (!(normal > 0.0)) continue;
    const bool sticks = friction > 0.0 && std::abs(shear) <= friction * normal;
    next[j] = sticks ? RollingStatus{Status::stick, 0}
                     : RollingStatus{Status::slip, shear > 0.0 || friction == 0.0 ? 1 : -1};
  }
  return next;
}

bool all_open(const Findings& found) {
  return std::ranges::all_of(found, [](const auto& f) { return f.status == Status::open; });
}

std::vector<int> key_of(const Findings& found) {
  std::vector<int> key;
  for (const RollingStatus& f : found) key.push_back(3 * static_cast<int>(f.status) + f.side);
  return key;
}

/// The torque, which is not linear, is as asked for to round-off: the square of what is left.
bool is_near(const RollingPoint& point, const RollingPoint& before) {
  const double change = (point.force - before.force).cwiseAbs().maxCoeff();
  return change <= 1e-8 * point.force.cwiseAbs().maxCoeff();
}

void newton(const RollingProblem& problem, const RollingDrive& drive, RollingState& s) {
  std::set<std::vector<int>> seen;
  s.touches = true;
  for (int n = 0; n < most_newton_steps && s.work < most_rolling_work; ++n) {
    ++s.newton_steps;
    s.touches = !all_open(s.found);
    if (!s.touches) return;
    const RollingPoint before = s.point;
    const RollingSystem system(problem, drive, s.found, before);
    s.work += 2.0 / 3.0 * std::pow(static_cast<double>(system.size()), 3);
    s.point = system.solve();
    const Eigen::VectorXd moved = gaps_and_ways(problem, s.point);
    s.residual = residual_of(problem, s.point, moved, drive.friction);
    if (!s.point.force.allFinite()) return;
    Findings next = next_findings(problem, s.point, moved, drive.friction);
    const bool settled = next == s.found;
    const bool done = settled && (!drive.torque || is_near(s.point, before));
    const bool cycles = !settled && !seen.insert(key_of(next)).second;
    if (s.solved() && (done || cycles)) s.slopes = system.slopes(s.point);
    if (done || cycles) return;
    s.found = std::move(next);
  }
  s.residual = std::numeric_limits<double>::infinity();  // no end
}

/// As make_complementary (condensed_contact.hpp), of a compliance that is not symmetric.
Lcp complementary(const RollingProblem& w, const RollingDrive& d) {
  const Index m = w.base.size() / 2;
  const auto normal = Eigen::seqN(0, m, 2), shear = Eigen::seqN(1, m, 2);
  Eigen::VectorXd free = w.base;
  free(normal).array() += d.height;
  free(shear).array() += d.speed * w.time;
  const double compliance = w.matrix.diagonal().cwiseAbs().mean();
  const Eigen::MatrixXd g = w.matrix / compliance;
  Lcp lcp;
  lcp.matrix = Eigen::MatrixXd::Zero(3 * m, 3 * m);
  lcp.matrix.topLeftCorner(m, m) = g(normal, normal) - d.friction * g(normal, shear);
  lcp.matrix.block(0, m, m, m) = g(normal, shear);
  lcp.matrix.block(m, 0, m, m) = g(shear, normal) - d.friction * g(shear, shear);
  lcp.matrix.block(m, m, m, m) = g(shear, shear);
  lcp.matrix.block(m, 2 * m, m, m).setIdentity();
  lcp.matrix.bottomLeftCorner(m, m).diagonal().setConstant(2.0 * d.friction);
  lcp.matrix.block(2 * m, m, m, m).diagonal().setConstant(-1.0);
  const double length = free.cwiseAbs().maxCoeff();
  lcp.q = Eigen::VectorXd::Zero(3 * m);
  lcp.q.head(m) = free(normal) / length;
  lcp.q.segment(m, m) = free(shear) / length;
  lcp.cover = Eigen::VectorXd::Ones(3 * m);
  lcp.cover.segment(m, m).setConstant(1.0 / std::max(1.0, d.friction));
  return lcp;
}

Findings findings_of(const LcpSolution& lcp, double friction) {
  const std::size_t m = lcp.basic.size() / 3;
  Findings found(m);
  for (std::size_t j = 0; j < m; ++j) {
    const bool off_lower = lcp.basic[m + j] != 0, off_upper = lcp.basic[2 * m + j] == 0;
    if (lcp.basic[j] == 0 || (!off_lower && !off_upper)) continue;
    const bool sticks = off_lower && off_upper && friction > 0.0;
    found[j] = {sticks ? Status::stick : Status::slip, sticks ? 0 : off_lower ? 1 : -1};
  }
  return found;
}

void pivot(const RollingProblem& problem, const RollingDrive& drive, RollingState& s) {
  const Index m = problem.base.size() / 2;
  LcpSolution z;
  const double a_pivot = 20.0 * std::pow(static_cast<double>(3 * m), 2);
  const double affordable = (most_rolling_work - s.work) / a_pivot;
  if (affordable < 1.0) return;
  const auto most = static_cast<int>(std::min(30.0 * static_cast<double>(m) + 100.0, affordable));
  const LemkeReport end = solve_lemke(complementary(problem, drive), most, z);
  s.pivots += end.pivots;
  s.work += a_pivot * end.pivots;
  if (end.end != LemkeEnd::solved) return;
  RollingState other = s;
  other.found = findings_of(z, drive.friction);
  other.touches = !all_open(other.found);
  if (other.touches) {
    const RollingSystem system(problem, drive, other.found, s.point);
    other.point = system.solve();
    other.slopes = system.slopes(other.point);
  }
  other.residual = rolling_residual(problem, other.point, drive.friction);
  if (other.residual < s.residual || !std::isfinite(s.residual)) s = std::move(other);
}

/// With height and speed as they are.
void solve_at(const RollingProblem& problem, const RollingDrive& drive, RollingState& s) {
  newton(problem, drive, s);
  if (s.touches && !s.solved()) pivot(problem, drive, s);
}

/// What is left of load, and of traction or torque, and how it changes with height and speed; of
/// what is not asked for, height and speed stay.
struct Miss {
  Eigen::Vector2d left = Eigen::Vector2d::Zero();
  Eigen::Matrix2d change = Eigen::Matrix2d::Identity();
};

Miss miss_of(const RollingProblem& problem, const RollingDrive& drive, const RollingState& s) {
  const RollingForces now = forces_of(problem, s.point);
  const auto row = [&](double wanted, double RollingForces::*of, Index at, Miss& miss) {
    miss.left[at] = wanted - now.*of;
    miss.change.row(at) << s.slopes.by_height.forces.*of, s.slopes.by_speed.forces.*of;
  };
  Miss miss;
  if (drive.load) row(*drive.load, &RollingForces::y, 0, miss);
  if (drive.traction) row(*drive.traction, &RollingForces::x, 1, miss);
  if (drive.torque) row(*drive.torque, &RollingForces::torque, 1, miss);
  return miss;
}

/// Height and speed that bring load, traction or torque, by Newton's method: each trial is solved
/// at a given height and speed, and a step that brings it no nearer is halved.
void find_drive(const RollingProblem& problem, const RollingDrive& drive, RollingState& s) {
  RollingDrive fixed = drive;
  fixed.load.reset();
  fixed.traction.reset();
  fixed.torque.reset();
  Eigen::Vector2d at{s.point.height, s.point.speed}, step = Eigen::Vector2d::Zero();
  double nearest = std::numeric_limits<double>::infinity();
  RollingState trial = s;
  for (int n = 0; n < most_trials && at.allFinite() && trial.work < most_rolling_work; ++n) {
    fixed.height = at[0];
    fixed.speed = at[1];
    solve_at(problem, fixed, trial);
    const Miss miss = trial.solved() ? miss_of(problem, drive, trial) : Miss{};
    const double distance = miss.left.norm();
    if (trial.solved() && distance < nearest) {
      nearest = distance;
      RollingState last = trial;  // exactly, if its statuses are those asked for
      newton(problem, drive, last);
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

/// Groups that stick, and those beside them: a zone of stick that is too long shrinks in a few
/// steps of Newton's method, one that is too short grows by a pair a step.
std::set<std::pair<std::size_t, int>> stick_zone(const RollingProblem& coarse,
                                                 const Findings& found) {
  std::set<std::pair<std::size_t, int>> zone;
  for (std::size_t g = 0; g < found.size(); ++g) {
    if (found[g].status != Status::stick) continue;
    const RollingPair& p = coarse.pairs[g];
    for (const int beside : {-1, 0, 1}) zone.insert({p.candidate, p.sample + beside});
  }
  return zone;
}

/// The same forces, height and speed on the pairs of the groups, and statuses that lead to theirs.
RollingState spread(const RollingProblem& coarse, const RollingState& of,
                    const std::vector<std::size_t>& groups) {
  const auto zone = stick_zone(coarse, of.found);
  Eigen::VectorXd share = Eigen::VectorXd::Zero(std::ssize(of.found));
  for (const std::size_t g : groups) share[static_cast<Index>(g)] += 1.0;
  RollingState s;
  s.point = of.point;
  s.point.force.resize(static_cast<Index>(2 * groups.size()));
  for (std::size_t j = 0; j < groups.size(); ++j) {
    const std::size_t group = groups[j];
    const auto g = static_cast<Index>(group);
    s.found.push_back(of.found[group]);
    const RollingPair& p = coarse.pairs[group];
    if (s.found.back().status == Status::slip && zone.contains({p.candidate, p.sample}))
      s.found.back() = {Status::stick, 0};
    s.point.force.segment<2>(static_cast<Index>(2 * j)) =
        of.point.force.segment<2>(2 * g) / share[g];
  }
  return s;
}

RollingState start_without_forces(const RollingProblem& problem, const RollingDrive& drive,
                                  const RollingPoint& point) {
  RollingState s;
  s.point = {Eigen::VectorXd::Zero(problem.base.size()), point.height, point.speed};
  s.found = next_findings(problem, s.point, gaps_and_ways(problem, s.point), drive.friction);
  return s;
}

}  // namespace

double rolling_residual(const RollingProblem& problem, const RollingPoint& point, double friction) {
  return residual_of(problem, point, gaps_and_ways(problem, point), friction);
}

RollingState rolling_start(const RollingProblem& problem, const RollingDrive& drive,
                           const RollingPoint& point) {
  if (problem.pairs.size() > few_pairs) {
    const std::vector<std::size_t> groups = groups_of(problem);
    const RollingProblem coarse = grouped(problem, groups);
    if (2 * coarse.pairs.size() <= problem.pairs.size()) {
      RollingState start = rolling_start(coarse, drive, point);
      newton(coarse, drive, start);
      if (start.touches && start.point.force.allFinite()) return spread(coarse, start, groups);
    }
  }
  return start_without_forces(problem, drive, point);
}

void solve_rolling(const RollingProblem& problem, const RollingDrive& drive, RollingState& state) {
  const RollingPoint begin = state.point;
  newton(problem, drive, state);
  if (!state.touches || state.solved()) return;
  RollingState other = start_without_forces(problem, drive, begin);
  other.newton_steps = state.newton_steps;
  other.pivots = state.pivots;
  other.work = state.work;
  const bool fixed = !drive.load && !drive.traction && !drive.torque;
  if (fixed)
    solve_at(problem, drive, other);
  else
    find_drive(problem, drive, other);
  state.newton_steps = other.newton_steps;
  state.pivots = other.pivots;
  if (other.solved()) state = std::move(other);
}

}  // namespace rondo::statics
