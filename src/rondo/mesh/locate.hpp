// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where a cell is, which cell holds a point, and where in the cell it is.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// Mean of the corners of a cell [m]. @param coordinates (n) of the nodes, wherever they are
Vec2 middle_of(std::span<const Vec2> coordinates, const Cell& cell) noexcept;

/// Shape functions N_a at a point p = Σ N_a x_a of a cell, 0 past its corners: barycentric
/// (triangle), bilinear (quadrilateral, by Newton's method). None where p is outside, by more than
/// a 1e-9th of the cell. @pre 3 or 4 corners, counter-clockwise, convex
std::optional<std::array<double, 4>> shape_functions(std::span<const Vec2> corners, Vec2 p);

/// A uniform grid over the boxes of the cells, about one square a cell.
class CellGrid {
 public:
  /// @param coordinates (n) of the nodes, wherever they are [m]; both must outlive the object.
  /// @pre they are finite, and there is a cell
  CellGrid(std::span<const Vec2> coordinates, std::span<const Cell> cells);

  /// Cells near a point, ascending: at least all that hold it.
  [[nodiscard]] std::span<const int> near(Vec2 p) const;

  /// Shape functions of cell e at p, if it is in it.
  [[nodiscard]] std::optional<std::array<double, 4>> within(int e, Vec2 p) const;

  /// From a point that is in no cell to the nearest one, by looking at all [m].
  [[nodiscard]] double distance(Vec2 p) const;

 private:
  struct Corners {
    std::array<Vec2, 4> at;
    std::size_t n = 0;
  };
  [[nodiscard]] Corners corners(std::size_t e) const;
  [[nodiscard]] std::array<int, 2> square_of(Vec2 p) const;
  template <class Visit>
  void each_square(std::size_t e, Visit&& visit) const;

  std::span<const Vec2> coordinates_;
  std::span<const Cell> cells_;
  Vec2 low_, high_;       ///< [m]
  double inverse_ = 0.0;  ///< of a square's side                                       [1/m]
  int columns_ = 1, rows_ = 1;
  std::vector<std::size_t> start_;  ///< (squares + 1)
  std::vector<int> items_;
};

}  // namespace rondo::mesh
