// SPDX-License-Identifier: BSD-3-Clause
/// @file  Treatment of the velocity terms in the time step (docs/theory.md, 3.3 to 3.6).
#pragma once
#include "rondo/core/complex.hpp"

namespace rondo::dynamics {

enum class Scheme {
  symplectic,  ///< at the mean of the two half steps: conserves energy
  as_printed,  ///< at the old half step, as in Adam et al. 2017: one family of waves grows
  hati,        ///< two parts of the body, each with its own step (docs/theory.md, section 12)
};

/// The velocity update of a node, v⁺ = v⁻ + [F - drag v⁻] / a, with F = (Δt f + i_c)/m.
struct VelocityUpdate {
  Complex a;     ///< symplectic: 1 + Δt α/2 + iΔt s   (3.5); as printed: 1            (3.6)
  Complex drag;  ///< symplectic: 2 (a - 1);                  as printed: Δt (α + 2is)
};

constexpr VelocityUpdate velocity_update(Scheme scheme, double dt, double alpha,
                                         double spin) noexcept {
  if (scheme == Scheme::as_printed) return {{1.0, 0.0}, {dt * alpha, 2.0 * dt * spin}};
  return {{1.0 + 0.5 * dt * alpha, dt * spin}, {dt * alpha, 2.0 * dt * spin}};
}

/// The velocity at which the velocity terms are evaluated. The works (5.3) use the mean of both
/// half steps; the difference in the Coriolis term is the work of the scheme.
constexpr Vec2 velocity_of_terms(Scheme scheme, Vec2 before, Vec2 mean) noexcept {
  return scheme == Scheme::as_printed ? before : mean;
}

}  // namespace rondo::dynamics
