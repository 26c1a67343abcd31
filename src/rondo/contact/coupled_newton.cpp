// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled_newton.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rondo::contact {
namespace {

/// Share of its diagonal that is added to the matrix, each solution then being a step towards that
/// of the matrix itself: redundant contacts leave it singular, and what they share undetermined.
constexpr double shift = 1e-11;
constexpr int refinements = 3;
constexpr long long largest_matrix = 8'000'000;  ///< numbers

std::size_t index(int i) noexcept {
  return static_cast<std::size_t>(i);
}

std::size_t row_begin(const CoupledProblem& p, std::size_t j) noexcept {
  return index(p.row_start[j]);
}

std::size_t row_end(const CoupledProblem& p, std::size_t j) noexcept {
  return index(p.row_start[j + 1]);
}

/// Appends to `order` all that `first` reaches, level by level; `mark` is 1 for what is there.
void append_levels(const CoupledProblem& p, int first, std::vector<int>& order,
                   std::vector<int>& mark) {
  std::size_t next = order.size();
  order.push_back(first);
  mark[index(first)] = 1;
  for (; next < order.size(); ++next) {
    const std::size_t j = index(order[next]);
    for (std::size_t k = row_begin(p, j); k < row_end(p, j); ++k) {
      if (mark[index(p.column[k])] == 1) continue;
      mark[index(p.column[k])] = 1;
      order.push_back(p.column[k]);
    }
  }
}

/// Statuses by the law at each contact with the others as they are; the impulses of open ones are
/// set to zero, those of slipping ones to the edge of the cone.
int find_statuses(const CoupledProblem& p, std::span<Vec2> impulse, CoupledWorkspace& work) {
  coupled_velocities(p, impulse, work.velocity);
  for (std::size_t j = 0; j < p.size(); ++j) {
    const Block& w = diagonal_block(p, j);
    const LocalSolution s =
        solve_block(w, work.velocity[j] - w * impulse[j], p.bounce[j], p.friction[j]);
    work.status[j] = s.status;
    work.side[j] = s.impulse.y > 0.0 ? 1.0 : -1.0;
  }
  int unknowns = 0;
  for (const int contact : work.order) {
    const std::size_t j = index(contact);
    work.unknown[j] = work.status[j] == Status::open ? -1 : unknowns;
    if (work.status[j] == Status::open) impulse[j] = {};
    if (work.status[j] == Status::slip) impulse[j].y = work.side[j] * p.friction[j] * impulse[j].x;
    unknowns += work.status[j] == Status::stick ? 2 : work.status[j] == Status::slip ? 1 : 0;
  }
  return unknowns;
}

void fill_matrix(const CoupledProblem& p, CoupledWorkspace& work) {
  for (std::size_t j = 0; j < p.size(); ++j) {
    if (work.status[j] == Status::open) continue;
    const int row = work.unknown[j];
    const bool tangent_row = work.status[j] == Status::stick;
    for (std::size_t k = row_begin(p, j); k < row_end(p, j); ++k) {
      const std::size_t l = index(p.column[k]);
      if (work.status[l] == Status::open) continue;
      const Block& w = p.blocks[k];
      const int column = work.unknown[l];
      const double more = l == j ? 1.0 + shift : 1.0;
      if (work.status[l] == Status::slip) {
        const double edge = work.side[l] * p.friction[l];
        work.matrix.at(row, column) = more * (w[0] + edge * w[1]);
        if (tangent_row) work.matrix.at(row + 1, column) = w[2] + edge * w[3];
        continue;
      }
      work.matrix.at(row, column) = more * w[0];
      work.matrix.at(row, column + 1) = w[1];
      if (!tangent_row) continue;
      work.matrix.at(row + 1, column) = w[2];
      work.matrix.at(row + 1, column + 1) = more * w[3];
    }
  }
}

/// What the active contacts lack: -(w_n + bounce), and -w_t where they stick.
void fill_right_side(const CoupledProblem& p, std::span<const Vec2> impulse,
                     CoupledWorkspace& work) {
  coupled_velocities(p, impulse, work.velocity);
  for (std::size_t j = 0; j < p.size(); ++j) {
    if (work.status[j] == Status::open) continue;
    const std::size_t row = index(work.unknown[j]);
    work.step[row] = -(work.velocity[j].x + p.bounce[j]);
    if (work.status[j] == Status::stick) work.step[row + 1] = -work.velocity[j].y;
  }
}

void add_step(const CoupledProblem& p, std::span<Vec2> impulse, const CoupledWorkspace& work) {
  for (std::size_t j = 0; j < p.size(); ++j) {
    if (work.status[j] == Status::open) continue;
    const std::size_t row = index(work.unknown[j]);
    impulse[j].x += work.step[row];
    impulse[j].y += work.status[j] == Status::stick ? work.step[row + 1]
                                                    : work.side[j] * p.friction[j] * work.step[row];
  }
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
    for (std::size_t k = row_begin(p, j); k < row_end(p, j); ++k)
      width = std::max(width, std::abs(mark[j] - mark[index(p.column[k])]));
  return width;
}

bool newton_fits(const CoupledProblem& p, int width) noexcept {
  return BandLu::entries(2 * static_cast<long long>(p.size()), 2 * width + 1) <= largest_matrix;
}

bool newton_step(const CoupledProblem& p, int width, std::span<Vec2> impulse,
                 CoupledWorkspace& work) {
  const int unknowns = find_statuses(p, impulse, work);
  if (unknowns == 0) return true;
  work.matrix.reset(unknowns, std::min(2 * width + 1, unknowns - 1));
  fill_matrix(p, work);
  if (!work.matrix.factorise()) return false;
  work.step.resize(index(unknowns));
  for (int i = 0; i < refinements; ++i) {
    fill_right_side(p, impulse, work);
    work.matrix.solve(work.step);
    add_step(p, impulse, work);
  }
  return true;
}

}  // namespace rondo::contact
