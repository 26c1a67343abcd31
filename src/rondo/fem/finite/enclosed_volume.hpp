// SPDX-License-Identifier: BSD-3-Clause
/// @file  The volume that faces enclose, for a pressure that follows them: its energy is -p V, its
/// forces and stiffness are derivatives of V and therefore symmetric.
#pragma once
#include <array>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/finite/cord_face.hpp"
#include "rondo/fem/finite/energy.hpp"

namespace rondo::fem::finite {

/// The cone from the origin under a face: ⅓ ∫ x · (∂x/∂ξ × ∂x/∂η) [m³]; positive where
/// ∂x/∂ξ × ∂x/∂η points away from the origin. Inside a closed surface, and at nodes around which
/// all faces of a surface are there, its gradient is the exact force of a unit pressure.
[[nodiscard]] Energy<4> cone_volume(const std::array<Vec3, 4>& x) noexcept;

/// Volume and gradient of the cone alone, in m³ and m², for steps in time.
[[nodiscard]] FaceForce cone_force(const std::array<Vec3, 4>& x) noexcept;

/// The part of a flat cap between an edge around the wheel and the axle: the volume of the cone
/// from the origin under the triangle whose third corner is on the axle at the height of the edge.
/// @param here, next ends of the edge, in the sense of growing angles
/// @param outward 1: the cap looks along +z, -1: along -z
[[nodiscard]] Energy<2> cap_volume(Vec3 here, Vec3 next, double outward) noexcept;

}  // namespace rondo::fem::finite
