// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/wheel_sums.hpp"

namespace rondo::dynamics {
namespace {

using namespace kernels;

Vec3 vector_of(const StepSums& s, WheelSum x, SolidWheelSum z) noexcept {
  static_assert(wheel_force_y == wheel_force_x + 1 && wheel_change_y == wheel_change_x + 1 &&
                wheel_mass_y == wheel_mass_x + 1 && wheel_momentum_y == wheel_momentum_x + 1);
  return {s[x], s[static_cast<std::size_t>(x) + 1], s[z]};
}

/// A field of forces on the nodes, by its sums.
struct Summed {
  Vec3 force;           ///< Σ f
  double moment, mean;  ///< Σ y × f, Σ f·(a⁻ + a⁺)
};

double twice_mean_spin(const SolidRim& rim) noexcept {
  return rim.plane().spin() + rim.plane().spin_before();
}

/// ½ Σ f·D, D the increment of a node's place as the rim sees it, less what its rotation makes of
/// it: D = Δt [a⁺ + a⁻ - Rᵀ(ċ⁺ + ċ⁻) - i (s⁺ + s⁻) y].
double half_work(const Summed& f, const SolidRim& rim, double dt) noexcept {
  const Vec3 hub = conj(rim.frame().rotation) * (rim.velocity() + rim.velocity_before());
  return 0.5 * dt * (f.mean - dot(hub, f.force) - twice_mean_spin(rim) * f.moment);
}

/// -½ Σ p·(D - Δt(v⁺ + v⁻)), of a, d and y alone; along the axle nothing turns.
double work_of_scheme(const StepSums& s, const SolidRim& rim, double dt) noexcept {
  const Complex after = rim.plane().turn(), before = rim.plane().turn_before();
  const Vec2 p = {s[wheel_force_x], s[wheel_force_y]};
  const Vec2 hub = (conj(rim.frame().rotation) * rim.velocity()).plane();
  const Vec2 on =
      Vec2{s[wheel_force_after], s[wheel_force_across]} - Vec2{dot(p, hub), cross(p, hub)};
  const Vec2 back = {s[wheel_force_moved], s[wheel_force_turned]};
  const double excess = -(after.re + before.re) * s[wheel_force_arm] - dt * (conj(after) * on).x +
                        (conj(before) * back).x;
  return -0.5 * excess;
}

}  // namespace

StepSums wheel_sums(std::span<const PartialStep> parts) noexcept {
  StepSums sums{};
  for (const PartialStep& part : parts)
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += part.sums[k];
  return sums;
}

RimForceOf<Vec3> rim_force(const StepContext& step, const StepSums& s) noexcept {
  const double alpha = step.wheel.alpha_over_dt, beta = step.wheel.beta_over_dt;
  const double moment =
      s[wheel_force_moment] + beta * s[wheel_change_moment] + alpha * s[wheel_mass_moment];
  return {vector_of(s, wheel_force_x, wheel_force_z) +
              beta * vector_of(s, wheel_change_x, wheel_change_z) +
              alpha * vector_of(s, wheel_mass_x, wheel_mass_z),
          moment - s[wheel_rest]};
}

StepEnergy wheel_energy(const Model& model, const StepContext& step, const StepSums& s,
                        const ContactReport& contact, const SolidRim& rim) noexcept {
  const double dt = model.dt;
  const Vec3 pull = {step.wheel.pull_x, step.wheel.pull_y, step.wheel.pull_z};
  StepEnergy e = rim.energy();
  e.kinetic = 0.5 * s[wheel_kinetic];
  e.strain = 0.5 * s[wheel_strain];
  const Summed mass{vector_of(s, wheel_mass_x, wheel_mass_z), s[wheel_mass_moment],
                    s[wheel_mass_mean]};
  const Summed change{vector_of(s, wheel_change_x, wheel_change_z), s[wheel_change_moment],
                      s[wheel_change_mean]};
  e.works.dissipation_mass = step.wheel.alpha_over_dt * half_work(mass, rim, dt);
  e.works.dissipation_stiffness = step.wheel.beta_over_dt * half_work(change, rim, dt);
  e.works.scheme = work_of_scheme(s, rim, dt);
  e.works.load += 0.5 * dt * (s[wheel_load] - twice_mean_spin(rim) * s[wheel_rest]);
  if (step.heavy)
    e.works.gravity += 0.5 * dot(pull, vector_of(s, wheel_momentum_x, wheel_momentum_z));
  add_contact_works(contact, e.works);
  return e;
}

kernels::WheelWay wheel_way(const Model& model, const SolidRim& rim) noexcept {
  const Complex turn = conj(rim.plane().turn());
  const Vec3 hub = conj(rim.frame().rotation) * rim.velocity();
  return {.turn_x = turn.re,
          .turn_y = turn.im,
          .way_x = model.dt * (1.0 + turn.re),
          .way_y = model.dt * turn.im,
          .hub_x = hub.x,
          .hub_y = hub.y,
          .hub_z = hub.z,
          .dt = model.dt};
}

}  // namespace rondo::dynamics
