// SPDX-License-Identifier: BSD-3-Clause
/// @file  A cell of rubber in doubles: its energy, forces and their derivatives, depending on its
/// law and type (docs/rubber.md, 1.2 and 1.3). The volumes of triangles belong to the nodes; the
/// pressure of the nodes is passed to these functions.
#pragma once
#include <array>
#include <span>

#include "rondo/core/vec2.hpp"
#include "rondo/fem/element.hpp"
#include "rondo/fem/hyperelastic/branch.hpp"
#include "rondo/fem/rubber.hpp"

namespace rondo::fem::hyperelastic {

/// A cell and its displacements; a triangle has three corners.
struct DeformedCell {
  int n_corners = 4;
  std::array<Vec2, 4> x;  ///< X, counter-clockwise                                    [m]
  std::array<Vec2, 4> u;  ///< [m]
};

/// Derivatives of an energy with respect to the displacements of the corners             [N/m]
using CornerForces = std::array<Vec2, 4>;

/// Deformation at the center of a cell.
struct Center {
  Gradient<double> f;     ///< F by columns
  double j_less_1 = 0.0;  ///< det F - 1: that of the volume of the cell
  double area = 0.0;      ///< undeformed                                              [m²]
};
[[nodiscard]] Center center_of(const DeformedCell& cell) noexcept;

/// Smallest det F over the points where the law is evaluated, and of the mean.
[[nodiscard]] double least_volume_ratio(const Rubber& rubber, const DeformedCell& cell) noexcept;

/// Result without branches; for a triangle also without its volume.
struct CellResult {
  CornerForces forces{};
  double energy = 0.0;  ///< [J/m]
};

/// @param mean pressure of a triangle's nodes, included in the forces [Pa].
/// @pre least_volume_ratio() > 0
[[nodiscard]] CellResult result_of(const Rubber& rubber, const DeformedCell& cell, double mean);

/// Derivatives of the forces with the pressure of a triangle's nodes and the strain histories held
/// constant [N/m²]. @param history one per branch; empty: without branches
[[nodiscard]] ElementMatrix tangent_of(const Rubber& rubber, const DeformedCell& cell, double mean,
                                       std::span<const Symmetric<double>> history = {});

/// Derivatives of a triangle's deformed area with respect to its corners                 [m]
[[nodiscard]] CornerForces area_gradient(const DeformedCell& triangle) noexcept;

/// C_i of a branch that is fully relaxed: C̄.
[[nodiscard]] Symmetric<double> relaxed_history(const Center& center) noexcept;

/// Relaxes the branches of a cell over half a step with F constant and returns their loss of energy
/// [J/m]. @param history one per branch @param half_step [s]
double relax(const Rubber& rubber, const Center& center, double half_step,
             std::span<Symmetric<double>> history) noexcept;

/// Energy of the branches [J/m].
[[nodiscard]] double branch_energy(const Rubber& rubber, const Center& center,
                                   std::span<const Symmetric<double>> history) noexcept;

/// Adds the forces of the branches to `out`.
void add_branch_forces(const Rubber& rubber, const DeformedCell& cell,
                       std::span<const Symmetric<double>> history, CornerForces& forces) noexcept;

}  // namespace rondo::fem::hyperelastic
