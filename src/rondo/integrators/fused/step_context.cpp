// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/step_context.hpp"

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {
namespace {

/// Adds what is different in three dimensions.
void add_axial(const Model& model, const FrameStep& f, const VelocityUpdate& update,
               StepContext& s) noexcept {
  const double dt = model.dt, axial_a = 1.0 + 0.5 * dt * model.mass_damping;
  s.axial = {.pull = dt * f.pull.z, .inverse = 1.0 / axial_a, .drag = dt * model.mass_damping};
  s.terms.unsteady = s.terms.unsteady || f.pull.z != 0.0;
  if (model.contact) s.solid_contact.emplace(model, f, update, axial_a);
}

}  // namespace

StepContext step_context(const Model& model, const FrameStep& f) noexcept {
  RONDO_ASSERT(model.dt > 0.0 && !model.rim, model.dt, model.rim.has_value());
  StepContext s;
  s.frame = f;
  const double dt = model.dt;
  const VelocityUpdate update = velocity_update(model.scheme, dt, model.mass_damping, f.spin);
  const Complex inverse = Complex{1.0, 0.0} / update.a;
  s.factors = {.dt = dt,
               .rate_x = -dt * f.spin * f.spin,
               .rate_y = dt * f.spin_rate,
               .pull_x = dt * f.pull.x,
               .pull_y = dt * f.pull.y,
               .inverse_x = inverse.re,
               .inverse_y = inverse.im,
               .drag_x = update.drag.re,
               .drag_y = update.drag.im,
               .beta_over_dt = model.stiffness_damping / dt};
  s.terms = {.stiffness_damping = model.stiffness_damping > 0.0,
             .unsteady = f.spin_rate != 0.0 || f.pull.plane() != Vec2{}};
  if (model.solid)
    add_axial(model, f, update, s);
  else if (model.contact)
    s.contact.emplace(model, f, update);
  return s;
}

void correct_sums(const StepContext& step, const ContactNode& node, Vec2 after,
                  const NodeForces& forces, StepSums& sums) noexcept {
  const kernels::StepFactors& f = step.factors;
  const Vec2 change = after - node.free;
  const Vec2 frame = Complex{f.rate_x, f.rate_y} * node.arm + Vec2{f.pull_x, f.pull_y};
  const Vec2 other = after + node.free + 2.0 * node.before;
  sums[kernels::sum_frame] += node.mass * dot(change, frame);
  sums[kernels::sum_mass] += node.mass * dot(change, other);  // a² - b² = (a - b)(a + b)
  sums[kernels::sum_stiffness] += dot(change, forces.change);
  sums[kernels::sum_load] += dot(change, forces.load);
  sums[kernels::sum_mean_force] += dot(change, forces.internal);
}

StepContext wheel_context(const Model& model, const FrameStep& f, Complex back,
                          Vec3 gravity) noexcept {
  RONDO_ASSERT(model.dt > 0.0 && model.rim, model.dt, model.rim.has_value());
  StepContext s;
  s.frame = f;
  const double dt = model.dt;
  const Vec3 pull = dt * gravity;
  s.wheel = {.back_x = back.re,
             .back_y = back.im,
             .pull_x = pull.x,
             .pull_y = pull.y,
             .pull_z = pull.z,
             .alpha_over_dt = model.mass_damping / dt,
             .beta_over_dt = model.stiffness_damping / dt};
  s.heavy = gravity != Vec3{};
  if (model.contact && model.solid)
    s.solid_contact.emplace(model, f);
  else if (model.contact)
    s.contact.emplace(model, f);
  return s;
}

void correct_wheel_sums(const ContactNode& node, Vec2 after, const NodeForces& forces,
                        StepSums& sums) noexcept {
  const Vec2 change = after - node.free;
  sums[kernels::wheel_force_after] += dot(forces.elastic, change);
  sums[kernels::wheel_force_across] += cross(forces.elastic, change);
  sums[kernels::wheel_mass_mean] += node.mass * dot(forces.moved, change);
  sums[kernels::wheel_change_mean] += dot(forces.change, change);
  sums[kernels::wheel_momentum_x] += node.mass * change.x;
  sums[kernels::wheel_momentum_y] += node.mass * change.y;
}

void correct_sums(const StepContext& step, Complex axes, const SolidContactNode& node, Vec3 after,
                  const NodeForcesOf<Vec3>& forces, StepSums& sums) noexcept {
  const kernels::StepFactors& f = step.factors;
  const Vec2 pull = conj(axes) * Vec2{f.pull_x, f.pull_y};
  const Vec3 acceleration(Complex{f.rate_x, f.rate_y} * node.arm.plane() + pull, step.axial.pull);
  const Vec3 change = after - node.free;
  sums[kernels::sum_frame] += node.mass * dot(change, acceleration);
  sums[kernels::sum_mass] += node.mass * dot(change, after + node.free + 2.0 * node.before);
  sums[kernels::sum_stiffness] += dot(change, forces.change);
  sums[kernels::sum_mean_force] += dot(change, forces.internal);
  sums[kernels::sum_load] += dot(change, forces.load);
}

void correct_wheel_sums(Complex axes, const SolidContactNode& node, Vec3 after,
                        const NodeForcesOf<Vec3>& forces, StepSums& sums) noexcept {
  const Vec3 change = after - node.free;
  const Vec3 momentum = node.mass * (axes * change);
  sums[kernels::wheel_force_after] += dot(forces.elastic.plane(), change.plane());
  sums[kernels::wheel_force_across] += cross(forces.elastic.plane(), change.plane());
  sums[kernels::wheel_mass_mean] += node.mass * dot(forces.moved, change);
  sums[kernels::wheel_change_mean] += dot(forces.change, change);
  sums[kernels::wheel_momentum_x] += momentum.x;
  sums[kernels::wheel_momentum_y] += momentum.y;
  sums[kernels::wheel_momentum_z] += momentum.z;
  sums[kernels::wheel_load] += dot(change, forces.load);
}

namespace {

StepSums add_up(std::span<const PartialStep> parts) noexcept {
  static_assert(int{kernels::n_sums} <= int{kernels::n_solid_rubber_sums} &&
                int{kernels::n_solid_rubber_sums} <= kernels::most_sums);
  std::array<CompensatedSum, kernels::n_solid_rubber_sums> sums;  // what is not set is 0
  for (const PartialStep& part : parts)
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k].add(part.sums[k]);
  StepSums total{};
  for (std::size_t k = 0; k < sums.size(); ++k) total[k] = sums[k].value();
  return total;
}

StepEnergy energy_of(const Model& model, const StepSums& total,
                     const ContactReport& contact) noexcept {
  const double dt = model.dt, alpha = model.mass_damping, beta = model.stiffness_damping;
  StepEnergy e;
  e.kinetic = 0.5 * total[kernels::sum_kinetic];
  e.strain = 0.5 * total[kernels::sum_strain];
  e.works.frame = -0.5 * total[kernels::sum_frame];
  e.works.dissipation_mass = 0.25 * dt * alpha * total[kernels::sum_mass];
  e.works.dissipation_stiffness = 0.5 * beta * total[kernels::sum_stiffness];
  e.works.load = 0.5 * dt * total[kernels::sum_load];
  set_contact_works(contact, e.works);
  return e;
}

}  // namespace

WholeStep whole_step(const Model& model, std::span<const PartialStep> parts) noexcept {
  WholeStep whole;
  if (model.contact)
    for (const PartialStep& part : parts) whole.contact.add(part.contact);
  whole.sums = add_up(parts);
  whole.energy = energy_of(model, whole.sums, whole.contact);
  return whole;
}

}  // namespace rondo::dynamics
