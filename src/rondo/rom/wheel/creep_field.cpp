// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/creep_field.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

/// Numbers below it are 0: what decays for ever would end in numbers that are slow to compute with.
constexpr double faded = 1e-100;

double unless_faded(double x) noexcept {
  return x < faded && x > -faded ? 0.0 : x;
}

Vec2 mixed(const CreepStep& step, Vec2 old, Vec2 before, Vec2 now) noexcept {
  const Vec2 sum = step.kept * old + step.before * before + step.now * now;
  return {unless_faded(sum.x), unless_faded(sum.y)};
}

}  // namespace

CreepField::CreepField(std::span<const CreepTerm> terms, std::span<const RingResidual> at_once,
                       std::span<const RingResidual> later, std::size_t n, double stiffness_damping,
                       double dt)
    : tables_{at_once, later},
      n_(n),
      n_tables_(at_once.size()),
      stiffness_damping_(stiffness_damping),
      dt_(dt) {
  RONDO_DEMAND(terms.size() >= 2 && at_once.size() == later.size() && at_once.size() <= 3,
               terms.size(), at_once.size(), later.size());
  for (const CreepTerm& term : terms)
    terms_.push_back({term.share, term.time, creep_step(term.time, dt)});
  new_at_once_ = terms_[0].share * terms_[0].step.now;
  for (std::size_t b = 1; b < terms_.size(); ++b)
    new_later_ += terms_[b].share * terms_[b].step.now;
  const Field nothing(n);
  Fields of_tables;
  for (std::size_t a = 0; a < n_tables_; ++a) of_tables[a] = nothing;
  last_ = acting_ = nothing;
  force_.assign(terms.size(), nothing);
  force_before_ = force_;
  moved_.assign(terms.size(), of_tables);
  moved_before_ = moved_;
  pushed_ = {of_tables, of_tables};
  pushing_ = pushed_;
  now_ = left_ = of_tables;
}

void CreepField::clear() noexcept {
  start({});
}

/// G times a force on a node, added to all nodes.
void CreepField::add_product(const RingResidual& table, const NodeForce& from,
                             Field& out) const noexcept {
  const std::size_t size = at(table.size), c = size / 2, sectors = at(table.n_sectors),
                    sector = at(from.node) / c, local = at(from.node) % c;
  for (std::size_t d = 0; d < sectors; ++d) {
    const double* by_x = table.blocks.data() + (d * size + 2 * local) * size;
    const double* by_y = by_x + size;
    Vec2* to = out.data() + (sector + d < sectors ? sector + d : sector + d - sectors) * c;
    for (std::size_t i = 0; i < c; ++i)
      to[i] += Vec2{by_x[2 * i] * from.force.x + by_y[2 * i] * from.force.y,
                    by_x[2 * i + 1] * from.force.x + by_y[2 * i + 1] * from.force.y};
  }
}

/// Finds the products of the tables with new forces.
void CreepField::push(std::span<const NodeForce> forces) noexcept {
  std::ranges::fill(acting_, Vec2{});
  for (const NodeForce& from : forces) acting_[at(from.node)] += from.force;
  for (std::size_t kind = 0; kind < 2; ++kind)
    for (std::size_t a = 0; a < n_tables_; ++a) {
      std::ranges::fill(pushing_[kind][a], Vec2{});
      for (const NodeForce& from : forces) add_product(tables_[kind][a], from, pushing_[kind][a]);
    }
}

/// Sums over the terms, after a step.
void CreepField::find_sums() noexcept {
  for (std::size_t a = 0; a < n_tables_; ++a) {
    std::ranges::fill(now_[a], Vec2{});
    std::ranges::fill(left_[a], Vec2{});
    for (std::size_t b = 0; b < terms_.size(); ++b) {
      const Step& term = terms_[b];
      const double kept = term.share * term.step.kept, before = term.share * term.step.before;
      const Field &moved = moved_[b][a], &pushed = pushed_[kind(b)][a];
      for (std::size_t i = 0; i < n_; ++i) {
        now_[a][i] += term.share * moved[i];
        left_[a][i] += kept * moved[i] + before * pushed[i];
      }
    }
  }
}

