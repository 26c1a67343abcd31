// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/law/rolling_friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/statics/anderson.hpp"
#include "rondo/statics/steady/law/rolling_law.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;

constexpr int most_free = 80;           // iterations that may lead away
constexpr int most_stalled = 2;         // of them along the tangent
constexpr double gain = 0.5;            // of the largest change, else they are stalled
constexpr int most_descents = 30;       // steps of the descent
constexpr int most_mixed = 8;           // accelerated iterations between two of them
constexpr std::size_t mixed = 12;       // points of the acceleration
constexpr double on_the_way = 1e-6;     // largest change of a coefficient at a share below 1
constexpr double falling_step = 0.125;  // of the share, with friction that falls
constexpr double least_step = 1.0 / 512.0;
constexpr double most_efforts = 3.0;  // of the work that one problem may take

std::vector<PairFriction> without_slopes(std::vector<PairFriction> pairs) {
  for (PairFriction& f : pairs) f.by_normal = f.by_way = 0.0;
  return pairs;
}

VectorXd factors_of(const std::vector<PairFriction>& pairs) {
  VectorXd factors(std::ssize(pairs));
  for (std::size_t j = 0; j < pairs.size(); ++j) factors[static_cast<Index>(j)] = pairs[j].factor;
  return factors;
}

std::vector<PairFriction> pairs_of(const VectorXd& factors) {
  std::vector<PairFriction> pairs;
  for (const double factor : factors) pairs.push_back({.factor = std::max(0.0, factor)});
  return pairs;
}

/// The state of a problem whose coefficients follow from it.
template <int D>
class LawFollower {
 public:
  LawFollower(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& state)
      : problem_(problem), drive_(drive), at_(state) {
    RONDO_DEMAND(drive.law->table.patches.empty() && drive.law->table.coefficient == 1.0,
                 drive.law->table.patches.size(), drive.law->table.coefficient);
  }

  void follow();

 private:
  [[nodiscard]] std::vector<PairFriction> frictions(double share) const {
    return frictions_at(problem_, drive_, at_.point, share);
  }
  bool solve_with(const std::vector<PairFriction>& pairs);
  bool settle(double share);
  bool run_free(double share);
  bool descend(double share);
  void go_back(const RollingState& to);
  [[nodiscard]] bool is_spent() const noexcept { return work_ > most_efforts * at_.effort.most; }
  [[nodiscard]] static double bound_at(double share) noexcept {
    return share == 1.0 ? coefficient_bound : on_the_way;
  }
  bool go_towards(const VectorXd& factors, double share);
  bool mix(double share);
  bool take_constant();
  void take_steps();
  void finish();
  void give_up();
  [[nodiscard]] double largest_change(const std::vector<PairFriction>& next);
  [[nodiscard]] double distance_of(const std::vector<PairFriction>& next) const;
  [[nodiscard]] RollingPoint tangent_point(const std::vector<PairFriction>& found) const;
  [[nodiscard]] VectorXd along_tangent(const std::vector<PairFriction>& found) const;

  const RollingProblem<D>& problem_;
  const RollingDrive& drive_;
  RollingState& at_;
  double work_ = 0.0;  ///< of all problems so far
};

/// Solves the problem with given coefficients.
template <int D>
bool LawFollower<D>::solve_with(const std::vector<PairFriction>& pairs) {
  RollingDrive given = drive_;
  given.law = nullptr;
  given.pairs = pairs;
  at_.effort.work = 0.0;
  solve_rolling(problem_, given, at_);
  work_ += at_.effort.work;
  at_.pairs = pairs;
  ++at_.friction.problems;
  return at_.solved();
}

/// Takes the state back; the work and the problems so far stay counted.
template <int D>
void LawFollower<D>::go_back(const RollingState& to) {
  const RollingEffort effort = at_.effort;
  const int problems = at_.friction.problems;
  at_ = to;
  at_.effort = effort;
  at_.friction.problems = problems;
}

