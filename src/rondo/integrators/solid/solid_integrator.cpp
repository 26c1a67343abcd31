// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_integrator.hpp"

#include <span>
#include <utility>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {

SolidIntegrator::SolidIntegrator(const Model& model, const State& start)
    : ReadableStep(model, start), forces_(model, start), contacts_(model) {
  RONDO_DEMAND(!model.rim && model.scheme == Scheme::symplectic);
}

/// u_{n+1}, and the energy of the half step before it.
void SolidIntegrator::move(StepEnergy& energy) noexcept {
  const std::span u = state_.u.space(), v = state_.v.space();
  for_free_nodes(model_, [&](std::size_t k) {
    u[k] += model_.dt * v[k];
    energy.kinetic += 0.5 * model_.mass[k] * dot(v[k], v[k]);
  });
  state_.frame = frame_step(model_.motion, state_.step, model_.dt);
  energy.strain = forces_.evaluate(u, v, state_.frame);
}

/// v⁺ = v⁻ + [Δt f/m - drag v⁻]/a in the plane, A along the axle, without contact.
void SolidIntegrator::free_velocities(const VelocityUpdate& update, double axial_a) noexcept {
  const double dt = model_.dt;
  const std::span u = state_.u.space(), before = state_.v.space(), next = state_.v_next.space();
  for_free_nodes(model_, [&](std::size_t k) {
    const Vec3 force = forces_.load(k) - forces_.gradient(k) - forces_.damping(k);
    const Vec3 push = dt * (force / model_.mass[k] - acceleration_of_frame(u[k], k));
    const Vec3 v = before[k];
    const Vec2 plane = v.plane() + (push.plane() - update.drag * v.plane()) / update.a;
    next[k] = {plane, v.z + (push.z - dt * model_.mass_damping * v.z) / axial_a};
  });
}

void SolidIntegrator::add_works(Works& w) const noexcept {
  const double dt = model_.dt;
  const std::span u = state_.u.space(), v = state_.v.space(), v_next = state_.v_next.space();
  for_free_nodes(model_, [&](std::size_t k) {
    const double m = model_.mass[k];
    const Vec3 mean = 0.5 * (v[k] + v_next[k]);
    w.frame -= dt * m * dot(mean, acceleration_of_frame(u[k], k));
    w.dissipation_mass += dt * model_.mass_damping * m * dot(mean, mean);
    w.dissipation_stiffness += dt * dot(mean, forces_.damping(k));
    w.load += dt * dot(mean, forces_.load(k));
  });
}

void SolidIntegrator::make_step(StepEnergy& energy, StepReport& report) noexcept {
  std::swap(state_.v, state_.v_next);
  move(energy);
  const FrameStep& frame = state_.frame;
  const VelocityUpdate update =
      velocity_update(model_.scheme, model_.dt, model_.mass_damping, frame.spin);
  const double axial_a = 1.0 + 0.5 * model_.dt * model_.mass_damping;
  free_velocities(update, axial_a);
  report.frame = frame;
  report.contact = contacts_.solve(SolidContactStep(model_, frame, update, axial_a), state_);
  add_works(energy.works);
  set_contact_works(report.contact, energy.works);
  report.material = forces_.material();
}

void SolidIntegrator::save_fields(SavedState& saved) const {
  ReadableStep::save_fields(saved);
  forces_.save(saved);
  saved.impulses = contacts_.impulses();
}

void SolidIntegrator::restore_fields(const SavedState& saved) {
  ReadableStep::restore_fields(saved);
  forces_.restore(saved);
  contacts_.set_impulses(saved.impulses);
}

}  // namespace rondo::dynamics
