// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/corner_finder.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "rondo/contact/coupled/clusters.hpp"
#include "rondo/contact/coupled/node_to_segment.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/integrators/general/readable_step.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::dynamics {
namespace {

/// H in components normal to the edges of the ground and along n, of a contact frame with the
/// direction of the edges, in the axes of the wheel.
contact::SpatialBlock in_space(const GroundFrame& ground, const contact::EdgeAxes& axes,
                               const contact::Block& plane, double along) noexcept {
  const auto row = [&](Vec3 a) { return ground.to_wheel(axes.to_ground(a)); };
  return {row({plane[0], plane[1], 0.0}), row({plane[2], plane[3], 0.0}), row({0.0, 0.0, along})};
}

std::uint64_t key_of_corner(std::size_t corner, int edge) noexcept {
  return static_cast<std::uint64_t>(ContactKind::corner) << 62U |
         static_cast<std::uint64_t>(corner) << key_bits_of_edge | static_cast<std::uint64_t>(edge);
}

}  // namespace

EdgeRows edge_rows(const Model& model) {
  RONDO_DEMAND(model.contact && model.solid && !model.contact->edges.empty());
  const std::vector<mesh::Edge>& edges = model.contact->edges;
  std::vector<int> start{0}, nodes;
  for (const mesh::Edge& edge : edges) {
    nodes.insert(nodes.end(), edge.begin(), edge.end());
    start.push_back(static_cast<int>(nodes.size()));
  }
  contact::ClusterFinder finder;
  const contact::Clusters& rows = finder.find(start, nodes, model.n_nodes());
  std::vector<std::array<int, 2>> in_rows;
  EdgeRows out;
  std::vector<int> row_of_node(model.n_nodes(), -1);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const int i : rows[row]) {
      const auto [a, b] = edges[at(i)];
      in_rows.push_back({a, b});
      row_of_node[at(a)] = row_of_node[at(b)] = static_cast<int>(row);
      shortest = std::min(
          shortest, norm(reference_of<Vec3>(model, at(b)) - reference_of<Vec3>(model, at(a))));
    }
    out.deepest.insert(out.deepest.end(), rows[row].size(), 0.5 * shortest);
  }
  out.boundary = contact::make_boundary(std::move(in_rows), row_of_node);
  return out;
}

CornerFinder::CornerFinder(const Model& model)
    : model_(model),
      ground_(model.motion.camber),
      edges_(edge_rows(model)),
      deepest_(std::ranges::max(edges_.deepest)),
      candidate_(places_among(model.contact->nodes, model.n_nodes())),
      first_corner_{0},
      places_(model.n_nodes()),
      on_profile_(profile_count(*model.contact), std::vector<Vec2>(model.n_nodes())) {
  RONDO_DEMAND(has_sharp_corners(model) && model.solid.has_value());
  for (std::size_t set = 0; set < on_profile_.size(); ++set) {
    const contact::Ground& ground = profile_of(*model.contact, set);
    first_corner_.push_back(first_corner_.back() + ground.corners().size());
    bend_reach_ = std::max(bend_reach_, ground.bend_reach());
  }
  for (const auto& [a, b] : edges_.boundary.edges)
    RONDO_DEMAND(candidate_[at(a)] >= 0 && candidate_[at(b)] >= 0, a, b);
}

void CornerFinder::set_place(int node, Vec3 place) noexcept {
  places_[at(node)] = place;
  for (std::size_t set = 0; set < on_profile_.size(); ++set)
    on_profile_[set][at(node)] = on_profile(*model_.contact, set, place);
}

std::size_t CornerFinder::set_of(std::size_t corner) const noexcept {
  std::size_t set = 0;
  while (corner >= first_corner_[set + 1]) ++set;
  return set;
}

void CornerFinder::find_near(double wider, std::vector<Near>& near) const {
  near.clear();
  for (std::size_t set = 0; set < on_profile_.size(); ++set) find_near_on(set, wider, near);
  std::ranges::sort(near);
}

void CornerFinder::find_near_on(std::size_t set, double wider, std::vector<Near>& near) const {
  const contact::Ground& ground = profile_of(*model_.contact, set);
  const contact::Corner* const first = ground.corners().data();
  const std::span<const Vec2> x = places(set);
  for (std::size_t i = 0; i < edges_.boundary.edges.size(); ++i) {
    const Vec2 a = x[at(edges_.boundary.edges[i][0])];
    const Vec2 b = x[at(edges_.boundary.edges[i][1])];
    const double low = std::min(a.y, b.y) - wider, high = std::max(a.y, b.y) + wider;
    if (low > ground.top()) continue;
    for (const contact::Corner& c :
         ground.corners(std::min(a.x, b.x) - wider, std::max(a.x, b.x) + wider))
      if (c.position.y >= low && c.position.y <= high)
        near.push_back(
            Near{first_corner_[set] + static_cast<std::size_t>(&c - first), static_cast<int>(i)});
  }
}

