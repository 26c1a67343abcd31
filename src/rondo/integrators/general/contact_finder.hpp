// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where a step has contacts (docs/theory.md, 4.1 and 4.8): candidates on the ground, sharp
/// corners of the ground on segments, candidates on segments of other bodies or of their own.
#pragma once
#include <cstddef>
#include <vector>

#include "rondo/contact/search.hpp"
#include "rondo/contact/segment.hpp"
#include "rondo/integrators/general/contact_row.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Lower left and upper right corner [m].
struct Box {
  Vec2 low, high;
};

/// A sharp corner of the ground and the edges that it may touch.
struct NearCorner {
  std::size_t corner = 0;  ///< place in Ground::corners()
  std::vector<int> edges;  ///< of ContactModel::edges, ascending
};

class ContactFinder {
 public:
  explicit ContactFinder(const Model& model);

  /// Rows with kind, nodes, key, normal, gap, tributary and law, in an order that only depends on
  /// the model and the places. @param rows replaced; its memory is kept
  void find(const State& state, std::vector<ContactRow>& rows);
  /// Of these corners alone, and the ground at the nodes that they touch.
  /// @param nodes of the edges, and of the two edges on either side of each
  void find_at_corners(const State& state, std::span<const NearCorner> near,
                       std::span<const int> nodes, std::vector<ContactRow>& rows);
  /// (n) of the nodes that were looked at, fixed frame [m]
  [[nodiscard]] std::span<const Vec2> positions() const noexcept { return positions_; }
  /// Edges that a corner of the ground may touch: those of ContactModel, in their order.
  [[nodiscard]] const contact::Boundary& ground_side() const noexcept { return ground_side_; }
  /// How far a touch is looked for                                                    [m]
  [[nodiscard]] double deepest() const noexcept { return deepest_; }

 private:
  void find_on_ground(std::size_t candidate, std::vector<ContactRow>& rows) const;
  void find_corners(std::vector<ContactRow>& rows) const;
  void find_corner(std::size_t corner, std::span<const int> edges,
                   std::vector<ContactRow>& rows) const;
  void find_segments(std::vector<ContactRow>& rows);
  void find_normals();
  [[nodiscard]] int body_of(std::size_t node) const {
    return model_.body.empty() ? 0 : model_.body[node];
  }
  [[nodiscard]] bool may_touch(std::size_t candidate, int edge) const;
  [[nodiscard]] bool across_a_wall(std::size_t node, const mesh::Edge& edge) const;
  [[nodiscard]] Box box_of_candidates() const;

  const Model& model_;
  contact::Boundary ground_side_;  ///< edges that a corner of the ground may touch
  contact::Boundary surface_;      ///< edges that a node may touch
  std::vector<double> ground_side_limit_, surface_limit_;  ///< (edges) depth of a touch  [m]
  double deepest_ = 0.0;                                   ///< the largest of them       [m]
  std::vector<Vec2> positions_;  ///< (n) fixed frame                                [m]
  std::vector<Vec2> outward_;    ///< (n) sum of the normals of a node's edges
  contact::SegmentGrid grid_;
  std::vector<int> near_;
  std::vector<int> all_edges_;  ///< of the ground's side: few corners, each looks at them all
  std::vector<ContactRow> corner_rows_;
  std::vector<int> touched_;  ///< nodes of corner_rows_, ascending
};

}  // namespace rondo::dynamics