void CreepField::start(std::span<const NodeForce> forces) noexcept {
  push(forces);
  std::swap(pushed_, pushing_);
  last_ = acting_;
  for (std::size_t b = 0; b < terms_.size(); ++b) {
    force_[b] = force_before_[b] = last_;
    for (std::size_t a = 0; a < n_tables_; ++a)
      moved_[b][a] = moved_before_[b][a] = pushed_[kind(b)][a];
  }
  find_sums();
}

void CreepField::step(std::span<const NodeForce> forces) noexcept {
  push(forces);
  for (std::size_t b = 0; b < terms_.size(); ++b) {
    const CreepStep& step = terms_[b].step;
    std::swap(force_[b], force_before_[b]);
    for (std::size_t i = 0; i < n_; ++i)
      force_[b][i] = mixed(step, force_before_[b][i], last_[i], acting_[i]);
    for (std::size_t a = 0; a < n_tables_; ++a) {
      std::swap(moved_[b][a], moved_before_[b][a]);
      const Field &old = moved_before_[b][a], &before = pushed_[kind(b)][a],
                  &now = pushing_[kind(b)][a];
      for (std::size_t i = 0; i < n_; ++i) moved_[b][a][i] = mixed(step, old[i], before[i], now[i]);
    }
  }
  std::swap(pushed_, pushing_);
  std::swap(last_, acting_);
  find_sums();
}

/// In the order of energy(), whose at_start it is in the next step to the last bit.
double CreepField::stored(const TableShares& shares) const noexcept {
  double energy = 0.0;
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t b = 0; b < terms_.size(); ++b)
      energy +=
          0.5 * terms_[b].share * dot(force_[b][i], sum(moved_[b], static_cast<int>(i), shares));
  return energy;
}

/// The force of a term in a step is the mean of its lagging force, and what its damper adds.
CreepEnergy CreepField::energy(const TableShares& shares) const noexcept {
  CreepEnergy e;
  for (std::size_t i = 0; i < n_; ++i) {
    Vec2 force, way;  // of all terms together
    for (std::size_t b = 0; b < terms_.size(); ++b) {
      const double share = terms_[b].share, rate = terms_[b].time / dt_;
      const Vec2 old = force_before_[b][i], now = force_[b][i], more = now - old;
      const Vec2 from = sum(moved_before_[b], static_cast<int>(i), shares),
                 to = sum(moved_[b], static_cast<int>(i), shares), moved = to - from;
      e.at_start += 0.5 * share * dot(old, from);
      e.at_end += 0.5 * share * dot(now, to);
      e.work += share * dot(0.5 * (old + now) + rate * more, moved);
      e.lost += share * rate * dot(more, moved);
      force += share * more;
      way += share * moved;
    }
    e.by_stiffness += stiffness_damping_ / dt_ * dot(force, way);
  }
  e.by_stiffness = std::clamp(e.by_stiffness, 0.0, std::max(0.0, e.lost));
  return e;
}

CreepField::Lagging CreepField::lagging_of(const std::vector<Field>& force,
                                           int node) const noexcept {
  Lagging sum{terms_[0].share * force[0][at(node)], {}};
  for (std::size_t b = 1; b < terms_.size(); ++b) sum.later += terms_[b].share * force[b][at(node)];
  return sum;
}

void CreepField::save(std::vector<double>& out) const {
  const auto put = [&](const Field& field) {
    for (const Vec2 x : field) out.insert(out.end(), {x.x, x.y});
  };
  put(last_);
  for (const Field& force : force_) put(force);
  for (std::size_t a = 0; a < n_tables_; ++a) {
    for (const Fields& pushed : pushed_) put(pushed[a]);
    for (const Fields& moved : moved_) put(moved[a]);
  }
}

void CreepField::restore(std::span<const double> numbers) noexcept {
  RONDO_DEMAND(numbers.size() == n_numbers(terms_.size(), n_tables_, n_), numbers.size(), n_);
  const auto take = [&](Field& field) {
    for (Vec2& x : field) {
      x = {numbers[0], numbers[1]};
      numbers = numbers.subspan(2);
    }
  };
  take(last_);
  for (Field& force : force_) take(force);
  for (std::size_t a = 0; a < n_tables_; ++a) {
    for (Fields& pushed : pushed_) take(pushed[a]);
    for (Fields& moved : moved_) take(moved[a]);
  }
  force_before_ = force_;
  moved_before_ = moved_;
  find_sums();
}

}  // namespace rondo::rom
