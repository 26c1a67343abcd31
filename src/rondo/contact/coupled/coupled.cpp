// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/coupled.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/contact/coupled/coupled_newton.hpp"
#include "rondo/contact/coupled/coupled_pair.hpp"
#include "rondo/contact/coupled/coupled_residual.hpp"
#include "rondo/contact/residual.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::contact {
namespace {

constexpr int first_sweeps = 4;            ///< before the first try of Newton's method
constexpr int failures_before_sweeps = 2;  ///< tries that failed, one after the other
constexpr int pair_sweeps = 2;             ///< with a sweep, after these
// Shifts of Newton's method: of the first try, which solves most problems in a few whole steps; of
// the second, which holds softly enough for any; from there on less, see Shift.
constexpr double first_shift = 1e-10, second_shift = 1e-3, shift_factor = 10.0;
constexpr double least_shift = 1e-11, largest_shift = 1.0;
constexpr int tries_before_less = 8;
constexpr int most_halvings = 10;  ///< most halvings of a Newton step, in all tries but the first

/// One iteration of a solution: what is at hand, and the best so far.
struct Iteration {
  const CoupledProblem& problem;
  const CoupledLimits& limits;
  std::span<Vec2> best;
  CoupledWorkspace& work;
  CoupledResult result{};
  double scale = 0.0;  ///< scale of the residual [N·s/m]

  [[nodiscard]] bool finished() const noexcept {
    return result.converged || result.iterations >= limits.most_iterations;
  }

  /// Judges an iterate; true where it is the best so far.
  bool offer(std::span<const Vec2> impulse) noexcept {
    const double residual = coupled_residual(problem, impulse);
    if (!(residual < result.residual)) return false;
    result.residual = residual;
    result.converged = residual <= limits.tolerance;
    std::copy(impulse.begin(), impulse.end(), best.begin());
    return true;
  }
};

void update_contact(const CoupledProblem& p, std::size_t j, std::span<Vec2> impulse) noexcept {
  Vec2 free = p.free[j];
  Block own{};
  for (auto k = static_cast<std::size_t>(p.row_start[j]);
       k < static_cast<std::size_t>(p.row_start[j + 1]); ++k) {
    const auto l = static_cast<std::size_t>(p.column[k]);
    if (l == j)
      own = p.blocks[k];
    else
      free += apply(p.blocks[k], impulse[l]);
  }
  impulse[j] = solve_block(own, free, p.bounce[j], p.friction[j]).impulse;
}

void sweep(Iteration& it) noexcept {
  std::vector<Vec2>& r = it.work.current;
  const std::size_t nc = it.problem.size();
  for (std::size_t j = 0; j < nc; ++j) update_contact(it.problem, j, r);
  for (std::size_t j = nc; j-- > 0;) update_contact(it.problem, j, r);
  ++it.result.iterations;
  it.offer(r);
}

void sweep_pairs(Iteration& it) noexcept {
  const double enough = 0.01 * it.limits.tolerance * it.scale;
  std::vector<Vec2>& r = it.work.current;
  for (std::size_t j = 0; j < it.problem.size(); ++j) {
    const int partner = partner_of(it.problem, j);
    if (partner < 0 || !update_pair(it.problem, {j, static_cast<std::size_t>(partner)}, enough, r))
      update_contact(it.problem, j, r);
  }
  ++it.result.iterations;
  it.offer(r);
}

/// Newton's method from where the sweeps are; they go on from there if it has come nearer.
bool try_newton(Iteration& it, int width, double shift, int halvings) {
  std::vector<Vec2>& r = it.work.candidate;
  r = it.work.current;
  NewtonSettings settings{.width = width, .shift = shift, .halvings = halvings, .scale = it.scale};
  settings.most_steps =
      std::min(settings.most_steps, it.limits.most_iterations - it.result.iterations);
  const NewtonResult found = newton(it.problem, settings, r, it.work);
  it.result.iterations += found.steps;
  for (std::size_t j = 0; j < r.size(); ++j) r[j] = project_on_cone(r[j], it.problem.friction[j]);
  if (it.offer(r) || found.solved) it.work.current = r;
  return found.solved;
}

/// Shift of the next try of Newton's method: less after one that solved its problem, but only after
/// several that did since one that did not.
struct Shift {
  double value = second_shift;
  int wait = 0;

