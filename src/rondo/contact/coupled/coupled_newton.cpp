// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/coupled_newton.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rondo::contact {
namespace {

constexpr int refinements = 2;  ///< solutions with the factors of a step
constexpr double solved_to = 1e-14;
constexpr long long largest_matrix = 8'000'000;  ///< numbers

std::size_t index(int i) noexcept {
  return static_cast<std::size_t>(i);
}

/// Appends to `order` all that `first` reaches, level by level; `mark` is 1 for what is there.
void append_levels(const CoupledProblem& p, int first, std::vector<int>& order,
                   std::vector<int>& mark) {
  std::size_t next = order.size();
  order.push_back(first);
  mark[index(first)] = 1;
  for (; next < order.size(); ++next) {
    const std::size_t j = index(order[next]);
    for (std::size_t k = index(p.row_start[j]); k < index(p.row_start[j + 1]); ++k) {
      if (mark[index(p.column[k])] == 1) continue;
      mark[index(p.column[k])] = 1;
      order.push_back(p.column[k]);
    }
  }
}

/// The shifted problem and the iterate.
struct Newton {
  const CoupledProblem& p;
  const NewtonSettings& settings;
  std::span<Vec2> r;
  CoupledWorkspace& work;

  /// The vector that the law sets to zero at an active contact: w + bounce + (shift/m)(r - r⁰).
  [[nodiscard]] Vec2 lack(std::size_t j) const noexcept {
    return work.velocity[j] + Vec2{p.bounce[j], 0.0} +
           settings.shift / p.mass[j] * (r[j] - work.anchor[j]);
  }
  /// The impulse r - m lack, which the law has not limited yet.
  [[nodiscard]] Vec2 trial(std::size_t j) const noexcept {
    return r[j] - p.mass[j] / (1.0 + settings.shift) * lack(j);
  }
  [[nodiscard]] bool active(std::size_t j) const noexcept { return work.status[j] != Status::open; }
  [[nodiscard]] double edge(std::size_t j) const noexcept { return work.side[j] * p.friction[j]; }
};

/// Σ |r - what the law makes of trial|²: zero at the solution. Leaves the velocities of r.
double merit(Newton& it) noexcept {
  coupled_velocities(it.p, it.r, it.work.velocity);
  double sum = 0.0;
  for (std::size_t j = 0; j < it.p.size(); ++j) {
    const Vec2 y = it.trial(j);
    const double n = std::max(y.x, 0.0), most = it.p.friction[j] * n;
    const Vec2 off = it.r[j] - Vec2{n, std::clamp(y.y, -most, most)};
    sum += dot(off, off);
  }
  return sum;
}

struct Statuses {
  int unknowns = 0;
  bool same = true;  ///< no status and no side of slip has changed
};

/// Statuses from the velocities of r. Impulses of open contacts are set to zero, those of slipping
/// ones to the edge of the cone.
Statuses find_statuses(Newton& it) noexcept {
  CoupledWorkspace& work = it.work;
  Statuses out;
  for (std::size_t j = 0; j < it.p.size(); ++j) {
    const Vec2 y = it.trial(j);
    const bool sticks = std::abs(y.y) <= it.p.friction[j] * y.x;
    const Status now = y.x <= 0.0 ? Status::open : sticks ? Status::stick : Status::slip;
    const double side = y.y > 0.0 ? 1.0 : -1.0;
    if (now != work.status[j] || (now == Status::slip && side != work.side[j])) out.same = false;
    work.status[j] = now;
    work.side[j] = side;
    if (now == Status::open) it.r[j] = {};
    if (now == Status::slip) it.r[j].y = it.edge(j) * it.r[j].x;
  }
  for (const int contact : work.order) {
    const std::size_t j = index(contact);
    work.unknown[j] = it.active(j) ? out.unknowns : -1;
    if (it.active(j)) out.unknowns += work.status[j] == Status::stick ? 2 : 1;
  }
  return out;
}

/// Rows w_n, and w_t where a contact sticks; columns r_n, and r_t where it sticks: a slipping one
/// has r_t = edge r_n.
void fill_matrix(Newton& it) noexcept {
  CoupledWorkspace& work = it.work;
  for (std::size_t j = 0; j < it.p.size(); ++j) {
    if (!it.active(j)) continue;
    const int row = work.unknown[j];
    const bool second_row = work.status[j] == Status::stick;
    for (std::size_t k = index(it.p.row_start[j]); k < index(it.p.row_start[j + 1]); ++k) {
      const std::size_t l = index(it.p.column[k]);
      if (!it.active(l)) continue;
      const Block& w = it.p.blocks[k];
      const int column = work.unknown[l];
      const double more = l == j ? it.settings.shift / it.p.mass[j] : 0.0;
      const bool second_column = work.status[l] == Status::stick;
      const double edge = second_column ? 0.0 : it.edge(l);
      work.matrix.at(row, column) = more + w[0] + edge * w[1];
      if (second_row) work.matrix.at(row + 1, column) = w[2] + edge * w[3];
      if (second_column) work.matrix.at(row, column + 1) = w[1];
      if (second_row && second_column) work.matrix.at(row + 1, column + 1) = more + w[3];
    }
  }
}

/// Takes r towards the solution for its statuses, by the factors.
void correct(Newton& it) noexcept {
  CoupledWorkspace& work = it.work;
  coupled_velocities(it.p, it.r, work.velocity);
  for (std::size_t j = 0; j < it.p.size(); ++j) {
    if (!it.active(j)) continue;
    const Vec2 lack = it.lack(j);
    const std::size_t row = index(work.unknown[j]);
    work.step[row] = -lack.x;
    if (work.status[j] == Status::stick) work.step[row + 1] = -lack.y;
  }
  work.matrix.solve(work.step);
  for (std::size_t j = 0; j < it.p.size(); ++j) {
    if (!it.active(j)) continue;
    const std::size_t row = index(work.unknown[j]);
    const bool sticks = work.status[j] == Status::stick;
    it.r[j] += {work.step[row], sticks ? work.step[row + 1] : it.edge(j) * work.step[row]};
  }
}

/// Solves for the statuses of r; false where the system is singular.
bool solve_statuses(Newton& it, int unknowns) {
  if (unknowns == 0) return true;
  it.work.matrix.reset(unknowns, std::min(2 * it.settings.width + 1, unknowns - 1));
  fill_matrix(it);
  if (!it.work.matrix.factorise()) return false;
  it.work.step.resize(index(unknowns));
  for (int i = 0; i < refinements; ++i) correct(it);
  return true;
}

/// Halves the step from work.step_from to r until the merit falls; true for the whole step.
bool shorten_step(Newton& it, double before, double after) noexcept {
  bool whole = true;
  for (int i = 0; i < it.settings.halvings && !(after < before); ++i, after = merit(it)) {
    for (std::size_t j = 0; j < it.r.size(); ++j) it.r[j] = 0.5 * (it.r[j] + it.work.step_from[j]);
    whole = false;
  }
  return whole;
}

}  // namespace

