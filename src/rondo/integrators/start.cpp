// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/start.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
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
  const Vec2 elastic = state.force.plane()[k] - load + model.stiffness_damping * stiffness_rate;
  const Vec2 arm = model.reference[k] + state.u.plane()[k];
  return -(elastic / model.mass[k]) - frame_acceleration(frame, arm);
}

template <class Vec>
void clear_clamped(const Model& model, std::span<Vec> field) noexcept {
  auto next_free = model.free.begin();
  for (std::size_t k = 0; k < field.size(); ++k) {
    if (next_free != model.free.end() && at(*next_free) == k)
      ++next_free;
    else
      field[k] = Vec{};
  }
}

template <class Vec>
void set_free(const Model& model, std::span<const Vec> values, std::span<Vec> field) noexcept {
  for_free_nodes(model, [&](std::size_t k) { field[k] = values[k]; });
}

/// The start forces of a material of its own: its force, and the rate of it by its own damping.
void find_own_start_forces(const Model& model, State& state) {
  const std::span<const Vec2> u = state.u.plane(), v = state.v.plane();
  std::vector<Vec2> before(u.begin(), u.end());
  for (std::size_t k = 0; k < before.size(); ++k) before[k] -= model.dt * v[k];
  const auto internal = make_internal_force(model, before, state.poses);
  internal->evaluate(u);
  std::ranges::copy(internal->gradient(), state.force.plane().begin());
  if (model.stiffness_damping == 0.0) return;
  internal->damping(state.force_before);
  for (Vec2& rate : state.force_before.plane()) rate = rate / model.stiffness_damping;
}

/// Internal forces at u_0 in `force`, their rate in `force_before`; poses of the free bodies.
void find_start_forces(const Model& model, State& state) {
  update_poses(model, state.u, state.poses);
  if (model.internal_force) return find_own_start_forces(model, state);
  RONDO_DEMAND(model.sector || model.stiffness.row_start.size() == model.n_nodes() + 1,
               model.stiffness.row_start.size(), model.n_nodes());
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
    const Vec2 v = state.v.plane()[k];
    const Vec2 f = acceleration(model, state, frame, k, state.force_before.plane()[k], load[k]);
    state.v_next.plane()[k] = v + (half * f - update.drag * v) / update.a;
  });
}

/// The start of a body on a loaded rim (10.6): v_{1/2} is what the absolute velocities leave.
void start_wheel(const Model& model, std::span<const Vec2> load, State& state) {
  LoadedRim rim(model);
  const Vec2 center_velocity = rim.velocity(), gravity = model.motion.gravity_at(0.0);
  const double spin = rim.spin();
  const std::span<const Vec2> u = state.u.plane(), v = state.v.plane();
  const std::span<const Vec2> elastic = state.force.plane(), rate = state.force_before.plane();
  const auto arm = [&](std::size_t k) { return model.reference[k] + u[k]; };
  const auto force = [&](std::size_t k) {
    return elastic[k] + model.stiffness_damping * rate[k] +
           model.mass_damping * model.mass[k] * v[k];
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
    const Vec2 velocity = center_velocity + v[k] + spin * turn90(arm(k)) +
                          0.5 * model.dt * (gravity - (force(k) - load[k]) / model.mass[k]);
    state.v_next.plane()[k] = rim.travel(arm(k), velocity) / model.dt;
  });
}

/// Forces at u_0 and v_{1/2}.
void start_velocities(const Model& model, State& state) {
  if (model.solid) return start_solid(model, state);
  find_start_forces(model, state);
  std::vector<Vec2> load(model.n_nodes());
  pressure_forces(model, state.u, 0.0, load);
  if (model.rim)
    start_wheel(model, load, state);
  else
    start_body(model, load, state);
}

}  // namespace

State start(const Model& model, Field u0, Field v0, const Field& half) {
  const std::size_t n = model.n_nodes(), c = model.components();
  RONDO_DEMAND(u0.size() == n && v0.size() == n, u0.size(), v0.size());
  RONDO_DEMAND(u0.components() == c && v0.components() == c, u0.components(), v0.components());
  RONDO_DEMAND(half.empty() || (half.size() == n && half.components() == c), half.size());
  RONDO_DEMAND(model.dt > 0.0, model.dt);
  RONDO_DEMAND(model.mass.size() == n, model.mass.size(), n);
  RONDO_ASSERT(has_massless_contact(model) ||
                   std::ranges::all_of(model.free, [&](int k) { return model.mass[at(k)] > 0.0; }),
               model.free.size());
  RONDO_ASSERT(std::ranges::is_sorted(model.free), model.free.size());  // see clear_clamped()
  State state;
  state.u = std::move(u0);
  state.v = std::move(v0);
  for (Field* field : {&state.u, &state.v})
    field->visit([&](auto values) { clear_clamped(model, values); });
  state.v_next = state.force = state.force_before = Field(n, c);
  if (model.contact) state.active.reserve(2 * model.contact->nodes.size());
  state.frame = frame_step(model.motion, 0, model.dt);
  for (const FreeBody& body : model.free_bodies) state.poses.push_back({body.center});
  start_velocities(model, state);
  if (half.empty()) return state;
  if (model.solid)
    set_free(model, half.space(), state.v_next.space());
  else
    set_free(model, half.plane(), state.v_next.plane());
  return state;
}

}  // namespace rondo::dynamics
