// SPDX-License-Identifier: BSD-3-Clause
/// @file  Unconstrained bodies in large rotation: strains are those in the frame of the body's mean
/// rotation, forces the exact derivative of their energy (docs/theory.md, section 9). Forces and
/// moments thus sum to zero to round-off; linear and angular momentum are conserved.
/// The mean rotation is that of Fraeijs de Veubeke, Int. J. Engng Sci. 14 (1976) 895: it makes
/// Σ m |Rᵀ(x - x_c) - (X - X_c)|² least.
#pragma once
#include <span>

#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Center of mass and mean rotation of a body (9.1), (9.2). @param u (n) x - X of its nodes   [m]
/// @param before the pose one step before, from which whole turns are counted.
Pose mean_pose(const Model& model, const FreeBody& body, std::span<const Vec2> u,
               const Pose& before) noexcept;

/// Updates the poses of all free bodies. @param poses (free_bodies) on entry those one step before
void update_poses(const Model& model, std::span<const Vec2> u, std::span<Pose> poses) noexcept;

/// e of a node (9.3): Rᵀ(x - x_c) - (X - X_c); for a node of a held body, u itself          [m]
/// @param u x - X of the node
Vec2 elastic_displacement(const Model& model, std::span<const Pose> poses, std::size_t node,
                          Vec2 u) noexcept;

/// e of all nodes (n)                                                                     [m]
void elastic_displacements(const Model& model, std::span<const Vec2> u, std::span<const Pose> poses,
                           std::span<Vec2> elastic) noexcept;

/// Derivative of the energy with respect to the nodes' positions, in the frame in which they move
/// (9.5): transforms `product` (n), e.g. K e in the frame of the body, to `gradient` (n). It is a
/// copy at nodes of held bodies, which move in the rotating frame.                        [N/m]
void to_gradient(const Model& model, std::span<const Vec2> elastic, std::span<const Vec2> product,
                 std::span<const Pose> poses, std::span<Vec2> gradient) noexcept;

}  // namespace rondo::dynamics
