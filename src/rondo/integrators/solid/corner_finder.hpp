// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where sharp corners of the ground touch the edges around a wheel in three dimensions
/// (docs/wheel3d.md). A corner of the profile is a line along the edges of the
/// ground (contact/space/edge_axes.hpp), mostly t2. It crosses the edges that join
/// the nodes around the wheel, each of which it touches as a plane body's (docs/theory.md, 4.8),
/// seen along the line: between two such edges the tread is ruled, so that the line is nowhere
/// deeper than at one of them.
#pragma once
#include <span>
#include <vector>

#include "rondo/contact/segment.hpp"
#include "rondo/integrators/solid/corner_row.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Edges around the wheel, those of a row one after the other. A row is a sequence of edges that
/// follow each other: a ring, or a piece of one where the tread has gaps.
struct EdgeRows {
  contact::Boundary boundary;   ///< `body` is the number of the row
  std::vector<double> deepest;  ///< (edges) how deep a corner may be behind each: half the shortest
                                ///< edge of its row                                     [m]
};

/// @pre model.solid and model.contact, with edges
[[nodiscard]] EdgeRows edge_rows(const Model& model);

class CornerFinder {
 public:
  /// @pre has_sharp_corners(model), in three dimensions. The model must outlive it.
  explicit CornerFinder(const Model& model);

  [[nodiscard]] const EdgeRows& edges() const noexcept { return edges_; }
  /// The largest of EdgeRows::deepest                                                  [m]
  [[nodiscard]] double deepest() const noexcept { return deepest_; }
  /// Where a node is, (t1, n, t2); set by the caller for the candidates, or for those near corners
  /// [m]
  void set_place(int node, Vec3 place) noexcept;
  /// (n) places on a profile, by on_profile() of wheel_ground.hpp [m]
  [[nodiscard]] std::span<const Vec2> places(std::size_t set = 0) const noexcept {
    return on_profile_[set];
  }
  /// How far from its position a point of a corner may be                               [m]
  [[nodiscard]] double bend_reach() const noexcept { return bend_reach_; }

  /// Place of a node in ContactModel::nodes. @pre it is there
  [[nodiscard]] std::size_t candidate_of(int node) const noexcept {
    return static_cast<std::size_t>(candidate_[static_cast<std::size_t>(node)]);
  }

  /// A corner of the ground and edges that it may touch.
  struct Near {
    std::size_t corner = 0;  ///< place in Ground::corners(), those of one profile after the other
    int edge = 0;            ///< of EdgeRows
    auto operator<=>(const Near&) const = default;
  };
  /// All edges whose boxes, widened, hold a corner; ascending. @param wider by                [m]
  void find_near(double wider, std::vector<Near>& near) const;
  /// Contacts of corners and edges, and those of the nodes of these edges with facets of the
  /// ground, in an order that depends on the model and the places only.
  /// @param near ascending; its edges and those beside them have places
  /// @param rows replaced; its memory is kept
  void find(std::span<const Near> near, std::vector<CornerRow>& rows);
  /// What a corner on an edge is to the nearer node of it, if that is held in its place: a facet
  /// along the edge.
  [[nodiscard]] CornerRow at_nearer_node(const CornerRow& row) const noexcept;
  /// Names of contacts of the last find() that corners on either side of them on the same edge
  /// hold.
  [[nodiscard]] std::span<const std::uint64_t> left_to_others() const noexcept { return left_; }

 private:
  void find_corner(std::size_t corner, std::span<const int> edges, std::vector<CornerRow>& rows);
  void leave_out_middle();
  void find_near_on(std::size_t set, double wider, std::vector<Near>& near) const;
  [[nodiscard]] std::size_t set_of(std::size_t corner) const noexcept;
  [[nodiscard]] CornerRow on_edge(std::size_t set, const contact::EdgeTouch& found) const noexcept;
  [[nodiscard]] CornerRow on_node(std::size_t set, int node, Vec2 normal) const noexcept;
  void find_on_ground(int node, std::vector<CornerRow>& rows) const;

  const Model& model_;
  const GroundFrame ground_;
  const EdgeRows edges_;
  double deepest_ = 0.0;
  std::vector<int> candidate_;                 ///< (n) place in ContactModel::nodes, -1: none
  std::vector<std::size_t> first_corner_;      ///< (profiles + 1) of each among all corners
  std::vector<Vec3> places_;                   ///< (n) in the ground frame                 [m]
  std::vector<std::vector<Vec2>> on_profile_;  ///< (profiles, n)                           [m]
  double bend_reach_ = 0.0;
  std::vector<int> of_corner_, touched_;
  std::vector<CornerRow> at_corners_;
  std::vector<std::uint64_t> left_;
};

}  // namespace rondo::dynamics
