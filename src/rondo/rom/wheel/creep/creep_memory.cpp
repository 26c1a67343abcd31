// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/creep/creep_memory.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"

namespace rondo::rom {
namespace {

using Numbers = CreepMemory::Numbers;

/// Numbers below it are 0: what decays for ever would end in numbers that are slow to compute with.
constexpr double faded = 1e-100;

double unless_faded(double x) noexcept {
  return x < faded && x > -faded ? 0.0 : x;
}

/// λ_b⁺ = kept λ_b + before λ + now λ⁺.
void mix(const CreepStep& step, const Numbers& old, const Numbers& before, const Numbers& now,
         Numbers& out) noexcept {
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = unless_faded(step.kept * old[i] + step.before * before[i] + step.now * now[i]);
}

}  // namespace

CreepMemory::CreepMemory(std::span<const CreepTerm> terms, std::size_t n_tables, std::size_t group,
                         Numbers weights, double stiffness_damping, double dt)
    : n_tables_(n_tables),
      group_(group),
      weights_(std::move(weights)),
      stiffness_damping_(stiffness_damping),
      dt_(dt),
      more_(group),
      way_(group) {
  RONDO_DEMAND(terms.size() >= 2 && n_tables >= 1 && n_tables <= 3, terms.size(), n_tables);
  for (const CreepTerm& term : terms)
    terms_.push_back({term.share, term.time, creep_step(term.time, dt)});
  new_at_once_ = terms_[0].share * terms_[0].step.now;
  for (std::size_t b = 1; b < terms_.size(); ++b)
    new_later_ += terms_[b].share * terms_[b].step.now;
  const Numbers nothing(group_ * weights_.size());
  ByTable of_tables;
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

/// Sums over the terms, after a step.
void CreepMemory::find_sums() noexcept {
  for (std::size_t a = 0; a < n_tables_; ++a) {
    std::ranges::fill(now_[a], 0.0);
    std::ranges::fill(left_[a], 0.0);
    for (std::size_t b = 0; b < terms_.size(); ++b) {
      const Step& term = terms_[b];
      const double kept = term.share * term.step.kept, before = term.share * term.step.before;
      const Numbers &moved = moved_[b][a], &pushed = pushed_[kind(b)][a];
      for (std::size_t i = 0; i < moved.size(); ++i) {
        now_[a][i] += term.share * moved[i];
        left_[a][i] += kept * moved[i] + before * pushed[i];
      }
    }
  }
}

void CreepMemory::start() noexcept {
  std::swap(pushed_, pushing_);
  last_ = acting_;
  for (std::size_t b = 0; b < terms_.size(); ++b) {
    force_[b] = force_before_[b] = last_;
    for (std::size_t a = 0; a < n_tables_; ++a)
      moved_[b][a] = moved_before_[b][a] = pushed_[kind(b)][a];
  }
  find_sums();
}

void CreepMemory::step() noexcept {
  for (std::size_t b = 0; b < terms_.size(); ++b) {
    const CreepStep& step = terms_[b].step;
    std::swap(force_[b], force_before_[b]);
    mix(step, force_before_[b], last_, acting_, force_[b]);
    for (std::size_t a = 0; a < n_tables_; ++a) {
      std::swap(moved_[b][a], moved_before_[b][a]);
      mix(step, moved_before_[b][a], pushed_[kind(b)][a], pushing_[kind(b)][a], moved_[b][a]);
    }
  }
  std::swap(pushed_, pushing_);
  std::swap(last_, acting_);
  find_sums();
}

/// In the order of energy(), whose at_start it is in the next step to the last bit.
double CreepMemory::stored(const TableShares& shares) const noexcept {
  double energy = 0.0;
  for (std::size_t g = 0; g < weights_.size(); ++g)
    for (std::size_t b = 0; b < terms_.size(); ++b) {
      double product = 0.0;
      for (std::size_t i = g * group_; i < (g + 1) * group_; ++i)
        product += force_[b][i] * sum(moved_[b], i, shares);
      energy += 0.5 * terms_[b].share * weights_[g] * product;
    }
  return energy;
}

/// The force of a term in a step is the mean of its lagging force, and what its damper adds.
CreepEnergy CreepMemory::energy(const TableShares& shares) const noexcept {
  CreepEnergy e;
  for (std::size_t g = 0; g < weights_.size(); ++g) {
    std::ranges::fill(more_, 0.0);
    std::ranges::fill(way_, 0.0);
    for (std::size_t b = 0; b < terms_.size(); ++b) {
      const double share = terms_[b].share, rate = terms_[b].time / dt_;
      double at_start = 0.0, at_end = 0.0, work = 0.0, lost = 0.0;
      for (std::size_t l = 0, i = g * group_; l < group_; ++l, ++i) {
        const double old = force_before_[b][i], now = force_[b][i], more = now - old;
        const double from = sum(moved_before_[b], i, shares), to = sum(moved_[b], i, shares),
                     moved = to - from;
        at_start += old * from;
        at_end += now * to;
        work += (0.5 * (old + now) + rate * more) * moved;
        lost += more * moved;
        more_[l] += share * more;
        way_[l] += share * moved;
      }
      const double counted = share * weights_[g];
      e.at_start += 0.5 * counted * at_start;
      e.at_end += 0.5 * counted * at_end;
      e.work += counted * work;
      e.lost += counted * rate * lost;
    }
    double damped = 0.0;
    for (std::size_t l = 0; l < group_; ++l) damped += more_[l] * way_[l];
    e.by_stiffness += stiffness_damping_ / dt_ * weights_[g] * damped;
  }
  e.by_stiffness = std::clamp(e.by_stiffness, 0.0, std::max(0.0, e.lost));
  return e;
}

CreepMemory::Lagging CreepMemory::lagging_of(const std::vector<Numbers>& force,
                                             std::size_t i) const noexcept {
  Lagging sum{terms_[0].share * force[0][i], 0.0};
  for (std::size_t b = 1; b < terms_.size(); ++b) sum.later += terms_[b].share * force[b][i];
  return sum;
}

template <class Self, class Work>
void CreepMemory::for_kept(Self& self, Work&& work) {
  work(self.last_);
  for (auto& force : self.force_) work(force);
  for (std::size_t a = 0; a < self.n_tables_; ++a) {
    for (auto& pushed : self.pushed_) work(pushed[a]);
    for (auto& moved : self.moved_) work(moved[a]);
  }
}

void CreepMemory::save(std::vector<double>& out) const {
  for_kept(*this, [&](const Numbers& kept) { out.insert(out.end(), kept.begin(), kept.end()); });
}

void CreepMemory::restore(std::span<const double> numbers) noexcept {
  RONDO_DEMAND(numbers.size() == n_saved(terms_.size(), n_tables_, last_.size()), numbers.size(),
               last_.size());
  for_kept(*this, [&](Numbers& kept) {
    std::ranges::copy(numbers.first(kept.size()), kept.begin());
    numbers = numbers.subspan(kept.size());
  });
  force_before_ = force_;
  moved_before_ = moved_;
  find_sums();
}

}  // namespace rondo::rom
