// SPDX-License-Identifier: BSD-3-Clause
/// @file  Bodies in large rotation that nothing holds: strains are those seen from the body's mean
/// rotation, forces the exact derivative of their energy (docs/theory.md, section 9). So forces and
/// their moments add up to zero to round-off: linear and angular momentum are kept.
/// The mean rotation is that of Fraeijs de Veubeke, Int. J. Engng Sci. 14 (1976) 895: it makes
/// Σ m |Rᵀ(x - x_c) - (X - X_c)|² least.
#pragma once
#include <span>

#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Center of mass and mean rotation of a body (9.1), (9.2). @param u (n) x - X of its nodes   [m]
/// @param before the pose of a step ago: whole turns are counted from there.
Pose mean_pose(const Model& model, const FreeBody& body, std::span<const Vec2> u,
               const Pose& before) noexcept;

/// Poses of all free bodies. @param poses (free_bodies) those of a step ago, replaced.
void update_poses(const Model& model, std::span<const Vec2> u, std::span<Pose> poses) noexcept;

/// e of a node (9.3): Rᵀ(x - x_c) - (X - X_c), its own u where it is held                   [m]
/// @param u x - X of the node
Vec2 elastic_displacement(const Model& model, std::span<const Pose> poses, std::size_t node,
                          Vec2 u) noexcept;

/// The same of all nodes (n)                                                              [m]
void elastic_displacements(const Model& model, std::span<const Vec2> u, std::span<const Pose> poses,
                           std::span<Vec2> elastic) noexcept;

/// Derivative of the energy by the nodes' places, in the frame in which they move (9.5): from
/// `product` (n), K e or the like in the frame of the body, to `gradient` (n). The same for nodes
/// that are held in the turning frame.                                                [N/m]
void to_gradient(const Model& model, std::span<const Vec2> elastic, std::span<const Vec2> product,
                 std::span<const Pose> poses, std::span<Vec2> gradient) noexcept;

}  // namespace rondo::dynamics
