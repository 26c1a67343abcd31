// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the sums over the nodes of a step on a loaded rim (kernels::WheelSum, and
/// SolidWheelSum, which are 0 in the plane) say: the force on the rim, and once that has moved, the
/// energies and works of the step (docs/theory.md, 10.5).
#pragma once
#include "rondo/integrators/fused/step_context.hpp"
#include "rondo/model/solid/solid_rim.hpp"

namespace rondo::dynamics {

/// Adds the sums of all parts, in their order.
[[nodiscard]] StepSums wheel_sums(std::span<const PartialStep> parts) noexcept;

[[nodiscard]] RimForceOf<Vec3> rim_force(const StepContext& step, const StepSums& sums) noexcept;

/// @param rim which has taken rim_force()
[[nodiscard]] StepEnergy wheel_energy(const Model& model, const StepContext& step,
                                      const StepSums& sums, const ContactReport& contact,
                                      const SolidRim& rim) noexcept;

/// The way to u_{n+2}.
[[nodiscard]] kernels::WheelWay wheel_way(const Model& model, const SolidRim& rim) noexcept;

}  // namespace rondo::dynamics
