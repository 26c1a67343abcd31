// SPDX-License-Identifier: BSD-3-Clause
/// @file  The middle of a cell, the cell that contains a point, and the shape functions there.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// Mean of the corners of a cell [m]. @param coordinates (n) reference or current, of the nodes
Vec2 middle_of(std::span<const Vec2> coordinates, const Cell& cell) noexcept;

/// Shape functions N_a at a point p = Σ N_a x_a of a cell, 0 beyond its corners: barycentric
/// (triangle) or bilinear (quadrilateral, by Newton's method). Returns nothing if p is outside by
/// more than 1e-9 of the cell's size. @pre 3 or 4 corners, counter-clockwise, convex
std::optional<std::array<double, 4>> shape_functions(std::span<const Vec2> corners, Vec2 p);

/// A uniform grid over the bounding boxes of the cells, with about one square per cell.
class CellGrid {
 public:
  /// @param coordinates (n) of the nodes [m]; they and the cells must outlive the object.
  /// @pre the coordinates are finite, and there is a cell
  CellGrid(std::span<const Vec2> coordinates, std::span<const Cell> cells);

  /// Cells near a point, ascending: all cells that contain it, and perhaps others.
  [[nodiscard]] std::span<const int> near(Vec2 p) const;

  /// Shape functions of cell e at p, if the cell contains p.
  [[nodiscard]] std::optional<std::array<double, 4>> within(int e, Vec2 p) const;

  /// Distance from a point outside all cells to the nearest cell; examines every cell [m].
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
  double inverse_ = 0.0;  ///< 1 / side of a square                                         [1/m]
  int columns_ = 1, rows_ = 1;
  std::vector<std::size_t> start_;  ///< (squares + 1)
  std::vector<int> items_;
};

}  // namespace rondo::mesh