/// Returns the largest change of the coefficient of a pair that touches, and keeps it with the
/// pair in the state.
template <int D>
double LawFollower<D>::largest_change(const std::vector<PairFriction>& next) {
  double largest = 0.0;
  for (std::size_t j = 0; j < next.size(); ++j) {
    if (at_.statuses[j].status == Status::open) continue;
    const double change = drive_.friction * std::abs(next[j].factor - at_.pairs[j].factor);
    if (change <= largest) continue;
    largest = change;
    at_.friction.pair = j;
  }
  return at_.friction.change = largest;
}

/// Root of the sum of the squares of all changes.
template <int D>
double LawFollower<D>::distance_of(const std::vector<PairFriction>& next) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < next.size(); ++j)
    if (at_.statuses[j].status != Status::open)
      sum += std::pow(next[j].factor - at_.pairs[j].factor, 2);
  return std::sqrt(sum);
}

/// Where the law that is linear about this state leads to, with statuses as they are; this state,
/// if it leads nowhere.
template <int D>
RollingPoint LawFollower<D>::tangent_point(const std::vector<PairFriction>& found) const {
  RollingDrive linear = drive_;
  linear.law = nullptr;
  linear.pairs = found;
  RollingPoint to = RollingSystem<D>(problem_, linear, at_.statuses, at_.point).solve();
  return to.force.allFinite() ? to : at_.point;
}

/// The factors of the linear law there.
template <int D>
VectorXd LawFollower<D>::along_tangent(const std::vector<PairFriction>& found) const {
  const RollingPoint to = tangent_point(found);
  VectorXd factors = factors_of(found);
  const VectorXd moved = gaps_and_ways(problem_, to, drive_.path()),
                 before = gaps_and_ways(problem_, at_.point, drive_.path());
  for (std::size_t j = 0; j < found.size(); ++j) {
    const auto row = static_cast<Index>(D * j);
    const double normal = at_.point.force[row];
    if (!(normal > 0.0)) continue;
    const double way = moved.template segment<D - 1>(row + 1).norm() -
                       before.template segment<D - 1>(row + 1).norm();
    factors[static_cast<Index>(j)] +=
        (found[j].by_normal * (to.force[row] - normal) + found[j].by_way * way) /
        (drive_.friction * normal);
  }
  return factors;
}

/// A part of the way from the factors so far to others that lessens how far they are from their
/// own.
/// @return whether there is one
template <int D>
bool LawFollower<D>::go_towards(const VectorXd& to, double share) {
  const RollingState before = at_;
  const VectorXd from = factors_of(at_.pairs);
  const double distance = distance_of(frictions(share));
  for (const double part : {1.0, 0.5, 0.25, 0.1}) {
    const bool is_solved = solve_with(pairs_of(from + part * (to - from)));
    if (is_solved && distance_of(frictions(share)) < (1.0 - 0.1 * part) * distance) return true;
    go_back(before);
  }
  return false;
}

/// Some steps of the accelerated iteration, which may lead away first.
template <int D>
bool LawFollower<D>::mix(double share) {
  Anderson acceleration(mixed);
  for (int n = 0; n < most_mixed; ++n) {
    const VectorXd next = acceleration.next(factors_of(at_.pairs), factors_of(frictions(share)));
    if (!solve_with(pairs_of(next))) return false;
  }
  return true;
}

/// Where steps along the tangent gain nothing for a while, as statuses go to and fro, the iteration
/// is accelerated. @return whether the coefficients settle
template <int D>
bool LawFollower<D>::run_free(double share) {
  Anderson acceleration(mixed);
  const double bound = bound_at(share);
  double best = std::numeric_limits<double>::infinity();
  for (int n = 0, stalled = 0; n < most_free && !is_spent(); ++n) {
    const std::vector<PairFriction> found = frictions(share);
    const double change = largest_change(found);
    if (change < bound) return true;
    stalled = change < gain * best ? 0 : stalled + 1;
    if (stalled == 0) best = change;
    const VectorXd next =
        stalled <= most_stalled
            ? factors_of(frictions_at(problem_, drive_, tangent_point(found), share))
            : acceleration.next(factors_of(at_.pairs), factors_of(found));
    if (!solve_with(pairs_of(next))) return false;
  }
  return false;
}

/// @return whether the coefficients settle
template <int D>
bool LawFollower<D>::descend(double share) {
  for (int n = 0; n < most_descents && !is_spent(); ++n) {
    const std::vector<PairFriction> found = frictions(share);
    if (largest_change(found) < bound_at(share)) return true;
    if (!go_towards(along_tangent(found), share) && !mix(share)) return false;
  }
  return false;
}

