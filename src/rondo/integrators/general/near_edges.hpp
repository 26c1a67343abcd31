// SPDX-License-Identifier: BSD-3-Clause
/// @file  Which segments a candidate may touch in the steps to come (docs/theory.md, 4.8): found
/// anew only when a node of the boundary has come so far since that one more might be near.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/contact/search.hpp"
#include "rondo/contact/segment.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Lower left and upper right corner [m].
struct Box {
  Vec2 low, high;
};

class NearEdges {
 public:
  /// @param reach how far from a point an edge that it touches may be at most           [m]
  NearEdges(const Model& model, const contact::Boundary& surface, double reach);

  /// All edges within reach of the candidates at these places, and some more, are known after it.
  /// @param positions (n) finite                                                        [m]
  void update(std::span<const Vec2> positions);
  /// The next update() finds all anew.
  void forget() noexcept { built_at_.clear(); }

  /// How far each node may come before the next update() has to be                      [m]
  [[nodiscard]] double slack() const noexcept { return slack_; }

  /// Candidates near some edge that they may touch, ascending: places in SurfaceContact::nodes.
  [[nodiscard]] std::span<const int> candidates() const noexcept { return candidates_; }
  /// Edges near the i-th of these, ascending.
  [[nodiscard]] std::span<const int> edges_near(std::size_t i) const noexcept {
    return std::span(edges_).subspan(static_cast<std::size_t>(start_[i]),
                                     static_cast<std::size_t>(start_[i + 1] - start_[i]));
  }
  /// Times that all were found anew.
  [[nodiscard]] long long builds() const noexcept { return grid_.builds(); }

 private:
  [[nodiscard]] bool holds(std::span<const Vec2> positions) noexcept;
  void build(std::span<const Vec2> positions);
  void find_boxes(std::span<const Vec2> positions);
  [[nodiscard]] bool near_another_body(int body, Vec2 x) const noexcept;
  [[nodiscard]] bool may_touch(int node, int edge) const noexcept;
  [[nodiscard]] bool across_a_wall(std::size_t node, const mesh::Edge& edge) const noexcept;
  [[nodiscard]] int body_of(int node) const noexcept {
    return model_.body.empty() ? 0 : model_.body[at(node)];
  }

  const Model& model_;
  const contact::Boundary& surface_;
  const double reach_;
  double slack_ = 0.0;
  std::vector<int> boundary_;   ///< nodes of candidates and edges, ascending
  std::vector<Vec2> built_at_;  ///< (boundary) where they were; empty: never          [m]
  contact::SegmentGrid grid_;
  std::vector<int> bodies_;  ///< that edges belong to, ascending
  std::vector<Box> boxes_;   ///< (bodies_) of their edges, widened                 [m]
  std::vector<int> near_, candidates_, edges_, start_;
};

}  // namespace rondo::dynamics
