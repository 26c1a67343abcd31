// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_start.hpp"

#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/integrators/solid/solid_forces.hpp"
#include "rondo/integrators/solid/solid_rim.hpp"

namespace rondo::dynamics {
namespace {

/// (n) 0 on clamped nodes. @param given (n), or empty: 0
std::vector<double> free_only(const Model& model, const std::vector<double>& given) {
  RONDO_DEMAND(given.empty() || given.size() == model.n_nodes(), given.size());
  std::vector<double> field(model.n_nodes());
  if (!given.empty()) for_free_nodes(model, [&](std::size_t k) { field[k] = given[k]; });
  return field;
}

Vec3 arm_of(const Model& model, const State& state, std::size_t k) noexcept {
  return Vec3(model.reference[k], model.solid->axial[k]) + Vec3(state.u[k], state.axial_u[k]);
}

/// K u_0 and β K v_0.
Vec3 elastic_force(const Model& model, const State& state, std::size_t k) noexcept {
  return Vec3(state.force[k], state.axial_force[k]) +
         model.stiffness_damping * Vec3(state.force_before[k], state.axial_force_before[k]);
}

/// v_{1/2} by half a step without contact (docs/theory.md, 3.7).
void start_body(const Model& model, const SolidField& load, State& state) {
  const double half = 0.5 * model.dt, alpha = model.mass_damping;
  const VelocityUpdate update = velocity_update(model.scheme, half, alpha, state.frame.spin);
  for_free_nodes(model, [&](std::size_t k) {
    const Vec3 frame{frame_acceleration(state.frame, arm_of(model, state, k).plane()),
                     state.frame.axial_pull};
    const Vec3 force = load.at(k) - elastic_force(model, state, k);
    const Vec3 push = half * (force / model.mass[k] - frame);
    const Vec2 v = state.v[k];
    const double vz = state.axial_v[k];
    state.v_next[k] = v + (push.plane() - update.drag * v) / update.a;
    state.axial_v_next[k] = vz + (push.z - half * alpha * vz) / (1.0 + 0.5 * half * alpha);
  });
}

/// The same of absolute velocities, on a loaded rim (10.6).
void start_wheel(const Model& model, const SolidField& load, State& state) {
  SolidRim rim(model);
  const Vec3 center = rim.velocity();
  const double spin = rim.plane().spin();
  const Vec3 gravity = GroundAxes(model.motion.camber).to_wheel(model.motion.gravity_at(0.0), 0.0);
  const auto force = [&](std::size_t k) {
    return elastic_force(model, state, k) +
           model.mass_damping * model.mass[k] * Vec3(state.v[k], state.axial_v[k]);
  };
  Vec3 sum;
  double moment = 0.0;
  for_free_nodes(model, [&](std::size_t k) {
    sum += force(k);
    moment += cross(arm_of(model, state, k).plane(), force(k).plane());
  });
  rim.start(sum, moment);
  state.rim = rim.save();
  for_free_nodes(model, [&](std::size_t k) {
    const Vec3 arm = arm_of(model, state, k);
    const Vec3 velocity = center + Vec3(state.v[k] + spin * turn90(arm.plane()), state.axial_v[k]) +
                          0.5 * model.dt * (gravity - (force(k) - load.at(k)) / model.mass[k]);
    const Vec3 next = rim.travel(arm, velocity) / model.dt;
    state.v_next[k] = next.plane();
    state.axial_v_next[k] = next.z;
  });
}

}  // namespace

void start_solid(const Model& model, const AxialStart& axial, State& state) {
  const std::size_t n = model.n_nodes();
  const fem::SolidSector& stiffness = model.solid->sector;
  state.axial_u = free_only(model, axial.u);
  state.axial_v = free_only(model, axial.v);
  state.axial_v_next.resize(n);
  state.axial_force.resize(n);
  state.axial_force_before.resize(n);
  fem::apply(stiffness, state.u, state.axial_u, state.force, state.axial_force);
  fem::apply(stiffness, state.v, state.axial_v, state.force_before, state.axial_force_before);
  SolidField load(n);
  solid_pressure_forces(model, 0.0, load);
  if (model.rim)
    start_wheel(model, load, state);
  else
    start_body(model, load, state);
  if (!axial.half.empty()) state.axial_v_next = free_only(model, axial.half);
}

}  // namespace rondo::dynamics