  void adapt(bool solved) noexcept {
    if (!solved) {
      value = std::min(value * shift_factor, largest_shift);
      wait = tries_before_less;
    } else if (wait > 0) {
      --wait;
    } else {
      value = std::max(value / shift_factor, least_shift);
    }
  }
};

/// Sweeps and Newton's method in turn until the law holds or the iterations are used up.
void iterate(Iteration& it) {
  for (int i = 0; i < first_sweeps && !it.finished(); ++i) sweep(it);
  if (it.finished()) return;
  const int width = order_contacts(it.problem, it.work);
  const bool fits = newton_fits(it.problem, width);
  Shift shift;
  int failures = fits && try_newton(it, width, first_shift, 0) ? 0 : failures_before_sweeps;
  while (!it.finished()) {
    if (failures >= failures_before_sweeps) {
      sweep(it);
      for (int i = 0; i < pair_sweeps && !it.finished(); ++i) sweep_pairs(it);
      failures = fits ? 0 : failures_before_sweeps;
    }
    if (!fits || it.finished()) continue;
    const bool solved = try_newton(it, width, shift.value, most_halvings);
    failures = solved ? 0 : failures + 1;
    shift.adapt(solved);
  }
}

void start(Iteration& it) noexcept {
  CoupledWorkspace& work = it.work;
  std::fill(work.current.begin(), work.current.end(), Vec2{});
  for (std::size_t j = 0; j < it.problem.size(); ++j)
    work.candidate[j] = project_on_cone(it.best[j], it.problem.friction[j]);
  it.scale = 0.0;
  for (std::size_t j = 0; j < it.problem.size(); ++j)
    it.scale = std::max(it.scale, it.problem.mass[j] * norm(it.problem.free[j]));
  it.result.residual = std::numeric_limits<double>::infinity();
  it.offer(work.current);
  // A warm start that is farther from the law than no impulse at all is none.
  if (it.offer(work.candidate)) work.current = work.candidate;
}

void fit(CoupledWorkspace& work, std::size_t nc) {
  for (auto* v : {&work.current, &work.candidate, &work.anchor, &work.step_from, &work.velocity})
    v->resize(nc);
  work.order.resize(nc);
  work.unknown.resize(nc);
  work.status.assign(nc, Status::open);
  work.side.resize(nc);
}

void set_statuses(const CoupledProblem& p, std::span<const Vec2> impulse, std::span<Status> status,
                  CoupledWorkspace& work) noexcept {
  coupled_velocities(p, impulse, work.velocity);
  for (std::size_t j = 0; j < p.size(); ++j) {
    const Block& w = diagonal_block(p, j);
    const Vec2 free = work.velocity[j] - apply(w, impulse[j]);
    status[j] = solve_block(w, free, p.bounce[j], p.friction[j]).status;
  }
}

}  // namespace

LocalSolution solve_block(const Block& w, Vec2 free, double bounce, double friction) noexcept {
  const Vec2 v = {free.x + bounce, free.y};
  const double det = w[0] * w[3] - w[1] * w[2];
  if (v.x >= 0.0 || !(det > 0.0)) return {};
  const Vec2 stick = {(w[1] * v.y - w[3] * v.x) / det, (w[2] * v.x - w[0] * v.y) / det};
  if (std::abs(stick.y) <= friction * stick.x) return {stick, Status::stick};
  // Slip: r = r_n (1, side μ), the side being the one in which sticking would have pulled.
  const double side = stick.y > 0.0 ? 1.0 : -1.0;
  const double wn = w[0] + side * friction * w[1];
  if (!(wn > 0.0)) return {};
  const double rn = -v.x / wn;
  return {{rn, side * friction * rn}, Status::slip};
}

const Block& diagonal_block(const CoupledProblem& p, std::size_t j) noexcept {
  const auto first = p.column.begin() + p.row_start[j],
             last = p.column.begin() + p.row_start[j + 1];
  const auto at = std::lower_bound(first, last, static_cast<int>(j));
  return p.blocks[static_cast<std::size_t>(at - p.column.begin())];
}

void coupled_velocities(const CoupledProblem& p, std::span<const Vec2> impulse,
                        std::span<Vec2> velocity) noexcept {
  for (std::size_t j = 0; j < p.size(); ++j) {
    velocity[j] = p.free[j];
    for (auto k = static_cast<std::size_t>(p.row_start[j]);
         k < static_cast<std::size_t>(p.row_start[j + 1]); ++k)
      velocity[j] += apply(p.blocks[k], impulse[static_cast<std::size_t>(p.column[k])]);
  }
}

CoupledResult solve_coupled(const CoupledProblem& p, const CoupledLimits& limits,
                            std::span<Vec2> impulse, std::span<Status> status,
                            CoupledWorkspace& work) {
  RONDO_DEMAND(impulse.size() == p.size() && status.size() == p.size() &&
                   p.bounce.size() == p.size() && p.friction.size() == p.size() &&
                   p.mass.size() == p.size() && p.row_start.size() == p.size() + 1,
               p.size(), impulse.size(), status.size());
  fit(work, p.size());
  Iteration it{p, limits, impulse, work};
  start(it);
  iterate(it);
  set_statuses(p, impulse, status, work);
  return it.result;
}

}  // namespace rondo::contact
