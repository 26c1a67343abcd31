// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_start.hpp"

#include <span>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/integrators/solid/solid_forces.hpp"
#include "rondo/model/solid/solid_rim.hpp"

namespace rondo::dynamics {
namespace {

Vec3 arm_of(const Model& model, const State& state, std::size_t k) noexcept {
  return Vec3(model.reference[k], model.solid->axial[k]) + state.u.space()[k];
}

/// The forces at u_0, and β K v_0.
Vec3 elastic_force(const Model& model, const State& state, std::size_t k) noexcept {
  return state.force.space()[k] + model.stiffness_damping * state.force_before.space()[k];
}

/// v_{1/2} by half a step without contact (docs/theory.md, 3.7).
void start_body(const Model& model, std::span<const Vec3> load, State& state) {
  const double half = 0.5 * model.dt, alpha = model.mass_damping;
  const VelocityUpdate update = velocity_update(model.scheme, half, alpha, state.frame.spin);
  for_free_nodes(model, [&](std::size_t k) {
    const Vec3 frame{frame_acceleration(state.frame, arm_of(model, state, k).plane()),
                     state.frame.pull.z};
    const Vec3 force = load[k] - elastic_force(model, state, k);
    const Vec3 push = half * (force / model.mass[k] - frame);
    const Vec3 v = state.v.space()[k];
    state.v_next.space()[k] = {v.plane() + (push.plane() - update.drag * v.plane()) / update.a,
                               v.z + (push.z - half * alpha * v.z) / (1.0 + 0.5 * half * alpha)};
  });
}

/// Does so by absolute velocities, on a loaded rim (10.6).
void start_wheel(const Model& model, std::span<const Vec3> load, State& state) {
  SolidRim rim(model);
  const Vec3 center = rim.velocity();
  const double spin = rim.plane().spin();
  const Vec3 gravity = GroundFrame(model.motion.camber).to_wheel(model.motion.gravity_at(0.0));
  const auto force = [&](std::size_t k) {
    return elastic_force(model, state, k) + model.mass_damping * model.mass[k] * state.v.space()[k];
  };
  RimForceOf<Vec3> sum;
  for_free_nodes(model, [&](std::size_t k) {
    sum.force += force(k);
    sum.moment += cross(arm_of(model, state, k).plane(), force(k).plane());
  });
  sum.moment += rest_moment(rest_forces(model), state.u.space());
  rim.start(sum);
  state.rim = rim.save();
  for_free_nodes(model, [&](std::size_t k) {
    const Vec3 arm = arm_of(model, state, k);
    const Vec3 v = state.v.space()[k];
    const Vec3 velocity = center + Vec3(v.plane() + spin * turn90(arm.plane()), v.z) +
                          0.5 * model.dt * (gravity - (force(k) - load[k]) / model.mass[k]);
    state.v_next.space()[k] = rim.travel(arm, velocity) / model.dt;
  });
}

}  // namespace

void start_solid(const Model& model, State& state) {
  RONDO_DEMAND(model.solid && state.u.size() == model.n_nodes() && state.u.components() == 3 &&
                   state.v_next.size() == model.n_nodes(),
               state.u.size(), state.u.components(), state.v_next.size(), model.n_nodes());
  if (model.solid->swept)
    swept_wheel(model).find(state.u, state.frame.angle, state.force.space());
  else
    fem::apply(model.solid->sector, state.u, state.force);
  fem::apply(model.solid->sector, state.v, state.force_before);
  std::vector<Vec3> load(model.n_nodes());
  solid_pressure_forces(model, 0.0, load);
  if (model.rim)
    start_wheel(model, load, state);
  else
    start_body(model, load, state);
}

}  // namespace rondo::dynamics
