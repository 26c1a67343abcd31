// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/readable_step.hpp"

#include "rondo/core/contract.hpp"
#include "rondo/integrators/general/step_traps.hpp"
#include "rondo/model/friction_work.hpp"

namespace rondo::dynamics {
namespace {

template <class Vec>
void move_on(const Model& model, std::span<const Vec> v, std::span<Vec> u) noexcept {
  RONDO_ASSERT(u.size() == v.size(), u.size(), v.size());
  for_free_nodes(model, [&](std::size_t k) { u[k] += model.dt * v[k]; });
}

}  // namespace

ReadableStep::ReadableStep(const Model& model, const State& start) : model_(model), state_(start) {
  const std::size_t n = model.n_nodes(), c = model.components();
  RONDO_DEMAND(start.u.size() == n && start.v_next.size() == n && start.u.components() == c,
               start.u.size(), start.v_next.size(), start.u.components(), n);
  RONDO_DEMAND(model.dt > 0.0, model.dt);
  state_.v = Field(n, c);
  if (model.contact) state_.active.reserve(2 * model.contact->nodes.size());
}

void ReadableStep::advance(std::span<StepReport> reports, State* last) noexcept {
  RONDO_DEMAND(!reports.empty());
  for (StepReport& report : reports) {
    const StepTraps traps;
    report = {};
    report.step = ++state_.step;
    StepEnergy energy;
    make_step(energy, report);
    if (model_.friction_work) model_.friction_work->add(model_, state_);
    ledger_.add(energy);
    report.balance = ledger_.last();
  }
  if (model_.friction_work) model_.friction_work->settle();
  if (!last) return;
  last->step = state_.step;
  last->frame = state_.frame;
  last->u = state_.u;
  last->poses = state_.poses;
  last->active = state_.active;
  velocities(last->v, last->v_next);
}

void ReadableStep::velocities(Field& before, Field& after) const noexcept {
  if (!before.empty()) before = state_.v;
  if (!after.empty()) after = state_.v_next;
}

void ReadableStep::fields(State& state) const noexcept {
  state.u = state_.u;
  state.v_next = state_.v_next;
  if (model_.solid)
    move_on(model_, state_.v_next.space(), state.u.space());
  else
    move_on(model_, state_.v_next.plane(), state.u.plane());
}

SavedState ReadableStep::save() const {
  SavedState saved;
  saved.step = state_.step;
  saved.ledger = ledger_.save();
  save_fields(saved);
  return saved;
}

void ReadableStep::restore(const SavedState& saved) {
  RONDO_DEMAND(saved.u.size() == model_.n_nodes() && saved.v.size() == model_.n_nodes(),
               saved.u.size(), saved.v.size(), model_.n_nodes());
  state_.step = saved.step;
  ledger_.restore(saved.ledger);
  restore_fields(saved);
}

void ReadableStep::save_fields(SavedState& saved) const {
  saved.u = state_.u;
  saved.v = state_.v_next;
}

void ReadableStep::restore_fields(const SavedState& saved) {
  state_.u = saved.u;
  state_.v_next = saved.v;
}

}  // namespace rondo::dynamics
