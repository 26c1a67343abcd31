// SPDX-License-Identifier: BSD-3-Clause
/// @file  A cell of rubber in doubles: energy, forces and their derivatives, by its law and kind
/// (docs/rubber.md, 1.2 and 1.3). Volumes of triangles are those of the nodes: here comes the
/// pressure that these have.
#pragma once
#include <array>
#include <span>

#include "rondo/core/vec2.hpp"
#include "rondo/fem/element.hpp"
#include "rondo/fem/hyperelastic/branch.hpp"
#include "rondo/fem/rubber.hpp"

namespace rondo::fem::hyperelastic {

/// A cell with its displacements; a triangle has three corners.
struct DeformedCell {
  int n_corners = 4;
  std::array<Vec2, 4> x;  ///< X, counter-clockwise                                    [m]
  std::array<Vec2, 4> u;  ///< [m]
};

/// Derivatives of an energy by the displacements of the corners                        [N/m]
using CornerForces = std::array<Vec2, 4>;

/// At the center.
struct Center {
  Gradient<double> f;     ///< F by columns
  double j_less_1 = 0.0;  ///< det F - 1: of the volume of the cell
  double area = 0.0;      ///< undeformed                                              [m²]
};
[[nodiscard]] Center center_of(const DeformedCell& cell) noexcept;

/// Smallest det F of the points where the law is taken, and of the mean.
[[nodiscard]] double least_volume_ratio(const Rubber& rubber, const DeformedCell& cell) noexcept;

/// Without branches, of a triangle without its volume.
struct CellResult {
  CornerForces forces{};
  double energy = 0.0;  ///< [J/m]
};

/// @param mean pressure of a triangle's nodes, which is in the forces [Pa].
/// @pre least_volume_ratio() > 0
[[nodiscard]] CellResult result_of(const Rubber& rubber, const DeformedCell& cell, double mean);

/// Derivatives of the forces, the pressure of a triangle's nodes and the strain histories held
/// [N/m²]. @param history one a branch, or none: without branches
[[nodiscard]] ElementMatrix tangent_of(const Rubber& rubber, const DeformedCell& cell, double mean,
                                       std::span<const Symmetric<double>> history = {});

/// Derivatives of a triangle's deformed area by its corners                             [m]
[[nodiscard]] CornerForces area_gradient(const DeformedCell& triangle) noexcept;

/// C_i of a branch that has relaxed: C̄.
[[nodiscard]] Symmetric<double> relaxed_history(const Center& center) noexcept;

/// The branches of a cell over half a step with F held: their energy goes down by what is returned
/// [J/m]. @param history one a branch @param half_step [s]
double relax(const Rubber& rubber, const Center& center, double half_step,
             std::span<Symmetric<double>> history) noexcept;

/// Energy of the branches [J/m].
[[nodiscard]] double branch_energy(const Rubber& rubber, const Center& center,
                                   std::span<const Symmetric<double>> history) noexcept;

/// Adds the forces of the branches.
void add_branch_forces(const Rubber& rubber, const DeformedCell& cell,
                       std::span<const Symmetric<double>> history, CornerForces& forces) noexcept;

}  // namespace rondo::fem::hyperelastic
