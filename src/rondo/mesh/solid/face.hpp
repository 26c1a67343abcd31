// SPDX-License-Identifier: BSD-3-Clause
/// @file  Bilinear faces of hexahedra.
#pragma once
#include <array>

#include "rondo/core/vec3.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

inline Vec3 place_of(const Mesh& mesh, int node) noexcept {
  const auto i = static_cast<std::size_t>(node);
  return {mesh.coordinates[i], mesh.axial[i]};
}

inline std::array<Vec3, 4> face_corners(const Mesh& mesh, const Face& face) noexcept {
  return {place_of(mesh, face[0]), place_of(mesh, face[1]), place_of(mesh, face[2]),
          place_of(mesh, face[3])};
}

/// ∫ N_i n dA with the outward normal n: the share of each corner in the area vector [m²].
std::array<Vec3, 4> face_shares(const std::array<Vec3, 4>& x) noexcept;

}  // namespace rondo::mesh
