// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/contact/coupled_newton.hpp"
#include "rondo/contact/residual.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::contact {
namespace {

constexpr int first_sweeps = 4;        ///< before the first try of Newton's method
constexpr int most_sweeps = 256;       ///< between two tries
constexpr int most_newton_steps = 12;  ///< in one try

/// One iteration of a solution: what is at hand, and the best so far.
struct Iteration {
  const CoupledProblem& problem;
  const CoupledLimits& limits;
  std::span<Vec2> best;
  CoupledResult result;
  CoupledWorkspace& work;

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
      free += p.blocks[k] * impulse[l];
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

/// From the sweeps' iterate; they go on from the best that comes of it.
void try_newton(Iteration& it, int width) {
  CoupledWorkspace& work = it.work;
  std::vector<Vec2>&r = work.newton, &feasible = work.candidate;
  r = work.current;
  for (int i = 0; i < most_newton_steps && !it.finished(); ++i) {
    ++it.result.iterations;
    if (!newton_step(it.problem, width, r, work)) return;
    for (std::size_t j = 0; j < r.size(); ++j)
      feasible[j] = project_on_cone(r[j], it.problem.friction[j]);
    if (it.offer(feasible)) work.current = feasible;
  }
}

void start(Iteration& it) noexcept {
  CoupledWorkspace& work = it.work;
  std::fill(work.current.begin(), work.current.end(), Vec2{});
  std::copy(it.best.begin(), it.best.end(), work.candidate.begin());
  it.result.residual = std::numeric_limits<double>::infinity();
  it.offer(work.current);
  // A warm start that is farther from the law than no impulse at all is none.
  if (it.offer(work.candidate)) work.current = work.candidate;
}

void fit(CoupledWorkspace& work, std::size_t nc) {
  for (auto* v : {&work.current, &work.candidate, &work.newton, &work.velocity}) v->resize(nc);
  work.order.resize(nc);
  work.unknown.resize(nc);
  work.status.resize(nc);
  work.side.resize(nc);
}

void set_statuses(const CoupledProblem& p, std::span<const Vec2> impulse, std::span<Status> status,
                  CoupledWorkspace& work) noexcept {
  coupled_velocities(p, impulse, work.velocity);
  for (std::size_t j = 0; j < p.size(); ++j) {
    const Block& w = diagonal_block(p, j);
    const Vec2 free = work.velocity[j] - w * impulse[j];
    status[j] = solve_block(w, free, p.bounce[j], p.friction[j]).status;
  }
}

}  // namespace

LocalSolution solve_block(const Block& w, Vec2 free, double bounce, double friction) noexcept {
  RONDO_ASSERT(w[0] > friction * std::abs(w[1]), w[0], w[1], friction);
  const Vec2 v = {free.x + bounce, free.y};
  if (v.x >= 0.0) return {};
  const double det = w[0] * w[3] - w[1] * w[2];
  const Vec2 stick = {(w[1] * v.y - w[3] * v.x) / det, (w[2] * v.x - w[0] * v.y) / det};
  if (std::abs(stick.y) <= friction * stick.x) return {stick, Status::stick};
  // Slip: r = r_n (1, side μ), the side being the one in which sticking would have pulled.
  const double side = stick.y > 0.0 ? 1.0 : -1.0;
  const double rn = -v.x / (w[0] + side * friction * w[1]);
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
      velocity[j] += p.blocks[k] * impulse[static_cast<std::size_t>(p.column[k])];
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
  Iteration it{p, limits, impulse, {}, work};
  start(it);
  int width = -1;
  for (int sweeps = first_sweeps; !it.finished(); sweeps = std::min(2 * sweeps, most_sweeps)) {
    for (int i = 0; i < sweeps && !it.finished(); ++i) sweep(it);
    if (it.finished()) break;
    if (width < 0) width = order_contacts(p, work);
    if (newton_fits(p, width)) try_newton(it, width);
  }
  set_statuses(p, impulse, status, work);
  return it.result;
}

}  // namespace rondo::contact
