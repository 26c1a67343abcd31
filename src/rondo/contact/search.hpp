// SPDX-License-Identifier: BSD-3-Clause
/// @file  Which segments are near a point: a uniform grid over the boxes of the segments, built
/// anew only when a node has moved by more than a skin (docs/theory.md, 4.8).
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"

namespace rondo::contact {

/// Memory grows and is kept. Same input, same answers, in ascending order.
class SegmentGrid {
 public:
  /// Boxes of the edges at these positions, widened by `margin` + `skin` [m]. Cells are at least as
  /// long as the mean widened box, and about four times as many as edges at most.
  /// @pre positions are finite, margin >= 0, skin >= 0
  void build(std::span<const Vec2> positions, std::span<const std::array<int, 2>> edges,
             double margin, double skin);

  /// Builds where there is no grid yet, the edges are other ones in number, or a node of an edge
  /// has moved by more than the skin since the last build; true where it did. `near` is then
  /// right for points and nodes at these positions.
  bool update(std::span<const Vec2> positions, std::span<const std::array<int, 2>> edges,
              double margin, double skin);

  /// Edges with p no farther than `margin` from their box, ascending: at least these, and some
  /// more. Overwrites `edges_out`.
  void near(Vec2 p, std::vector<int>& edges_out) const;

  [[nodiscard]] long long builds() const noexcept { return builds_; }
  [[nodiscard]] std::size_t cells() const noexcept {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }

 private:
  struct Box {
    Vec2 low, high;
  };
  void size_cells();
  void fill_cells();
  [[nodiscard]] int cell_x(double x) const noexcept;
  [[nodiscard]] int cell_y(double y) const noexcept;

  std::vector<Box> boxes_;       ///< (edges) widened by margin + skin                  [m]
  std::vector<Vec2> built_at_;   ///< (edges, 2) positions of their nodes at the build  [m]
  std::vector<int> cell_start_;  ///< (cells + 2)
  std::vector<int> cell_edges_;  ///< edges of each cell, ascending
  Vec2 low_, high_;              ///< lower left and upper right corner of the grid     [m]
  double inverse_cell_ = 0.0;    ///< [1/m]
  int columns_ = 0, rows_ = 0;
  double margin_ = -1.0, skin_ = -1.0;  ///< [m]
  long long builds_ = 0;
};

}  // namespace rondo::contact
