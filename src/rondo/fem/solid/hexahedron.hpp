// SPDX-License-Identifier: BSD-3-Clause
/// @file  Trilinear hexahedra with 2×2×2 points, fully integrated or B-bar (docs/wheel3d.md).
#pragma once
#include <Eigen/Core>
#include <array>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/elasticity.hpp"

namespace rondo::fem {

using HexahedronCorners = std::array<Vec3, 8>;  ///< in the order of mesh::Hexahedron [m]

/// ∫ Bᵀ D B; with B-bar, D is deviatoric, and κ times the squared mean volumetric strain is added
/// (Hughes 1980). Component c of corner i is number 3i + c. Bitwise symmetric [N/m].
Eigen::Matrix<double, 24, 24> hexahedron_stiffness(const HexahedronCorners& x,
                                                   const Material& material);

/// Share of each corner in the volume, for lumped masses: proportional to det(∂x/∂ξ) there, as in
/// the plane (docs/theory.md, 2.5); their sum is the volume of the element [m³]. @pre not inverted
std::array<double, 8> hexahedron_volumes(const HexahedronCorners& x) noexcept;

/// Smallest det(∂x/∂ξ) over the corners [m³]: positive for an element that is not inverted.
double smallest_jacobian(const HexahedronCorners& x) noexcept;

/// σ at the corners, extrapolated from the points; exact for a linear displacement. With B-bar the
/// pressure comes from the element's mean volumetric strain. Components xx, yy, zz, xy, yz, zx
/// [Pa].
using SolidStress = std::array<double, 6>;
std::array<SolidStress, 8> hexahedron_stress(const HexahedronCorners& x, const HexahedronCorners& u,
                                             const Material& material) noexcept;

using PointNumbers = std::array<double, 8>;  ///< one for each of the 2×2×2 points

/// The geometry of an element at its points; turned about the axle, it is valid in all sectors.
struct HexahedronPoints {
  std::array<std::array<PointNumbers, 3>, 8> gradient;  ///< ∇N of each corner [1/m]
  PointNumbers volume;                                  ///< [m³]
};
HexahedronPoints hexahedron_points(const HexahedronCorners& x) noexcept;

/// The stress of hexahedron_stress above, from precomputed points.
std::array<SolidStress, 8> hexahedron_stress(const HexahedronPoints& points,
                                             const HexahedronCorners& u,
                                             const Material& material) noexcept;

/// Upper bound of the eigenvalues of M_e⁻¹ K_e with lumped M_e [1/s²].
double hexahedron_eigenvalue_bound(const HexahedronCorners& x, const Material& material);

}  // namespace rondo::fem
