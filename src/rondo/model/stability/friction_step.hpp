// SPDX-License-Identifier: BSD-3-Clause
/// @file  How steeply friction may rise with the slip, where its coefficient is that by the slip of
/// the step before (docs/theory.md, 4.3e).
#pragma once

namespace rondo::dynamics {

/// What the elements of a body leave for friction in a step.
struct ElementLimit {
  double omega = 0.0;              ///< ω_m, at least the largest frequency             [rad/s]
  double stiffness_damping = 0.0;  ///< β                                               [s]
  double mass_damping = 0.0;       ///< α, if it acts at the old half step            [1/s]
};

/// Bound of κ = (∂μ/∂|w_t|) r_n/m of a contact node of mass m, with its normal impulse r_n in the
/// step: below it, slips and coefficients do not alternate. It is 2 where the step is small, and 0
/// at the critical step.                                                                   [-]
[[nodiscard]] double friction_limit(const ElementLimit& elements, double dt) noexcept;

/// The step at which κ is the limit.                                                        [s]
/// @param rate κ over the step, >= 0                                                      [1/s]
[[nodiscard]] double friction_step(const ElementLimit& elements, double rate) noexcept;

}  // namespace rondo::dynamics
