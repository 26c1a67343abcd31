// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/step_context.hpp"

namespace rondo::dynamics {

StepContext step_context(const Model& model, long long n) noexcept {
  StepContext s;
  s.frame = frame_step(model.motion, n, model.dt);
  const FrameStep& f = s.frame;
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
             .printed = model.scheme == Scheme::as_printed,
             .unsteady = f.spin_rate != 0.0 || f.pull != Vec2{}};
  if (model.contact) s.contact.emplace(model, f, update);
  return s;
}

void correct_sums(const StepContext& step, const ContactNode& node, Vec2 after, Vec2 force_change,
                  std::array<double, kernels::n_sums>& sums) noexcept {
  const kernels::StepFactors& f = step.factors;
  const Vec2 change = after - node.free;
  const Vec2 frame = Complex{f.rate_x, f.rate_y} * node.arm + Vec2{f.pull_x, f.pull_y};
  const Vec2 other = step.terms.printed ? node.before : after + node.free + 2.0 * node.before;
  sums[kernels::sum_frame] += node.mass * dot(change, frame);
  sums[kernels::sum_mass] += node.mass * dot(change, other);  // a² - b² = (a - b)(a + b)
  sums[kernels::sum_stiffness] += dot(change, force_change);
  if (step.terms.printed) sums[kernels::sum_scheme] += node.mass * dot(change, turn90(node.before));
}

namespace {

using Totals = std::array<double, kernels::n_sums>;

StepEnergy energy_of(const Model& model, const FrameStep& frame, const Totals& total,
                     const ContactReport& contact) noexcept {
  const double dt = model.dt, alpha = model.mass_damping, beta = model.stiffness_damping;
  const bool printed = model.scheme == Scheme::as_printed;
  StepEnergy e;
  e.kinetic = 0.5 * total[kernels::sum_kinetic];
  e.strain = 0.5 * total[kernels::sum_strain];
  e.works.frame = -0.5 * total[kernels::sum_frame];
  e.works.dissipation_mass = (printed ? 0.5 : 0.25) * dt * alpha * total[kernels::sum_mass];
  e.works.dissipation_stiffness = 0.5 * beta * total[kernels::sum_stiffness];
  e.works.scheme = printed ? -dt * frame.spin * total[kernels::sum_scheme] : 0.0;
  e.works.contact = contact.work;
  e.works.dissipation_friction = contact.dissipation_friction;
  e.works.loss_impact = contact.loss_impact;
  e.works.rim = contact.work_rim;
  return e;
}

}  // namespace

WholeStep whole_step(const Model& model, const FrameStep& frame,
                     std::span<const PartialStep> parts) noexcept {
  std::array<CompensatedSum, kernels::n_sums> sums;
  WholeStep whole;
  for (const PartialStep& part : parts) {
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k].add(part.sums[k]);
    if (model.contact) whole.contact.add(part.contact);
  }
  Totals total{};
  for (std::size_t k = 0; k < sums.size(); ++k) total[k] = sums[k].value();
  whole.energy = energy_of(model, frame, total, whole.contact);
  return whole;
}

}  // namespace rondo::dynamics
