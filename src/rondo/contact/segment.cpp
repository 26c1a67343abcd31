// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/segment.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::contact {
namespace {

constexpr double inward_turn = 0.1;  ///< joints that turn inwards by more hold a point twice [rad]

Vec2 unit(Vec2 a) noexcept {
  return a / norm(a);
}

/// The touch at the foot of p on the line through a and b, even if the foot is beyond the ends.
SegmentTouch line_touch(Vec2 p, Vec2 a, Vec2 b) noexcept {
  const Vec2 along = b - a;
  const double length = norm(along);
  const Vec2 normal = -turn90(along / length);
  return {dot(normal, p - a), dot(along, p - a) / (length * length), normal};
}

/// > 0 where p is beyond the joint at j of the segments q→j→r, measured along the mean of their
/// directions: zero on the bisector. Both segments compute it from the same numbers.
double beyond(Vec2 q, Vec2 j, Vec2 r, Vec2 p) noexcept {
  return dot(unit(j - q) + unit(r - j), p - j);
}

double distance_from(const SegmentTouch& touch, double length) noexcept {
  const double past = std::max({0.0, -touch.at, touch.at - 1.0}) * length;
  return std::hypot(touch.gap, past);
}

Segment segment_of(const BoundaryQuery& query, int edge) noexcept {
  const auto point = [&](int node) { return query.positions[at(node)]; };
  const auto& edges = query.boundary.edges;
  const auto [a, b] = edges[at(edge)];
  const auto [before, after] = query.boundary.beside[at(edge)];
  return {before < 0 ? point(a) : point(edges[at(before)][0]), point(a), point(b),
          after < 0 ? point(b) : point(edges[at(after)][1])};
}

Vec2 place_at(const BoundaryPoint& point, const Segment& s) noexcept {
  return point.bend ? first_met(*point.bend, unit(turn90(s.b - s.a))) : point.position;
}

bool may_touch(const BoundaryPoint& point, const Boundary& boundary, int edge) noexcept {
  const auto e = static_cast<std::size_t>(edge);
  if (boundary.edges[e][0] == point.node || boundary.edges[e][1] == point.node) return false;
  return point.self || boundary.body[e] != point.body;
}

/// Keeps the least deep touch of each body, in the order in which bodies are met.
void keep(EdgeTouches& out, const Boundary& boundary, const EdgeTouch& found) noexcept {
  const auto body = [&](const EdgeTouch& t) { return boundary.body[at(t.edge)]; };
  for (int i = 0; i < out.count; ++i) {
    EdgeTouch& known = out.at[at(i)];
    if (body(known) != body(found)) continue;
    if (found.touch.gap > known.touch.gap) known = found;
    return;
  }
  if (out.count < static_cast<int>(out.at.size())) out.at[at(out.count++)] = found;
}

/// The segment beyond the joint, where the boundary turns inwards there and p is behind it too.
std::optional<EdgeTouch> across_joint(const BoundaryPoint& point, const BoundaryQuery& query,
                                      const EdgeTouch& found, bool at_end) noexcept {
  const int other = query.boundary.beside[at(found.edge)][at_end ? 1 : 0];
  if (other < 0 || !may_touch(point, query.boundary, other)) return {};
  const Segment here = segment_of(query, found.edge), there = segment_of(query, other);
  const Vec2 first = at_end ? here.b - here.a : there.b - there.a;
  const Vec2 second = at_end ? there.b - there.a : here.b - here.a;
  if (cross(first, second) > 0.0) return {};
  if (std::atan2(cross(first, second), dot(first, second)) > -inward_turn) return {};
  const SegmentTouch touch = line_touch(place_at(point, there), there.a, there.b);
  if (touch.gap > 0.0 || distance_from(touch, norm(there.b - there.a)) > query.deepest) return {};
  return EdgeTouch{other, touch};
}

}  // namespace

std::optional<SegmentTouch> touch_segment(Vec2 p, const Segment& s, double deepest) noexcept {
  const Vec2 along = s.b - s.a;
  if (cross(p - s.a, along) > 1e-9 * dot(along, along)) return {};  // well before it, as most are
  const SegmentTouch touch = line_touch(p, s.a, s.b);
  if (!(touch.gap <= 0.0)) return {};
  if (s.before == s.a ? touch.at < 0.0 : !(beyond(s.before, s.a, s.b, p) > 0.0)) return {};
  if (s.after == s.b ? touch.at > 1.0 : beyond(s.a, s.b, s.after, p) > 0.0) return {};
  if (distance_from(touch, norm(s.b - s.a)) > deepest) return {};
  return touch;
}

Boundary make_boundary(std::vector<std::array<int, 2>> edges, std::span<const int> body_of_node) {
  int nodes = 0;
  for (const auto& e : edges) nodes = std::max({nodes, e[0] + 1, e[1] + 1});
  constexpr int none = -1, several = -2;
  std::vector<int> begins(static_cast<std::size_t>(nodes), none), ends = begins;
  const auto note = [](int& at, int edge) { at = at == none ? edge : several; };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    RONDO_DEMAND(edges[i][0] >= 0 && edges[i][1] >= 0 && edges[i][0] != edges[i][1], edges[i][0],
                 edges[i][1]);
    note(begins[at(edges[i][0])], static_cast<int>(i));
    note(ends[at(edges[i][1])], static_cast<int>(i));
  }
  Boundary out{.edges = std::move(edges), .beside = {}, .body = {}};
  for (const auto& [a, b] : out.edges) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const bool joined_a = begins[i] >= 0 && ends[i] >= 0, joined_b = begins[j] >= 0 && ends[j] >= 0;
    out.beside.push_back({joined_a ? ends[i] : none, joined_b ? begins[j] : none});
    out.body.push_back(body_of_node.empty() ? 0 : body_of_node[i]);
  }
  return out;
}

EdgeTouches touch_boundary(const BoundaryPoint& point, const BoundaryQuery& query) noexcept {
  EdgeTouches out;
  for (const int edge : query.candidates) {
    if (!may_touch(point, query.boundary, edge)) continue;
    const Segment segment = segment_of(query, edge);
    const auto touch = touch_segment(place_at(point, segment), segment, query.deepest);
    if (touch) keep(out, query.boundary, {edge, *touch});
  }
  for (int i = 0, bodies = out.count; i < bodies; ++i) {
    const EdgeTouch found = out.at[at(i)];
    for (const bool at_end : {true, false}) {
      const auto other = across_joint(point, query, found, at_end);
      if (!other || out.count == static_cast<int>(out.at.size())) continue;
      out.at[at(out.count++)] = *other;
      break;
    }
  }
  return out;
}

}  // namespace rondo::contact
