// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the velocity terms are taken in the step (docs/theory.md, 3.3 to 3.6).
#pragma once
#include "rondo/core/complex.hpp"

namespace rondo::dynamics {

enum class Scheme {
  symplectic,  ///< at the mean of the two half steps: keeps energy
  as_printed,  ///< at the old half step, as printed by Adam et al. 2017: feeds one family of waves
  hati,        ///< two parts of the body, each with a step of its own (docs/theory.md, section 12)
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

/// The velocity that the terms of velocity are taken at; the works (5.3) are of the mean of both
/// half steps, and what this leaves of the Coriolis term is the work of the scheme.
constexpr Vec2 velocity_of_terms(Scheme scheme, Vec2 before, Vec2 mean) noexcept {
  return scheme == Scheme::as_printed ? before : mean;
}

}  // namespace rondo::dynamics
