// SPDX-License-Identifier: BSD-3-Clause
/// @file  Measures of the deformation of a wheel in three dimensions, element by element.
#pragma once
#include <span>

#include "rondo/fem/strain.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

/// Equivalent of deformation() in the plane: principal strains at the centers, J at the corners;
/// `strain_cell` and `jacobian_cell` are numbers of hexahedra.
/// @param u (n) finite, turning frame [m]. @pre there is a hexahedron
[[nodiscard]] Deformation solid_deformation(const mesh::Mesh& mesh,
                                            std::span<const Vec3> u) noexcept;

}  // namespace rondo::fem
