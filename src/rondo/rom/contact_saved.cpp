// SPDX-License-Identifier: BSD-3-Clause
/// Saves and restores the contact of reduced steps (saved_reduced.hpp).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/contact_problem.hpp"

namespace rondo::rom {

SavedContact ContactSolver::save() const {
  SavedContact s;
  s.steps = steps_;
  for (std::size_t k = 0; k < warm_.size(); ++k)
    if (!(warm_[k] == Vec2{})) s.impulses.emplace_back(static_cast<int>(k), warm_[k]);
  for (const Phase& phase : phases_)
    s.phases.push_back({phase.share, phase.used, phase.table->portions()});
  return s;
}

bool ContactSolver::fits(const SavedContact& s) const noexcept {
  const auto is_point = [&](int k) { return k >= 0 && static_cast<std::size_t>(k) < warm_.size(); };
  const auto are_points = [&](const SavedPhase& phase) {
    return std::ranges::all_of(phase.portions, [&](const std::vector<int>& portion) {
      return std::ranges::all_of(portion, is_point);
    });
  };
  const auto is_apart = [&](const SavedPhase& phase) {
    return std::isfinite(phase.share) &&
           std::ranges::count_if(s.phases, [&](const SavedPhase& other) {
             return std::abs(other.share - phase.share) < same_phase;
           }) == 1;
  };
  const bool phases = nodes_ ? s.phases.size() <= most_phases_ : s.phases.size() == 1;
  return phases && std::ranges::all_of(s.phases, is_apart) &&
         std::ranges::all_of(s.phases, are_points) &&
         std::ranges::all_of(s.impulses, [&](const auto& one) { return is_point(one.first); });
}

void ContactSolver::restore(const SavedContact& s, const StepMatrices* matrices) {
  RONDO_DEMAND(fits(s));
  steps_ = s.steps;
  contacts_.clear();
  std::ranges::fill(warm_, Vec2{});
  for (const auto& [material, impulse] : s.impulses) warm_[at(material)] = impulse;
  if (nodes_) phases_.clear();
  for (const SavedPhase& phase : s.phases) {
    if (nodes_) static_cast<void>(table_of(phase.share));
    Phase& own = phases_[at(&phase - s.phases.data())];
    own.used = phase.used;
    if (own.table->portions() == phase.portions) continue;
    own.table->forget();
    if (!matrices) continue;
    for (const std::vector<int>& portion : phase.portions) own.table->prepare(portion, *matrices);
  }
}

}  // namespace rondo::rom
