// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_integrator.hpp"

#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/general/step_traps.hpp"

namespace rondo::dynamics {
SolidIntegrator::SolidIntegrator(const Model& model, const State& start)
    : model_(model),
      step_(start.step),
      frame_(start.frame),
      u_(to_vector(start.u.space())),
      v_(model.n_nodes()),
      v_next_(to_vector(start.v_next.space())),
      forces_(model, u_),
      contacts_(model) {
  RONDO_DEMAND(!model.rim && model.scheme == Scheme::symplectic);
  RONDO_DEMAND(v_next_.size() == model.n_nodes() && model.dt > 0.0, v_next_.size(), model.n_nodes(),
               model.dt);
}

/// u_{n+1}, and the energy of the half step before it.
void SolidIntegrator::move(StepEnergy& energy) noexcept {
  for_free_nodes(model_, [&](std::size_t k) {
    u_[k] += model_.dt * v_[k];
    energy.kinetic += 0.5 * model_.mass[k] * dot(v_[k], v_[k]);
  });
  frame_ = frame_step(model_.motion, step_, model_.dt);
  forces_.evaluate(u_, frame_.time);
  for_free_nodes(model_, [&](std::size_t k) {
    energy.strain += 0.5 * dot(u_[k], forces_.gradient_before(k));
  });
}

/// v⁺ = v⁻ + [Δt f/m - drag v⁻]/a in the plane, A along the axle, without contact.
void SolidIntegrator::free_velocities(const VelocityUpdate& update, double axial_a) noexcept {
  const double dt = model_.dt;
  for_free_nodes(model_, [&](std::size_t k) {
    const Vec3 force = forces_.load(k) - forces_.gradient(k) - forces_.damping(k);
    const Vec3 push = dt * (force / model_.mass[k] - acceleration_of_frame(k));
    const Vec3 v = v_[k];
    const Vec2 plane = v.plane() + (push.plane() - update.drag * v.plane()) / update.a;
    v_next_[k] = {plane, v.z + (push.z - dt * model_.mass_damping * v.z) / axial_a};
  });
}

void SolidIntegrator::add_works(Works& w) const noexcept {
  const double dt = model_.dt;
  for_free_nodes(model_, [&](std::size_t k) {
    const double m = model_.mass[k];
    const Vec3 mean = 0.5 * (v_[k] + v_next_[k]);
    w.frame -= dt * m * dot(mean, acceleration_of_frame(k));
    w.dissipation_mass += dt * model_.mass_damping * m * dot(mean, mean);
    w.dissipation_stiffness += dt * dot(mean, forces_.damping(k));
    w.load += dt * dot(mean, forces_.load(k));
  });
}

StepReport SolidIntegrator::step() noexcept {
  const StepTraps traps;
  std::swap(v_, v_next_);
  ++step_;
  StepEnergy energy;
  move(energy);
  const VelocityUpdate update =
      velocity_update(model_.scheme, model_.dt, model_.mass_damping, frame_.spin);
  const double axial_a = 1.0 + 0.5 * model_.dt * model_.mass_damping;
  free_velocities(update, axial_a);
  StepReport report;
  report.step = step_;
  report.frame = frame_;
  report.contact =
      contacts_.solve(SolidContactStep(model_, frame_, update, axial_a), u_, v_, v_next_);
  add_works(energy.works);
  set_contact_works(report.contact, energy.works);
  ledger_.add(energy);
  report.balance = ledger_.last();
  return report;
}

void SolidIntegrator::advance(std::span<StepReport> reports, State* last) noexcept {
  RONDO_DEMAND(!reports.empty());
  for (StepReport& report : reports) report = step();
  if (!last) return;
  last->step = step_;
  last->frame = frame_;
  last->u = u_;
  last->active = contacts_.active();
  if (last->v.empty()) return;
  last->v = v_;
  if (last->v_next.empty()) return;
  last->v_next = v_next_;
}

void SolidIntegrator::fields(State& state) const noexcept {
  state.u = u_;
  for_free_nodes(model_, [&](std::size_t k) { state.u.space()[k] += model_.dt * v_next_[k]; });
  state.v_next = v_next_;
}

SavedState SolidIntegrator::save() const {
  SavedState saved;
  saved.step = step_;
  saved.u = u_;
  saved.v = v_next_;
  saved.force = forces_.saved();
  saved.impulses = contacts_.impulses();
  saved.ledger = ledger_.save();
  return saved;
}

void SolidIntegrator::restore(const SavedState& saved) {
  RONDO_DEMAND(saved.u.size() == model_.n_nodes() && saved.force.size() == model_.n_nodes(),
               saved.u.size(), saved.force.size());
  RONDO_DEMAND(saved.v.size() == model_.n_nodes(), saved.v.size(), model_.n_nodes());
  step_ = saved.step;
  u_ = to_vector(saved.u.space());
  v_next_ = to_vector(saved.v.space());
  forces_.restore(saved.force);
  contacts_.set_impulses(saved.impulses);
  ledger_.restore(saved.ledger);
}

}  // namespace rondo::dynamics