void CornerFinder::find(std::span<const Near> near, std::vector<CornerRow>& rows) {
  rows.clear();
  at_corners_.clear();
  left_.clear();
  const auto row_of = [&](const Near& n) { return edges_.boundary.body[at(n.edge)]; };
  for (auto of = near.begin(); of != near.end();) {
    const std::size_t corner = of->corner;
    const int row = row_of(*of);
    of_corner_.clear();
    for (; of != near.end() && of->corner == corner && row_of(*of) == row; ++of)
      of_corner_.push_back(of->edge);
    find_corner(corner, of_corner_, at_corners_);
  }
  leave_out_middle();
  touched_.clear();
  for (const CornerRow& row : at_corners_)
    touched_.insert(touched_.end(), row.node.begin(), row.node.begin() + row.count);
  std::ranges::sort(touched_);
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (const int node : touched_) find_on_ground(node, rows);
  rows.insert(rows.end(), at_corners_.begin(), at_corners_.end());
}

/// A node that the ground pushes along a normal.
CornerRow CornerFinder::on_node(std::size_t set, int node, Vec2 normal) const noexcept {
  const Vec2 tangent = turn90(normal);
  CornerRow row;
  row.kind = ContactKind::facet;
  row.count = 1;
  row.node = {node, -1};
  row.weight = {1.0, 0.0};
  row.set = set;
  row.block[0] = in_space(ground_, axes_of(*model_.contact, set),
                          {normal.x, normal.y, tangent.x, tangent.y}, 1.0);
  row.normal = normal;
  return row;
}

/// Velocities along the normal of an edge are linear along it: where they are not into the edge at
/// its first and last corner, they are at none between, so that those are left out.
void CornerFinder::leave_out_middle() {
  std::ranges::sort(at_corners_, {}, [](const CornerRow& row) {
    return std::tuple(row.node, row.set, row.weight[1], row.key);
  });
  std::array<int, 2> last{-1, -1};
  std::size_t last_set = 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < at_corners_.size(); ++i) {
    const CornerRow row = at_corners_[i];
    const bool is_between = row.count == 2 && row.node == last && row.set == last_set &&
                            i + 1 < at_corners_.size() && at_corners_[i + 1].node == row.node &&
                            at_corners_[i + 1].set == row.set;
    last = row.node;
    last_set = row.set;
    if (is_between)
      left_.push_back(row.key);
    else
      at_corners_[kept++] = row;
  }
  at_corners_.resize(kept);
}

CornerRow CornerFinder::at_nearer_node(const CornerRow& row) const noexcept {
  CornerRow out = on_node(row.set, row.node[row.weight[0] < row.weight[1] ? 1 : 0], -row.normal);
  out.point = row.point;
  out.key = row.key;
  out.gap = row.gap;
  return out;
}

/// A corner on an edge, as one of a plane body (node_to_segment.hpp), with t2.
CornerRow CornerFinder::on_edge(std::size_t set, const contact::EdgeTouch& found) const noexcept {
  const auto [a, b] = edges_.boundary.edges[at(found.edge)];
  const double at_b = found.touch.at;
  const std::span<const Vec2> x = places(set);
  const contact::SegmentRows plane = contact::segment_rows(found.touch, norm(x[at(b)] - x[at(a)]));
  const contact::EdgeAxes& axes = axes_of(*model_.contact, set);
  CornerRow row;
  row.kind = ContactKind::corner;
  row.count = 2;
  row.node = {a, b};
  row.weight = {1.0 - at_b, at_b};
  row.set = set;
  row.block = {in_space(ground_, axes, plane.a, at_b - 1.0),
               in_space(ground_, axes, plane.b, -at_b)};
  row.normal = found.touch.normal;
  return row;
}

/// @param edges of one row
void CornerFinder::find_corner(std::size_t c, std::span<const int> edges,
                               std::vector<CornerRow>& rows) {
  const std::size_t set = set_of(c);
  const contact::Corner& corner =
      profile_of(*model_.contact, set).corners()[c - first_corner_[set]];
  const Vec2 facing = corner.normals[0] + corner.normals[1];
  const contact::EdgeTouches touches =
      contact::touch_boundary({.position = corner.position, .bend = &corner},
                              {edges_.boundary, places(set), edges, deepest_});
  for (int t = 0; t < touches.count; ++t) {
    const contact::EdgeTouch& found = touches.at[at(t)];
    if (-found.touch.gap > edges_.deepest[at(found.edge)] || dot(found.touch.normal, facing) >= 0.0)
      continue;
    CornerRow row = on_edge(set, found);
    row.point = contact::first_met(corner, -found.touch.normal);
    row.key = key_of_corner(c, found.edge);
    row.gap = found.touch.gap;
    rows.push_back(row);
  }
}

void CornerFinder::find_on_ground(int node, std::vector<CornerRow>& rows) const {
  const ContactModel& contact = *model_.contact;
  const std::size_t candidate = candidate_of(node);
  const auto [set, touches] = touches_on_profile(contact, places_[at(node)]);
  for (int t = 0; t < touches.count; ++t) {
    const contact::Touch& touch = touches.at[at(t)];
    CornerRow row = on_node(set, node, touch.normal);
    row.point = places(set)[at(node)];
    row.key = 2 * candidate + at(t);
    row.gap = touch.gap;
    row.tributary = contact.tributary[candidate];
    rows.push_back(row);
  }
}

}  // namespace rondo::dynamics
