// SPDX-License-Identifier: BSD-3-Clause
/// @file  Measures of the deformation of a body, cell by cell (docs/theory.md, 2.9): they show
/// whether small-strain theory is still valid.
#pragma once
#include <cstddef>
#include <limits>
#include <span>

#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

/// Extremes over all cells; among equal cells, the first.
struct Deformation {
  double strain = 0.0;  ///< largest |principal strain| by the measure of each law, at the centers
  std::size_t strain_cell = 0;
  /// Smallest det(I + ∂u/∂X) at a corner; <= 0: the cell is inverted, at least there.
  double jacobian = std::numeric_limits<double>::infinity();
  std::size_t jacobian_cell = 0;
  /// Like `strain`, but only of cells with a small-strain law.
  double linear_strain = 0.0;
  std::size_t linear_cell = 0;
};

/// @param u (n) finite, in the frame of the body: without rigid rotation [m]
/// @param rubber (cells) 1: at finite strain; empty: no cell is. @pre there is a cell
[[nodiscard]] Deformation deformation(const mesh::Mesh& mesh, std::span<const Vec2> u,
                                      std::span<const char> rubber = {}) noexcept;

/// The extremes over a run.
struct LargestDeformation {
  Deformation found;
  double strain_time = 0.0, jacobian_time = 0.0, linear_time = 0.0;  ///< when they occurred

  /// Updates the extremes; among equal ones the earlier is kept.
  void add(const Deformation& now, double time) noexcept;
};

}  // namespace rondo::fem