int order_contacts(const CoupledProblem& p, CoupledWorkspace& work) {
  std::vector<int>&order = work.order, &mark = work.unknown;
  order.clear();
  std::fill(mark.begin(), mark.end(), 0);
  for (std::size_t j = 0; j < p.size(); ++j) {
    if (mark[j] == 1) continue;
    // From an end of the group: the last contact that the first one reaches.
    const std::size_t known = order.size();
    append_levels(p, static_cast<int>(j), order, mark);
    const int end = order.back();
    for (std::size_t k = known; k < order.size(); ++k) mark[index(order[k])] = 0;
    order.resize(known);
    append_levels(p, end, order, mark);
  }
  for (std::size_t k = 0; k < order.size(); ++k) mark[index(order[k])] = static_cast<int>(k);
  int width = 0;
  for (std::size_t j = 0; j < p.size(); ++j)
    for (std::size_t k = index(p.row_start[j]); k < index(p.row_start[j + 1]); ++k)
      width = std::max(width, std::abs(mark[j] - mark[index(p.column[k])]));
  return width;
}

bool newton_fits(const CoupledProblem& p, int width) noexcept {
  return BandLu::entries(2 * static_cast<long long>(p.size()), 2 * width + 1) <= largest_matrix;
}

NewtonResult newton(const CoupledProblem& p, const NewtonSettings& settings,
                    std::span<Vec2> impulse, CoupledWorkspace& work) {
  Newton it{p, settings, impulse, work};
  NewtonResult out;
  std::copy(impulse.begin(), impulse.end(), work.anchor.begin());
  const double enough = solved_to * solved_to * settings.scale * settings.scale;
  bool whole = false;
  double before = merit(it);
  while (out.steps < settings.most_steps) {
    std::copy(impulse.begin(), impulse.end(), work.step_from.begin());
    const Statuses statuses = find_statuses(it);
    if (whole && statuses.same) out.solved = true;
    if (out.solved) break;
    ++out.steps;
    if (!solve_statuses(it, statuses.unknowns)) break;
    const double after = merit(it);
    if (after <= enough) out.solved = true;
    if (out.solved) break;
    whole = shorten_step(it, before, after);
    before = merit(it);
  }
  return out;
}

}  // namespace rondo::contact
