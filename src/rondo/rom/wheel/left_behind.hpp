// SPDX-License-Identifier: BSD-3-Clause
/// @file  Forces of the step before that stay where they are in space, while the nodes of a mesh
/// turn on (docs/reduced.md): between the nodes that come there.
#pragma once
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"

namespace rondo::rom {

class LeftBehind {
 public:
  /// @param place (C) X of the nodes that may touch
  explicit LeftBehind(std::span<const Vec2> place);

  struct Share {
    int node = 0;
    Vec2 force;  ///< co-rotating frame at the end of the step                      [N/m]
  };
  void clear() noexcept { shares_.clear(); }
  /// Adds a force that was on a node at the start of the step, in the co-rotating frame then: to
  /// the two nodes between which its place is at the end, of those as far out as the node itself.
  /// @param turn of the frame in the step [rad]
  void add(int node, Vec2 force, double turn);
  [[nodiscard]] std::span<const Share> shares() const noexcept { return shares_; }

 private:
  [[nodiscard]] int next_as_far_out(int rank, int step, double radius) const;

  std::vector<int> order_;      ///< (C) nodes by their angle
  std::vector<double> angle_;   ///< (C) ascending, of these                             [rad]
  std::vector<double> radius_;  ///< (C) of these                                         [m]
  std::vector<int> rank_;       ///< (C) of a node in the order
  std::vector<Share> shares_;
};

}  // namespace rondo::rom
