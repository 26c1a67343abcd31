// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/ground/ground_inside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "rondo/contact/box_tree.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/mesh/locate.hpp"

namespace rondo::study {
namespace {

double distance_to(Vec2 a, Vec2 b, Vec2 p) noexcept {
  const Vec2 d = b - a;
  const double along = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return norm(p - a - along * d);
}

/// The boundary of a mesh, searched by place.
class Sides {
 public:
  Sides(const mesh::Mesh& mesh, std::span<const Vec2> x)
      : x_(x), edges_(mesh::in_order(mesh::boundary_edges(mesh::EdgeTable(mesh)))) {
    const std::set<mesh::Edge> contact(mesh.contact_edges.begin(), mesh.contact_edges.end());
    std::vector<contact::BoxTree::Box> boxes;
    for (const mesh::Edge& e : edges_) {
      const Vec2 a = x[at(e[0])], b = x[at(e[1])];
      boxes.push_back(
          {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}});
      may_touch_.push_back(contact.contains(e) ? 1 : 0);
    }
    tree_ = contact::BoxTree(boxes);
  }

  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();  ///< [m]
    mesh::Edge edge{};
    bool may_touch = false;
  };
  [[nodiscard]] Nearest nearest(Vec2 p) const {
    Nearest out;
    tree_.each_near(p, [&](std::size_t k) {
      const double distance = distance_to(x_[at(edges_[k][0])], x_[at(edges_[k][1])], p);
      if (distance < out.distance) out = {distance, edges_[k], may_touch_[k] != 0};
      return out.distance;
    });
    return out;
  }

 private:
  std::span<const Vec2> x_;
  std::vector<mesh::Edge> edges_;
  std::vector<char> may_touch_;  ///< (edges)
  contact::BoxTree tree_;
};

/// A cell where it is at the start.
struct PlacedCell {
  std::array<Vec2, 4> corner;
  std::size_t n = 0;
  double size = 0.0;  ///< [m]

  [[nodiscard]] std::span<const Vec2> corners() const { return {corner.data(), n}; }
};

PlacedCell place(const mesh::Cell& cell, std::span<const Vec2> x, std::span<const double> size) {
  PlacedCell out;
  out.n = static_cast<std::size_t>(mesh::n_corners(cell));
  out.size = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < out.n; ++a) {
    out.corner[a] = x[at(cell[a])];
    out.size = std::min(out.size, size[at(cell[a])]);
  }
  RONDO_ASSERT(out.size > 0.0, out.size, out.n);  // else the points of the ground were endless
  return out;
}

/// Points of the ground in the cell, a quarter of its undeformed size apart. The initial
/// displacement may stretch a cell without bound: its points are then a 256th of its diagonal
/// apart, and ground in a thinner cell is not seen.
std::vector<Vec2> points_in(const contact::Ground& ground, const PlacedCell& cell) {
  Vec2 low = cell.corner[0], high = low;
  for (const Vec2 corner : cell.corners()) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  constexpr double finest = 1.0 / 256.0;
  const double diagonal = norm(high - low);
  if (low.y > ground.top()) return {};
  if (std::abs(ground.distance(0.5 * (low + high))) > 0.5 * diagonal) return {};
  const double apart = std::max(0.25 * cell.size, finest * diagonal);
  std::vector<Vec2> points = ground.surface_points(low, high, apart);
  std::erase_if(points, [&](Vec2 p) { return !mesh::shape_functions(cell.corners(), p); });
  return points;
}

}  // namespace

GroundInside find_ground_inside(const Setup& s, std::span<const Vec2> x,
                                std::span<const double> size) {
  RONDO_DEMAND(s.model.contact && !s.model.solid && x.size() == s.mesh.n_nodes() &&
                   size.size() == s.mesh.n_nodes(),
               s.model.contact.has_value(), x.size(), size.size(), s.mesh.n_nodes());
  constexpr double farthest = 1e60;  // beyond, boxes leave the range of the numbers
  if (!std::ranges::all_of(x, [](Vec2 place) { return norm(place) <= farthest; })) return {};
  GroundInside out;
  std::optional<Sides> sides;
  for (const mesh::Cell& cell : s.mesh.cells)
    for (const Vec2 p : points_in(s.model.contact->ground, place(cell, x, size))) {
      if (!sides) sides.emplace(s.mesh, x);
      const Sides::Nearest side = sides->nearest(p);
      if (!side.may_touch) continue;
      const double of_side = std::min(size[at(side.edge[0])], size[at(side.edge[1])]);
      if (side.distance / of_side > out.depth / out.size)
        out = {side.distance, of_side, p, side.edge[0]};
    }
  return out;
}

}  // namespace rondo::study
