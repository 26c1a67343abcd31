// SPDX-License-Identifier: BSD-3-Clause
/// @file  Which pieces of a long line may be the nearest to a point: boxes around runs of pieces
/// that follow each other, two of them in each box of the level above.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "rondo/core/vec2.hpp"

namespace rondo::contact {

class BoxTree {
 public:
  /// Lower left and upper right corner; may be infinite [m].
  struct Box {
    Vec2 low, high;
  };

  BoxTree() = default;
  /// Time and memory in proportion to the pieces. @param pieces a box around each, in their order
  explicit BoxTree(std::span<const Box> pieces);

  /// Calls `look(piece)` for every piece that may be as near to x as the nearest, the nearer boxes
  /// first, and for some more. `look` returns the distance of the nearest piece so far; a distance
  /// that is wrong by less than a 1e-6th of it or a 1e-12th of the line misses none [m].
  /// Allocates nothing.
  template <class Look>
  void each_near(Vec2 x, const Look& look) const noexcept;

 private:
  struct Run {
    std::size_t level, index;
    double distance;  ///< distance of the box from x [m]
  };
  static constexpr std::size_t pieces_of_leaf = 8;

  [[nodiscard]] static double distance(const Box& box, Vec2 x) noexcept {
    const double dx = std::max({box.low.x - x.x, x.x - box.high.x, 0.0});
    const double dy = std::max({box.low.y - x.y, x.y - box.high.y, 0.0});
    return norm(Vec2{dx, dy});
  }

  std::size_t n_pieces_ = 0;
  std::vector<std::vector<Box>> levels_;  ///< boxes by level: leaves first, one box last [m]
  double round_off_ = 0.0;                ///< round-off error of distances [m]
};

template <class Look>
void BoxTree::each_near(Vec2 x, const Look& look) const noexcept {
  if (n_pieces_ == 0) return;
  std::array<Run, 128> stack;  // one run waits on each level, of 64 at most
  std::size_t waiting = 0;
  const auto run_at = [&](std::size_t level, std::size_t index) {
    return Run{level, index, distance(levels_[level][index], x)};
  };
  stack[waiting++] = run_at(levels_.size() - 1, 0);
  double nearest = std::numeric_limits<double>::infinity();
  while (waiting > 0) {
    const Run run = stack[--waiting];
    if (run.distance > nearest + 1e-6 * (nearest + norm(x)) + round_off_) continue;
    if (run.level == 0) {
      const std::size_t first = run.index * pieces_of_leaf;
      for (std::size_t k = first; k < std::min(first + pieces_of_leaf, n_pieces_); ++k)
        nearest = look(k);
      continue;
    }
    const std::size_t child = 2 * run.index;
    Run near = run_at(run.level - 1, child);
    if (child + 1 < levels_[run.level - 1].size()) {
      Run far = run_at(run.level - 1, child + 1);
      if (far.distance < near.distance) std::swap(near, far);
      stack[waiting++] = far;
    }
    stack[waiting++] = near;
  }
}

}  // namespace rondo::contact
