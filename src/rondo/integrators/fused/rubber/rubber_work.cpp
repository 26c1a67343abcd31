// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/rubber/rubber_work.hpp"

#include "rondo/core/contract.hpp"
#include "rondo/model/internal_force.hpp"
#include "rondo/model/solid/swept_part.hpp"

namespace rondo::dynamics {

/// U(u_0), and without a loaded rim ½Δt f_0·v_{1/2} more: where the first half step ends.
RubberWork::RubberWork(const Model& model, const State& start) : model_(model) {
  RONDO_DEMAND(start.force.size() == model.n_nodes() && start.v_next.size() == model.n_nodes(),
               start.force.size(), start.v_next.size(), model.n_nodes());
  if (model.solid)
    begin<Vec3>(stored_energy(model, start.u, start.frame.angle), start);
  else
    begin<Vec2>(make_internal_force(model, start.u, start.poses)->material().stored_energy, start);
}

template <class Vec>
void RubberWork::begin(double stored, const State& start) {
  const std::span<const Vec> force = start.force, v = start.v_next;
  work_.add(stored);
  if (model_.rim) return;
  for_free_nodes(model_, [&](std::size_t k) { work_.add(0.5 * model_.dt * dot(force[k], v[k])); });
}

/// @param linear u·K u of the linear elements [J/m]
MaterialReport RubberWork::report(const RubberEnergy& energy, double linear, double work) noexcept {
  dissipation_.add(energy.dissipation_before);
  const MaterialReport found{.internal_work = work,
                             .stored_energy = energy.stored + 0.5 * linear,
                             .window_work = window_.value(),
                             .dissipation_viscous = dissipation_.value(),
                             .least_volume = energy.least};
  dissipation_.add(energy.dissipation_after);
  return found;
}

MaterialReport RubberWork::add(const RubberEnergy& energy, WholeStep& step) noexcept {
  const double half = 0.5 * model_.dt;
  step.energy.strain = work_.value();
  const double work = work_.value() + half * step.sums[kernels::sum_force_before];
  work_.add(half * step.sums[kernels::sum_mean_force]);
  if (model_.solid) window_.add(0.5 * step.sums[kernels::sum_window]);
  return report(energy, step.sums[kernels::sum_linear], work);
}

MaterialReport RubberWork::add(const RubberEnergy& energy, const StepSums& sums,
                               StepEnergy& step) noexcept {
  step.strain = work_.value() + 0.5 * sums[kernels::wheel_strain];
  work_.add(0.5 * (sums[kernels::wheel_strain] + sums[kernels::wheel_force_moved] +
                   sums[kernels::wheel_force_moved_z]));
  window_.add(0.5 * sums[kernels::wheel_window]);
  return report(energy, sums[kernels::wheel_linear], work_.value());
}

std::vector<double> RubberWork::save() const {
  return {work_.sum(), work_.correction(), dissipation_.sum(), dissipation_.correction()};
}

void RubberWork::save_window(std::span<double> numbers) const noexcept {
  numbers[0] = window_.sum();
  numbers[1] = window_.correction();
}

void RubberWork::restore_window(std::span<const double> numbers) noexcept {
  window_ = CompensatedSum(numbers[0], numbers[1]);
}

void RubberWork::restore(std::span<const double> numbers) {
  RONDO_DEMAND(numbers.size() == 4, numbers.size());
  work_ = CompensatedSum(numbers[0], numbers[1]);
  dissipation_ = CompensatedSum(numbers[2], numbers[3]);
}

}  // namespace rondo::dynamics
