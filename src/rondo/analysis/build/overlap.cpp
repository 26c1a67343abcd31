// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/mesh/locate.hpp"

namespace rondo::study {
namespace {

constexpr const char* one_body =
    "where they should be one body: BooleanFragments{ Surface{:}; Delete; }{} in the .geo file "
    "before it is meshed, or Coherence;, so that they share their nodes";

/// A place of one body in, or on the side of, another.
struct Found {
  int body = -1, other = -1;
  Vec2 place;
  double depth = 0.0, allowed = 0.0;  ///< [m]
  bool is_side = false;               ///< an edge that lies on the other's boundary
};

class Overlaps {
 public:
  explicit Overlaps(const PlacedBodies& in)
      : in_(in),
        bodies_(mesh::find_bodies(in.mesh)),
        size_(element_sizes(in.mesh)),
        touches_(in.mesh.n_nodes(), 0),
        round_off_(1e-6 * extent_of(in.mesh)) {
    RONDO_DEMAND(in.x.size() == in.mesh.n_nodes(), in.x.size(), in.mesh.n_nodes());
    for (const int node : in.mesh.boundary) touches_[at(node)] = 1;
  }

  [[nodiscard]] int count() const noexcept { return bodies_.count; }
  [[nodiscard]] double deepest() const noexcept { return deepest_; }
  [[nodiscard]] double round_off() const noexcept { return round_off_; }

  /// The first that is not allowed.
  std::optional<Found> find() {
    edges_ = mesh::boundary_edges(mesh::EdgeTable(in_.mesh));
    grid_.emplace(in_.x, in_.mesh.cells);
    if (const auto found = find_points()) return found;
    if (const auto found = find_crossings()) return found;
    return find_sides();
  }

  [[nodiscard]] std::string name_of(int body) const {
    const mesh::Mesh& m = in_.mesh;
    RONDO_ASSERT(m.region.empty() || m.region.size() == m.cells.size(), m.region.size());
    std::vector<char> has(m.region_names.size(), 0);
    for (std::size_t e = 0; e < m.region.size(); ++e)
      if (body_of(m.cells[e][0]) == body && m.region[e] >= 0) has[at(m.region[e])] = 1;
    std::string names;
    for (std::size_t k = 0; k < has.size(); ++k)
      if (has[k] && !m.region_names[k].empty())
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", m.region_names[k]);
    return names.empty() ? fmt::format("body {}", body + 1)
                         : fmt::format("body {} ({})", body + 1, names);
  }

 private:
  [[nodiscard]] int body_of(int node) const { return bodies_.of_node[at(node)]; }
  [[nodiscard]] double allowed_at(int node) const {
    return in_.contact_between ? 0.5 * size_[at(node)] : round_off_;
  }

  struct Depth {
    double depth = std::numeric_limits<double>::infinity();  ///< to the nearest edge [m]
    std::size_t edge = 0;
  };
  [[nodiscard]] Depth depth_in(int body, Vec2 p) const {
    Depth nearest;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      if (body_of(edges_[k][0]) != body) continue;
      const Vec2 a = in_.x[at(edges_[k][0])], d = in_.x[at(edges_[k][1])] - a;
      const double along = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
      const double distance = norm(p - a - along * d);
      if (distance < nearest.depth) nearest = {distance, k};
    }
    return nearest;
  }

  /// The first other body that holds a point, as far as a body's edges belong to it; -1: none.
  [[nodiscard]] int holder_of(Vec2 p, int body) const {
    RONDO_ASSERT(grid_.has_value(), body);  // find() has laid it out
    for (const int e : grid_->near(p)) {
      const int other = body_of(in_.mesh.cells[at(e)][0]);
      if (other != body && grid_->within(e, p)) return other;
    }
    return -1;
  }

  std::optional<Found> look_at(Vec2 p, int node) {
    const int body = body_of(node), other = holder_of(p, body);
    if (other < 0) return std::nullopt;
    const double depth = depth_in(other, p).depth;
    deepest_ = std::max(deepest_, depth);
    if (depth <= allowed_at(node)) return std::nullopt;
    return Found{body, other, p, depth, allowed_at(node)};
  }

  std::optional<Found> find_points() {
    for (std::size_t k = 0; k < in_.mesh.n_nodes(); ++k)
      if (bodies_.of_node[k] >= 0)
        if (const auto found = look_at(in_.x[k], static_cast<int>(k))) return found;
    for (const mesh::Cell& cell : in_.mesh.cells)
      if (const auto found = look_at(mesh::middle_of(in_.x, cell), cell[0])) return found;
    return std::nullopt;
  }

