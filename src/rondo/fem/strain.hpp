// SPDX-License-Identifier: BSD-3-Clause
/// @file  How far a body is deformed, cell by cell (docs/theory.md, 2.9): whether small strains
/// still mean something.
#pragma once
#include <cstddef>
#include <limits>
#include <span>

#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

/// Of all cells; the first cell of equal ones.
struct Deformation {
  double strain = 0.0;  ///< largest |principal strain| of the law of the material, at the centers
  std::size_t strain_cell = 0;
  /// Smallest det(I + ∂u/∂X) at a corner; <= 0: the cell is inverted, there at the least.
  double jacobian = std::numeric_limits<double>::infinity();
  std::size_t jacobian_cell = 0;
  /// As `strain`, of the cells whose law is one of small strains.
  double linear_strain = 0.0;
  std::size_t linear_cell = 0;
};

/// @param u (n) finite, in the frame of the body: without rigid rotation [m]
/// @param rubber (cells) 1: at finite strain; empty: none is. @pre there is a cell
[[nodiscard]] Deformation deformation(const mesh::Mesh& mesh, std::span<const Vec2> u,
                                      std::span<const char> rubber = {}) noexcept;

/// The extremes over a run.
struct LargestDeformation {
  Deformation found;
  double strain_time = 0.0, jacobian_time = 0.0, linear_time = 0.0;  ///< when they were seen

  /// Of equal ones the earlier stays.
  void add(const Deformation& now, double time) noexcept;
};

}  // namespace rondo::fem
