// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/start.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/fem/stiffness_product.hpp"
#include "rondo/integrators/general/body_frames.hpp"
#include "rondo/integrators/solid/solid_start.hpp"
#include "rondo/model/corotated.hpp"
#include "rondo/model/internal_force.hpp"
#include "rondo/model/loaded_rim.hpp"
#include "rondo/model/pressure.hpp"

namespace rondo::dynamics {
namespace {

/// f/m at t_0 (3.2).
Vec2 acceleration(const Model& model, const State& state, const FrameStep& frame, std::size_t k,
                  Vec2 stiffness_rate, Vec2 load) noexcept {
  const Vec2 elastic = state.force[k] - load + model.stiffness_damping * stiffness_rate;
  return -(elastic / model.mass[k]) - frame_acceleration(frame, model.reference[k] + state.u[k]);
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

/// The same of a material of its own: its force, and the rate of it by its own damping.
void find_own_start_forces(const Model& model, State& state) {
  std::vector<Vec2> before(state.u);
  for (std::size_t k = 0; k < before.size(); ++k) before[k] -= model.dt * state.v[k];
  const auto internal = make_internal_force(model, before, state.poses);
  internal->evaluate(state.u);
  std::copy(internal->gradient().begin(), internal->gradient().end(), state.force.begin());
  if (model.stiffness_damping == 0.0) return;
  internal->damping(state.force_before);
  for (Vec2& rate : state.force_before) rate = rate / model.stiffness_damping;
}

/// Internal forces at u_0 in `force`, their rate in `force_before`; poses of the free bodies.
void find_start_forces(const Model& model, State& state) {
  update_poses(model, state.u, state.poses);
  if (model.internal_force) return find_own_start_forces(model, state);
  std::vector<Vec2> elastic(model.n_nodes()), product(model.n_nodes());
  elastic_displacements(model, state.u, state.poses, elastic);
  apply_stiffness(model, elastic, product);
  to_gradient(model, elastic, product, state.poses, state.force);
  apply_stiffness(model, state.v, state.force_before);
}

/// v_{1/2} by half a step without contact (3.7).
void start_body(const Model& model, std::span<const Vec2> load, State& state) {
  const double half = 0.5 * model.dt;
  const FrameStep fixed = fixed_frame_step(model, 0);
  for_free_nodes(model, [&](std::size_t k) {
    if (model.mass[k] == 0.0) return;  // the integrator's ring finds it
    const FrameStep& frame = in_fixed_frame(model, k) ? fixed : state.frame;
    const VelocityUpdate update =
        velocity_update(model.scheme, half, model.mass_damping, frame.spin);
    const Vec2 v = state.v[k];
    const Vec2 f = acceleration(model, state, frame, k, state.force_before[k], load[k]);
    state.v_next[k] = v + (half * f - update.drag * v) / update.a;
  });
}

/// The same of a body on a loaded rim (10.6): v_{1/2} is what the absolute velocities leave.
void start_wheel(const Model& model, std::span<const Vec2> load, State& state) {
  LoadedRim rim(model);
  const Vec2 center_velocity = rim.velocity(), gravity = model.motion.gravity_at(0.0);
  const double spin = rim.spin();
  const auto arm = [&](std::size_t k) { return model.reference[k] + state.u[k]; };
  const auto force = [&](std::size_t k) {
    return state.force[k] + model.stiffness_damping * state.force_before[k] +
           model.mass_damping * model.mass[k] * state.v[k];
  };
  RimForce sum;
  for_free_nodes(model, [&](std::size_t k) {
    sum.force += force(k);
    sum.moment += cross(arm(k), force(k));
  });
  const RimForce pressed = pressure_on_rim(model, load);
  rim.start({sum.force + pressed.force, sum.moment + pressed.moment});
  state.rim = rim.save();
  for_free_nodes(model, [&](std::size_t k) {
    const Vec2 velocity = center_velocity + state.v[k] + spin * turn90(arm(k)) +
                          0.5 * model.dt * (gravity - (force(k) - load[k]) / model.mass[k]);
    state.v_next[k] = travel_on_rim(rim, model.dt, arm(k), velocity) / model.dt;
  });
}

/// Forces at u_0 and v_{1/2}.
void start_velocities(const Model& model, const AxialStart& axial, State& state) {
  if (model.solid) return start_solid(model, axial, state);
  find_start_forces(model, state);
  std::vector<Vec2> load(model.n_nodes());
  pressure_forces(model, state.u, 0.0, load);
  if (model.rim)
    start_wheel(model, load, state);
  else
    start_body(model, load, state);
}

}  // namespace

State start(const Model& model, std::vector<Vec2> u0, std::vector<Vec2> v0, std::vector<Vec2> half,
            const AxialStart& axial) {
  RONDO_DEMAND(axial.u.empty() || model.solid, axial.u.size());
  RONDO_DEMAND(u0.size() == model.n_nodes() && v0.size() == model.n_nodes(), u0.size(), v0.size());
  RONDO_DEMAND(half.empty() || half.size() == model.n_nodes(), half.size());
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
  start_velocities(model, axial, state);
  if (!half.empty()) for_free_nodes(model, [&](std::size_t k) { state.v_next[k] = half[k]; });
  return state;
}

}  // namespace rondo::dynamics