  /// Edges that cross, by the least distance of an end from the other's line.
  [[nodiscard]] std::optional<Found> look_at(const mesh::Edge& one, const mesh::Edge& two) const {
    const Vec2 p = in_.x[at(one[0])], q = in_.x[at(one[1])], r = in_.x[at(two[0])],
               s = in_.x[at(two[1])];
    const double of_p = cross(s - r, p - r) / norm(s - r), of_q = cross(s - r, q - r) / norm(s - r);
    const double of_r = cross(q - p, r - p) / norm(q - p), of_s = cross(q - p, s - p) / norm(q - p);
    if (!(of_p * of_q < 0.0 && of_r * of_s < 0.0)) return std::nullopt;
    const double depth = std::min({std::abs(of_p), std::abs(of_q), std::abs(of_r), std::abs(of_s)});
    const double allowed = std::max(allowed_at(one[0]), allowed_at(two[0]));
    if (depth <= allowed) return std::nullopt;
    return Found{body_of(one[0]), body_of(two[0]), p + (of_p / (of_p - of_q)) * (q - p), depth,
                 allowed};
  }

  /// By a sweep along x.
  [[nodiscard]] std::optional<Found> find_crossings() const {
    struct Box {
      double low_x, high_x, low_y, high_y;
      std::size_t edge;
    };
    std::vector<Box> boxes;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const Vec2 a = in_.x[at(edges_[k][0])], b = in_.x[at(edges_[k][1])];
      const auto [low_x, high_x] = std::minmax(a.x, b.x);
      const auto [low_y, high_y] = std::minmax(a.y, b.y);
      boxes.push_back({low_x, high_x, low_y, high_y, k});
    }
    std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
      return a.low_x < b.low_x || (a.low_x == b.low_x && a.edge < b.edge);
    });
    for (auto one = boxes.begin(); one != boxes.end(); ++one)
      for (auto two = one + 1; two != boxes.end() && two->low_x <= one->high_x; ++two) {
        if (two->low_y > one->high_y || two->high_y < one->low_y) continue;
        const mesh::Edge &a = edges_[one->edge], &b = edges_[two->edge];
        if (body_of(a[0]) == body_of(b[0])) continue;
        if (const auto found = look_at(a, b)) return found;
      }
    return std::nullopt;
  }

  /// Edges whose ends and middle lie on the boundary of another body, where no contact is between.
  [[nodiscard]] std::optional<Found> find_sides() const {
    for (const mesh::Edge& edge : edges_) {
      const Vec2 a = in_.x[at(edge[0])], b = in_.x[at(edge[1])], middle = 0.5 * (a + b);
      const int body = body_of(edge[0]), other = holder_of(middle, body);
      if (other < 0) continue;
      const Depth on = depth_in(other, middle);
      if (on.depth > round_off_ || depth_in(other, a).depth > round_off_ ||
          depth_in(other, b).depth > round_off_)
        continue;
      const mesh::Edge& side = edges_[on.edge];
      const bool in_contact = in_.contact_between && touches_[at(edge[0])] &&
                              touches_[at(edge[1])] && touches_[at(side[0])] &&
                              touches_[at(side[1])];
      if (!in_contact) return Found{body, other, middle, 0.0, 0.0, true};
    }
    return std::nullopt;
  }

  const PlacedBodies& in_;
  mesh::Bodies bodies_;
  std::vector<double> size_;
  std::vector<char> touches_;  ///< (n) 1: a candidate
  double round_off_ = 0.0;     ///< [m]
  std::vector<mesh::Edge> edges_;
  std::optional<mesh::CellGrid> grid_;
  double deepest_ = 0.0;  ///< deepest overlap that is allowed [m]
};

}  // namespace

void refuse_overlaps(const Case& c, const PlacedBodies& bodies,
                     std::vector<std::string>& warnings) {
  if (!c.mesh) return;               // a generated disk is one body
  constexpr double farthest = 1e60;  // beyond, boxes leave the range of the numbers
  if (std::ranges::any_of(bodies.x, [](Vec2 x) { return !(norm(x) <= farthest); })) return;
  Overlaps overlaps(bodies);
  if (overlaps.count() < 2) return;
  const auto found = overlaps.find();
  if (!found) {
    if (overlaps.deepest() > overlaps.round_off())
      warnings.push_back(
          fmt::format("two bodies start {:.4g} m inside each other: contact keeps them from going "
                      "deeper, but does not push them out",
                      overlaps.deepest()));
    return;
  }
  const std::string which =
      fmt::format("{} and {}, at ({:.6g}, {:.6g})", overlaps.name_of(found->body),
                  overlaps.name_of(found->other), found->place.x, found->place.y);
  if (found->is_side) {
    const bool may_touch = rules_of(c.analysis.kind).in_time;
    throw case_error(
        c, "mesh.file",
        fmt::format("the sides of two bodies coincide, and neither cells nor a contact "
                    "join them: {}",
                    which),
        fmt::format("{}{}", one_body,
                    may_touch ? "; where they should be two: contact.between = \"bodies\", with "
                                "both sides in mesh.contact"
                              : ""));
  }
  if (bodies.contact_between)
    throw case_error(c, "contact.between",
                     fmt::format("two bodies start {:.4g} m inside each other, more than half an "
                                 "element ({:.4g} m): {}",
                                 found->depth, found->allowed, which),
                     fmt::format("bodies that start apart from each other; {}", one_body));
  throw case_error(c, "mesh.file",
                   fmt::format("two bodies overlap, {:.4g} m deep: {}", found->depth, which),
                   fmt::format("bodies beside each other; {}", one_body));
}

}  // namespace rondo::study
