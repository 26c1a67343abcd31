// SPDX-License-Identifier: BSD-3-Clause
/// @file  The law of contact (law.hpp) with two tangential directions, in a contact frame whose x
/// is the normal (docs/wheel3d.md). Iterations turn the direction of sliding, and are exact once it
/// stands still; a residual that does not depend on them judges the impulse that they find.
#pragma once
#include <array>

#include "rondo/contact/law.hpp"
#include "rondo/core/vec3.hpp"

namespace rondo::contact {

/// One contact of one step of a node in space.
struct SpatialProblem {
  Vec3 free;                       ///< relative velocity without this contact's impulse  [m/s]
  std::array<Vec3, 3> delassus{};  ///< rows of W: w = free + W r                         [1/kg]
  double bounce = 0.0;             ///< ε of restitution_shift(): added to w_n in the law [m/s]
};

struct SpatialSolution {
  Vec3 impulse;  ///< impulse of the ground on the node                              [N·s]
  Status status = Status::open;
  int turns = 0;  ///< iterations, each of which turns the direction of sliding
  bool converged = true;
};

/// 0 <= r_n ⊥ w_n + bounce >= 0; |r_t| <= μ r_n, r_t = -μ r_n w_t/|w_t| where w_t ≠ 0.
/// @pre W is positive definite, W_nn > μ |W_nt|.  @post r_n >= 0, |r_t| <= μ r_n (to round-off).
SpatialSolution solve_spatial(const SpatialProblem& problem, double friction) noexcept;

/// r with velocity + W r = 0. @param delassus rows of W
[[nodiscard]] Vec3 stopping_impulse(const std::array<Vec3, 3>& delassus, Vec3 velocity) noexcept;

/// The direction of a tangential vector; (1, 0) where it is zero.
[[nodiscard]] inline Vec2 direction(Vec2 tangential) noexcept {
  const double length = norm(tangential);
  return length > 0.0 ? tangential / length : Vec2{1.0, 0.0};
}

/// Nearest point of the friction cone |(y, z)| <= μ x.
Vec3 project_on_cone(Vec3 r, double friction) noexcept;

/// |r - P_K(r - m ŵ)|, ŵ = w + (bounce + μ|w_t|) n [N·s], as residual.hpp has it in the plane.
double law_residual(Vec3 impulse, Vec3 velocity, double bounce, double friction,
                    double mass) noexcept;

}  // namespace rondo::contact
