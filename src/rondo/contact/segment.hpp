// SPDX-License-Identifier: BSD-3-Clause
/// @file  A point against the boundary of a deformable body, made of straight segments
/// (docs/theory.md, 4.8). The body is on the left of each segment a→b.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "rondo/contact/ground.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::contact {

/// A point inside a body, at a segment of its boundary.
struct SegmentTouch {
  double gap = 0.0;  ///< signed distance of the point from the segment's line, > 0 outside  [m]
  double at = 0.0;   ///< ξ of the foot, 0 at a, 1 at b; slightly beyond at a reflex joint    [-]
  Vec2 normal;       ///< unit, out of the body: the way the contact pushes the point
};

/// A segment and the points that its boundary goes on to.
struct Segment {
  Vec2 before;  ///< begin of the segment that ends at a; a itself where there is none [m]
  Vec2 a, b;    ///<                                                               [m]
  Vec2 after;   ///< end of the segment that begins at b; b itself where there is none [m]
};

/// The point is behind the segment's line (gap <= 0), no farther than `deepest` [m] from the
/// segment, and between the bisectors of the joints at a and b: inside a body, each point near a
/// joint belongs to one of its two segments, on the bisector to the first (4.8a). Beyond an end
/// without a neighbour nothing touches. @pre a != b
std::optional<SegmentTouch> touch_segment(Vec2 p, const Segment& segment, double deepest) noexcept;

/// Without neighbours: the foot lies on the segment.
inline std::optional<SegmentTouch> touch_segment(Vec2 p, Vec2 a, Vec2 b, double deepest) noexcept {
  return touch_segment(p, {a, a, b, b}, deepest);
}

/// Boundary of bodies: edges and how they follow each other.
struct Boundary {
  std::vector<std::array<int, 2>> edges;   ///< (n) nodes a, b: the body is on the left
  std::vector<std::array<int, 2>> beside;  ///< (n) edge that ends at a, that begins at b; -1: none
  std::vector<int> body;                   ///< (n) number of the edge's body
};

/// Where several edges begin or several edges end at a node, no edge is a neighbour (two bodies, or
/// two parts of one body, that are joined at this node alone).
/// @param body_of_node number of each node's body; empty: there is one
Boundary make_boundary(std::vector<std::array<int, 2>> edges, std::span<const int> body_of_node);

/// A touch of a boundary.
struct EdgeTouch {
  int edge = -1;
  SegmentTouch touch;
};

/// Each body is touched at the segment where the point is least deep, at one more where it is
/// behind both segments of a joint that turns inwards by over 0.1 rad (a corner pressed into a
/// corner). In the order of the edges; of more than four the first four.
struct EdgeTouches {
  int count = 0;
  std::array<EdgeTouch, 4> at;
};

/// A point that may touch a boundary.
struct BoundaryPoint {
  Vec2 position;      ///< [m]
  int node = -1;      ///< edges of this node do not count; -1: not a node
  int body = -1;      ///< number of the body of that node
  bool self = false;  ///< edges of its own body count
  /// In place of the position, the point of this bend of the ground that an edge meets first.
  const Corner* bend = nullptr;
};

/// The edges of the boundary that the point may touch.
struct BoundaryQuery {
  const Boundary& boundary;
  std::span<const Vec2> positions;  ///< positions of the nodes             [m]
  std::span<const int> candidates;  ///< edges, ascending
  double deepest = 0.0;             ///< see touch_segment                  [m]
};

EdgeTouches touch_boundary(const BoundaryPoint& point, const BoundaryQuery& query) noexcept;

}  // namespace rondo::contact