/// @return whether the coefficients settle at a share
template <int D>
bool LawFollower<D>::settle(double share) {
  const RollingState before = at_;
  if (run_free(share)) return true;
  go_back(before);
  return descend(share);
}

template <int D>
bool LawFollower<D>::take_constant() {
  return solve_with(std::vector<PairFriction>(problem_.pairs.size()));
}

/// Follows the law from the constant coefficient on, in steps of the share.
template <int D>
void LawFollower<D>::take_steps() {
  const double first = contact::falls_with_slip(drive_.law->table) ? falling_step : 1.0;
  double step = first;
  at_.friction.share = 0.0;
  while (at_.friction.share < 1.0) {
    const RollingState before = at_;
    const double to = std::min(1.0, at_.friction.share + step);
    if (settle(to)) {
      at_.friction.share = to;
      ++at_.friction.steps;
      step = std::min(first, 2.0 * step);
      continue;
    }
    step *= 0.5;
    if (step < least_step || is_spent()) return give_up();
    go_back(before);
    ++at_.friction.restarts;
  }
  finish();
}

template <int D>
void LawFollower<D>::give_up() {
  at_.friction.solved = false;
  at_.residual = std::numeric_limits<double>::infinity();
}

/// The residual is that of the law at the state itself; the slopes take the coefficients along.
template <int D>
void LawFollower<D>::finish() {
  RollingDrive linear = drive_;
  linear.law = nullptr;
  linear.pairs = frictions(1.0);
  at_.residual = rolling_residual(problem_, at_.point, drive_.path(), linear.coefficients());
  at_.slopes = RollingSystem<D>(problem_, linear, at_.statuses, at_.point).slopes(at_.point);
  at_.pairs = without_slopes(std::move(linear.pairs));
}

/// Near a state that has coefficients from these, and with the steps that led to it where it is one
/// of fewer pairs; else, or where they do not settle, in steps.
template <int D>
void LawFollower<D>::follow() {
  if (!at_.pairs.empty()) {
    at_.pairs.resize(problem_.pairs.size());
    const RollingState before = at_;
    if (solve_with(at_.pairs) && settle(1.0)) return finish();
    go_back(before);
    at_.friction = {.problems = at_.friction.problems};
  }
  if (take_constant()) return take_steps();
  at_.friction.share = 0.0;
}

}  // namespace

template <int D>
std::vector<PairFriction> frictions_at(const RollingProblem<D>& problem, const RollingDrive& drive,
                                       const RollingPoint& point, double share) {
  const VectorXd moved = gaps_and_ways(problem, point, drive.path());
  const RollingFriction& law = *drive.law;
  std::vector<PairFriction> all(problem.pairs.size());
  for (std::size_t j = 0; j < all.size(); ++j) {
    const auto row = static_cast<Index>(D * j);
    const double extent = law.extent[problem.pairs[j].candidate];
    const double normal = std::max(0.0, point.force[row]);
    const double way = moved.template segment<D - 1>(row + 1).norm();
    const contact::FrictionValue value =
        contact::friction_at(law.table, {{}, way / problem.time, normal / extent});
    all[j].factor = 1.0 + share * (value.coefficient - 1.0);
    if (all[j].factor == 0.0) continue;
    const double bound = share * drive.friction * normal;
    all[j].by_normal = bound * value.by_pressure / extent;
    all[j].by_way = bound * value.by_slip / problem.time;
  }
  return all;
}

template <int D>
void solve_by_law(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& s) {
  LawFollower<D>(problem, drive, s).follow();
}

template std::vector<PairFriction> frictions_at(const RollingProblem<2>&, const RollingDrive&,
                                                const RollingPoint&, double);
template std::vector<PairFriction> frictions_at(const RollingProblem<3>&, const RollingDrive&,
                                                const RollingPoint&, double);
template void solve_by_law(const RollingProblem<2>&, const RollingDrive&, RollingState&);
template void solve_by_law(const RollingProblem<3>&, const RollingDrive&, RollingState&);

}  // namespace rondo::statics
