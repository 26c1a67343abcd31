// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where a step has contacts (docs/theory.md, 4.1 and 4.8): candidates on the ground, sharp
/// corners of the ground on segments, candidates on segments of other bodies or of their own.
#pragma once
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "rondo/contact/segment.hpp"
#include "rondo/core/index.hpp"
#include "rondo/integrators/general/contact_row.hpp"
#include "rondo/integrators/general/near_edges.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// A sharp corner of the ground and the edges that it may touch.
struct NearCorner {
  std::size_t corner = 0;  ///< place in Ground::corners()
  std::vector<int> edges;  ///< numbers of ContactModel::edges, ascending
};

class ContactFinder {
 public:
  explicit ContactFinder(const Model& model);

  /// Rows with kind, nodes, key, normal, gap, tributary and law, in an order that only depends on
  /// the model and the places. @param rows replaced; its memory is kept
  void find(const State& state, std::vector<ContactRow>& rows);
  /// Nodes whose places the next find() looks at, for callers that know how far any node has come
  /// since the last one at most: fewer than boundary() as long as nothing else can touch.
  /// @param travelled in x or y, at most                                                [m]
  [[nodiscard]] std::span<const int> boundary_after(double travelled) noexcept;
  /// The next find() looks at everything anew; what it finds is the same to the bit.
  void forget() noexcept {
    near_edges_.forget();
    slack_ = 0.0;
  }
  /// Times that it looked at all edges between bodies.
  [[nodiscard]] long long builds() const noexcept { return near_edges_.builds(); }
  /// Finds the contacts of these corners alone, and of the ground at the nodes that they touch.
  /// @param nodes of the edges, and of the two edges on either side of each
  void find_at_corners(const State& state, std::span<const NearCorner> near,
                       std::span<const int> nodes, std::vector<ContactRow>& rows);
  /// Nodes whose places find() looks at: of candidates and edges, ascending.
  [[nodiscard]] std::span<const int> boundary() const noexcept { return boundary_; }
  /// (n) of the nodes that were looked at, fixed frame [m]
  [[nodiscard]] std::span<const Vec2> positions() const noexcept { return positions_; }
  /// Edges that a corner of the ground may touch: those of ContactModel, in their order.
  [[nodiscard]] const contact::Boundary& ground_side() const noexcept { return ground_side_; }
  /// Edges beside that of a corner's or a segment's row, -1: there is none.
  [[nodiscard]] const std::array<int, 2>& beside(const ContactRow& row) const noexcept {
    const auto edge = static_cast<std::size_t>(row.key & ((1ULL << key_bits_of_edge) - 1));
    return (row.kind == ContactKind::corner ? ground_side_ : surface_).beside[edge];
  }
  /// How far a touch is looked for                                                    [m]
  [[nodiscard]] double deepest() const noexcept { return deepest_; }

 private:
  void find_on_ground(std::size_t candidate, std::vector<ContactRow>& rows) const;
  void find_corners(std::vector<ContactRow>& rows);
  void find_corner(std::size_t corner, std::span<const int> edges,
                   std::vector<ContactRow>& rows) const;
  void find_segments(std::vector<ContactRow>& rows);
  [[nodiscard]] bool set_positions(const State& state);
  void find_near();
  void find_near_ground();
  void find_near_edges();
  void find_touches(std::size_t candidate, std::span<const int> near,
                    std::vector<ContactRow>& rows);
  [[nodiscard]] Vec2 outward_of(int node) const;
  [[nodiscard]] int body_of(int node) const {
    return model_.body.empty() ? 0 : model_.body[at(node)];
  }
  [[nodiscard]] Box box_of_candidates() const;

  const Model& model_;
  contact::Boundary ground_side_;  ///< edges that a corner of the ground may touch
  contact::Boundary surface_;      ///< edges that a node may touch
  std::vector<double> ground_side_limit_, surface_limit_;  ///< (edges) depth of a touch  [m]
  double deepest_ = 0.0;                                   ///< the largest of them       [m]
  std::vector<int> boundary_;
  std::vector<Vec2> positions_;  ///< (n) fixed frame                                [m]
  std::vector<int> first_edge_,
      edges_at_;  ///< (n + 1), edges of the surface at each node, ascending
  NearEdges near_edges_;
  double ground_margin_ = 0.0;    ///< how far from the ground a candidate is near it      [m]
  double slack_ = 0.0;            ///< how far nodes may come before all are looked at     [m]
  bool near_alone_ = false;       ///< the next find() looks at what is near alone
  std::vector<int> near_ground_;  ///< candidates, ascending
  std::vector<int> near_nodes_;   ///< nodes of what is near, ascending
  std::vector<char> is_near_;     ///< (n)
  std::vector<int> facing_;       ///< edges near a node that face it
  std::vector<std::pair<std::size_t, int>> corner_edges_;  ///< corners and edges near each other
  std::vector<int> near_corner_;                           ///< edges near one corner, ascending
  std::vector<ContactRow> corner_rows_;
  std::vector<int> touched_;  ///< nodes of corner_rows_, ascending
};

}  // namespace rondo::dynamics
