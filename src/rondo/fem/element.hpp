// SPDX-License-Identifier: BSD-3-Clause
/// @file  Plane elements: 4-node quadrilateral (2×2 Gauss) and 3-node triangle (one point);
/// docs/theory.md, sections 2.2, 2.3, 2.5, 2.6 and 2.8.
#pragma once
#include <Eigen/Core>
#include <array>
#include <span>

#include "rondo/core/vec2.hpp"
#include "rondo/fem/elasticity.hpp"

namespace rondo::fem {

/// Up to four corners: 8×8 at most, no heap. Degrees of freedom of corner a: 2a (x), 2a+1 (y).
using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;
/// Stress at a corner: xx, yy, zz, xy [Pa].
using Stress = std::array<double, 4>;

/// ∫ Bᵀ D B (2.3), (2.3a), per unit thickness [N/m²]. @pre 3 or 4 corners, counter-clockwise,
/// convex.
ElementMatrix element_stiffness(std::span<const Vec2> corners, const ElementLaw& law);

/// Geometric stiffness (2.8) for the stress of a displacement, with the same quadrature [N/m²].
/// `u`: one displacement per corner [m]. @param mean_stress added to xx, yy, zz [Pa]
ElementMatrix element_geometric_stiffness(std::span<const Vec2> corners, std::span<const Vec2> u,
                                          const ElementLaw& law, double mean_stress = 0.0);

/// Lumped masses (2.5) [kg/m]: quadrature at the corners, ρ det(∂x/∂ξ); a triangle gives each of
/// its corners a third. Entries beyond the corners are 0.
std::array<double, 4> element_masses(std::span<const Vec2> corners, double density);

/// Stress at the corners: Gauss-point stress extrapolated bilinearly (quadrilateral), constant
/// (triangle); exact for a linear displacement. With B-bar the pressure of the mean volumetric
/// strain is that of the element. `u`: one displacement per corner [m].
std::array<Stress, 4> element_stress(std::span<const Vec2> corners, std::span<const Vec2> u,
                                     const ElementLaw& law);

/// Stress at the corners of a quadrilateral from the stress at its 2×2 points, in the order (-, -),
/// (+, -), (+, +), (-, +): the bilinear field through them (2.6).
std::array<Stress, 4> extrapolated(const std::array<Stress, 4>& at_gauss) noexcept;

/// Smallest det(∂x/∂ξ) over the corners [m²]: positive if the element is not inverted
/// (quadrilateral: a quarter of a parallelogram's area; triangle: twice its area).
double smallest_jacobian(std::span<const Vec2> corners) noexcept;

}  // namespace rondo::fem
