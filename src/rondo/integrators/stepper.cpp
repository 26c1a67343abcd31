// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/stepper.hpp"

#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/body_frames.hpp"
#include "rondo/integrators/step_traps.hpp"
#include "rondo/model/corotated.hpp"
#include "rondo/model/operator.hpp"
#include "rondo/model/pressure.hpp"

namespace rondo::dynamics {
namespace {

/// f/m at t_{n+1} (3.2).
Vec2 acceleration(const Model& model, const State& state, const FrameStep& frame, std::size_t k,
                  Vec2 stiffness_rate) noexcept {
  const Vec2 elastic = state.force[k] + model.stiffness_damping * stiffness_rate;
  return -(elastic / model.mass[k]) - frame_acceleration(frame, model.reference[k] + state.u[k]);
}

/// K v⁻, from the products of two steps.
Vec2 stiffness_rate(const Model& model, const State& state, std::size_t k) noexcept {
  return (state.force[k] - state.force_before[k]) / model.dt;
}

/// v⁺ = v⁻ + [Δt f/m - drag v⁻]/a, without contact (3.4). The increment form does not drift.
void free_velocities(const Model& model, State& state, const VelocityUpdate& update) noexcept {
  const Complex inverse = Complex{1.0, 0.0} / update.a;
  for_free_nodes(model, [&](std::size_t k) {
    const Vec2 v = state.v[k];
    const Vec2 f = acceleration(model, state, state.frame, k, stiffness_rate(model, state, k));
    state.v_next[k] = v + inverse * (model.dt * f - update.drag * v);
  });
}

ContactReport contacts(const Model& model, State& state, const VelocityUpdate& update) noexcept {
  ContactReport report;
  state.active.clear();
  const ContactModel& contact = *model.contact;
  const ContactStep step(model, state.frame, update);
  for (std::size_t i = 0; i < contact.nodes.size(); ++i) {
    const auto k = static_cast<std::size_t>(contact.nodes[i]);
    const contact::Touches touches = contact.ground.touches(position(model, state, k));
    if (touches.count == 0) continue;
    const std::size_t first = state.active.size();
    state.active.resize(first + static_cast<std::size_t>(touches.count));
    state.v_next[k] = solve_contacts(step,
                                     {i, model.mass[k], contact.tributary[i],
                                      model.reference[k] + state.u[k], state.v[k], state.v_next[k]},
                                     touches, std::span(state.active).subspan(first), report);
  }
  return report;
}

/// E_{n+1/2} (5.1): before the product is made anew.
void add_energy(const Model& model, const State& state, StepEnergy& energy) noexcept {
  for_free_nodes(model, [&](std::size_t k) {
    energy.kinetic += 0.5 * model.mass[k] * dot(state.v[k], state.v[k]);
    energy.strain += 0.5 * dot(state.u[k], state.force_before[k]);
  });
}

/// (5.3)
void add_works(const Model& model, const State& state, Works& w) noexcept {
  const double dt = model.dt;
  const bool printed = model.scheme == Scheme::as_printed;
  for_free_nodes(model, [&](std::size_t k) {
    const double m = model.mass[k];
    const Vec2 v = state.v[k];
    const Vec2 mean = 0.5 * (v + state.v_next[k]);
    w.frame -= dt * m * dot(mean, frame_acceleration(state.frame, model.reference[k] + state.u[k]));
    w.dissipation_mass += dt * model.mass_damping * m * dot(mean, printed ? v : mean);
    w.dissipation_stiffness +=
        dt * model.stiffness_damping * dot(mean, stiffness_rate(model, state, k));
    if (printed) w.scheme -= 2.0 * dt * state.frame.spin * m * dot(mean, turn90(v));
  });
}

void clear_clamped(const Model& model, State& state) noexcept {
  std::size_t next_free = 0;
  for (std::size_t k = 0; k < model.n_nodes(); ++k) {
    if (next_free < model.free.size() && static_cast<std::size_t>(model.free[next_free]) == k)
      ++next_free;
    else
      state.u[k] = state.v[k] = Vec2{};
  }
}

/// K u_0 and what pressures add, in `force`; poses of the free bodies.
void find_start_forces(const Model& model, State& state) {
  update_poses(model, state.u, state.poses);
  std::vector<Vec2> elastic(model.n_nodes()), product(model.n_nodes());
  elastic_displacements(model, state.u, state.poses, elastic);
  apply_stiffness(model, elastic, product);
  to_gradient(model, elastic, product, state.poses, state.force);
  if (model.pressures.empty()) return;
  pressure_forces(model, state.u, 0.0, product);
  for_free_nodes(model, [&](std::size_t k) { state.force[k] -= product[k]; });
}

}  // namespace

State start(const Model& model, std::vector<Vec2> u0, std::vector<Vec2> v0) {
  RONDO_DEMAND(u0.size() == model.n_nodes() && v0.size() == model.n_nodes(), u0.size(), v0.size());
  RONDO_DEMAND(model.dt > 0.0, model.dt);
  State state;
  state.u = std::move(u0);
  state.v = std::move(v0);
  clear_clamped(model, state);
  state.v_next.resize(model.n_nodes());
  if (model.contact) state.active.reserve(2 * model.contact->nodes.size());
  state.frame = frame_step(model.motion, 0, model.dt);
  for (const FreeBody& body : model.free_bodies) state.poses.push_back({body.center});
  state.force.resize(model.n_nodes());
  state.force_before.resize(model.n_nodes());
  find_start_forces(model, state);
  apply_stiffness(model, state.v, state.force_before);  // K v_0, for now
  const double half = 0.5 * model.dt;
  const FrameStep fixed = fixed_frame_step(model, 0);
  for_free_nodes(model, [&](std::size_t k) {
    const FrameStep& frame = in_fixed_frame(model, k) ? fixed : state.frame;
    const VelocityUpdate update =
        velocity_update(model.scheme, half, model.mass_damping, frame.spin);
    const Vec2 v = state.v[k];
    const Vec2 f = acceleration(model, state, frame, k, state.force_before[k]);
    state.v_next[k] = v + (half * f - update.drag * v) / update.a;
  });
  return state;
}

ContactReport advance(const Model& model, State& state, Ledger& ledger) noexcept {
  const StepTraps traps;
  std::swap(state.v, state.v_next);
  std::swap(state.force, state.force_before);
  state.frame = frame_step(model.motion, ++state.step, model.dt);
  for_free_nodes(model, [&](std::size_t k) { state.u[k] += model.dt * state.v[k]; });
  StepEnergy energy;
  add_energy(model, state, energy);
  apply_stiffness(model, state.u, state.force);
  const VelocityUpdate update =
      velocity_update(model.scheme, model.dt, model.mass_damping, state.frame.spin);
  free_velocities(model, state, update);
  const ContactReport report = model.contact ? contacts(model, state, update) : ContactReport{};
  add_works(model, state, energy.works);
  energy.works.contact = report.work;
  energy.works.dissipation_friction = report.dissipation_friction;
  energy.works.loss_impact = report.loss_impact;
  energy.works.rim = report.work_rim;
  ledger.add(energy);
  return report;
}

}  // namespace rondo::dynamics
