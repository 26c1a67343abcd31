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

constexpr int most_iterations = 80;     // of the coefficients, at one share
constexpr int most_stalled = 2;         // of them along the tangent that gain nothing
constexpr double gain = 0.5;            // of the largest change
constexpr std::size_t mixed = 12;       // points of the acceleration
constexpr double on_the_way = 1e-6;     // largest change of a coefficient at a share below 1
constexpr double falling_step = 0.125;  // of the share, with friction that falls
constexpr double least_step = 1.0 / 512.0;
constexpr double most_efforts = 3.0;  // of the work that one problem may take

bool falls(const contact::FrictionTable& table) noexcept {
  return !std::ranges::is_sorted(table.slip, {}, [](const auto& point) { return point[1]; });
}

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
  bool settle(double share, bool is_solved);
  bool take_constant();
  void take_steps();
  void finish();
  void give_up(const FrictionEffort& effort);
  [[nodiscard]] double largest_change(const std::vector<PairFriction>& next);
  [[nodiscard]] std::vector<PairFriction> along_tangent(std::vector<PairFriction> found,
                                                        double share) const;

  const RollingProblem<D>& problem_;
  const RollingDrive& drive_;
  RollingState& at_;
  double work_ = 0.0;
};

/// With coefficients that are given.
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

/// Of the coefficients of pairs that touch.
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

/// Coefficients where the law that is linear about this state leads to, with statuses as they are.
template <int D>
std::vector<PairFriction> LawFollower<D>::along_tangent(std::vector<PairFriction> found,
                                                        double share) const {
  RollingDrive linear = drive_;
  linear.law = nullptr;
  linear.pairs = std::move(found);
  const RollingPoint to = RollingSystem<D>(problem_, linear, at_.statuses, at_.point).solve();
  if (!to.force.allFinite()) return without_slopes(std::move(linear.pairs));
  return without_slopes(frictions_at(problem_, drive_, to, share));
}

/// @param is_solved with its coefficients. @return whether they settle at a share
template <int D>
bool LawFollower<D>::settle(double share, bool is_solved) {
  Anderson mix(mixed);
  std::vector<PairFriction> next = at_.pairs;
  double best = std::numeric_limits<double>::infinity();
  int stalled = 0;
  const double bound = share == 1.0 ? coefficient_bound : on_the_way;
  for (int n = 0; n < most_iterations && work_ <= most_efforts * at_.effort.most; ++n) {
    if (!is_solved && !solve_with(next)) return false;
    is_solved = false;
    std::vector<PairFriction> found = frictions(share);
    const double change = largest_change(found);
    if (change < bound) return true;
    if (change < gain * best)
      best = change, stalled = 0;
    else
      ++stalled;
    if (stalled <= most_stalled)
      next = along_tangent(std::move(found), share);
    else
      next = pairs_of(mix.next(factors_of(at_.pairs), factors_of(found)));
  }
  return false;
}

template <int D>
bool LawFollower<D>::take_constant() {
  return solve_with(std::vector<PairFriction>(problem_.pairs.size()));
}

/// From the constant coefficient on.
template <int D>
void LawFollower<D>::take_steps() {
  const double first = falls(drive_.law->table) ? falling_step : 1.0;
  double step = first;
  at_.friction.share = 0.0;
  while (at_.friction.share < 1.0) {
    const RollingState before = at_;
    const double to = std::min(1.0, at_.friction.share + step);
    if (settle(to, true)) {
      at_.friction.share = to;
      ++at_.friction.steps;
      step = std::min(first, 2.0 * step);
      continue;
    }
    const RollingEffort effort = at_.effort;
    FrictionEffort found = at_.friction;
    step *= 0.5;
    if (step < least_step || work_ > most_efforts * effort.most) return give_up(found);
    at_ = before;
    at_.effort = effort;
    at_.friction.problems = found.problems;
    ++at_.friction.restarts;
  }
  finish();
}

template <int D>
void LawFollower<D>::give_up(const FrictionEffort& effort) {
  at_.friction = effort;
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

/// Near a state that has coefficients from these; else, or where they do not settle, in steps.
template <int D>
void LawFollower<D>::follow() {
  if (!at_.pairs.empty()) {
    at_.pairs.resize(problem_.pairs.size());
    const RollingState before = at_;
    at_.friction = {};
    if (settle(1.0, false)) return finish();
    const RollingEffort effort = at_.effort;
    const int problems = at_.friction.problems;
    at_ = before;
    at_.effort = effort;
    at_.friction = {.problems = problems};
  }
  if (take_constant()) take_steps();
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
