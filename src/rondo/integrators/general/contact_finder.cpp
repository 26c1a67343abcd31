// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/contact_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "rondo/contact/coupled/node_to_segment.hpp"

namespace rondo::dynamics {
namespace {

using contact::EdgeTouch;

std::uint64_t key_of(ContactKind kind, std::size_t first, std::size_t second) noexcept {
  return static_cast<std::uint64_t>(kind) << 62U | static_cast<std::uint64_t>(first) << 31U |
         static_cast<std::uint64_t>(second);
}

std::size_t at(int node) noexcept {
  return static_cast<std::size_t>(node);
}

/// How deep a point may be behind each edge [m]: half the shortest edge of the body, for what is
/// deeper may be nearer to its other side.
std::vector<double> depth_limits(const Model& model, const contact::Boundary& boundary) {
  std::map<int, double> shortest;  // by body
  for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
    const auto [a, b] = boundary.edges[i];
    const double length = norm(model.reference[at(b)] - model.reference[at(a)]);
    const auto [known, fresh] = shortest.try_emplace(boundary.body[i], length);
    known->second = std::min(known->second, length);
  }
  std::vector<double> limits;
  for (const int body : boundary.body) limits.push_back(0.5 * shortest[body]);
  return limits;
}

}  // namespace

ContactFinder::ContactFinder(const Model& model)
    : model_(model), positions_(model.n_nodes()), outward_(model.surfaces ? model.n_nodes() : 0) {
  if (model.contact && !model.contact->ground.corners().empty())
    ground_side_ = contact::make_boundary(model.contact->edges, model.body);
  all_edges_.resize(ground_side_.edges.size());
  std::iota(all_edges_.begin(), all_edges_.end(), 0);
  if (model.surfaces) surface_ = contact::make_boundary(model.surfaces->edges, model.body);
  ground_side_limit_ = depth_limits(model, ground_side_);
  surface_limit_ = depth_limits(model, surface_);
  for (const double limit : ground_side_limit_) deepest_ = std::max(deepest_, limit);
  for (const double limit : surface_limit_) deepest_ = std::max(deepest_, limit);
}

void ContactFinder::find(const State& state, std::vector<ContactRow>& rows) {
  rows.clear();
  Vec2 sum;
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    positions_[k] = position(model_, state, k);
    sum += positions_[k];
  }
  if (!std::isfinite(sum.x) || !std::isfinite(sum.y)) return;  // the ledger will tell
  if (model_.contact)
    for (std::size_t i = 0; i < model_.contact->nodes.size(); ++i) find_on_ground(i, rows);
  if (!ground_side_.edges.empty()) find_corners(rows);
  if (model_.surfaces) find_segments(rows);
}

void ContactFinder::find_on_ground(std::size_t i, std::vector<ContactRow>& rows) const {
  const ContactModel& contact = *model_.contact;
  const contact::Touches touches = contact.ground.touches(positions_[at(contact.nodes[i])]);
  for (int t = 0; t < touches.count; ++t) {
    const contact::Touch& touch = touches.at[at(t)];
    ContactRow row;
    row.kind = ContactKind::facet;
    row.rows = contact::ground_rows(contact.nodes[i], touch.normal);
    row.key = key_of(row.kind, i, at(t));
    row.normal = touch.normal;
    row.gap = touch.gap;
    row.tributary = contact.tributary[i];
    row.law = contact.law;
    rows.push_back(row);
  }
}

void ContactFinder::find_at_corners(const State& state, std::span<const NearCorner> near,
                                    std::span<const int> nodes, std::vector<ContactRow>& rows) {
  rows.clear();
  corner_rows_.clear();
  Vec2 sum;
  for (const int node : nodes) sum += positions_[at(node)] = position(model_, state, at(node));
  if (!std::isfinite(sum.x) || !std::isfinite(sum.y)) return;  // the ledger will tell
  for (const NearCorner& n : near) find_corner(n.corner, n.edges, corner_rows_);
  touched_.clear();
  for (const ContactRow& row : corner_rows_)
    touched_.insert(touched_.end(), row.rows.node.begin(), row.rows.node.begin() + row.rows.count);
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (const int node : touched_) find_on_ground(at(node), rows);
  rows.insert(rows.end(), corner_rows_.begin(), corner_rows_.end());
}

Box ContactFinder::box_of_candidates() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity}, {-infinity, -infinity}};
  for (const int node : model_.contact->nodes) {
    const Vec2 x = positions_[at(node)];
    box.low = {std::min(box.low.x, x.x), std::min(box.low.y, x.y)};
    box.high = {std::max(box.high.x, x.x), std::max(box.high.y, x.y)};
  }
  return box;
}

/// A profile may have many corners; few are where the bodies are, and these look at all edges.
void ContactFinder::find_corners(std::vector<ContactRow>& rows) const {
  const Box box = box_of_candidates();
  const auto corners = model_.contact->ground.corners();
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Vec2 p = corners[c].position;
    if (p.x < box.low.x || p.x > box.high.x || p.y < box.low.y || p.y > box.high.y) continue;
    find_corner(c, all_edges_, rows);
  }
}

void ContactFinder::find_corner(std::size_t c, std::span<const int> edges,
                                std::vector<ContactRow>& rows) const {
  const contact::Corner& corner = model_.contact->ground.corners()[c];
  const Vec2 p = corner.position, facing = corner.normals[0] + corner.normals[1];
  const contact::EdgeTouches touches =
      contact::touch_boundary({.position = p}, {ground_side_, positions_, edges, deepest_});
  for (int t = 0; t < touches.count; ++t) {
    const EdgeTouch& found = touches.at[at(t)];
    const mesh::Edge& e = ground_side_.edges[at(found.edge)];
    const double length = norm(positions_[at(e[1])] - positions_[at(e[0])]);
    if (-found.touch.gap > ground_side_limit_[at(found.edge)] ||
        dot(found.touch.normal, facing) >= 0.0)
      continue;
    ContactRow row;
    row.kind = ContactKind::corner;
    row.rows = contact::corner_rows(found.touch, length, e[0], e[1]);
    row.point = p;
    row.key = key_of(row.kind, c, at(found.edge));
    row.normal = found.touch.normal;
    row.gap = found.touch.gap;
    row.law = model_.contact->law;
    rows.push_back(row);
  }
}

void ContactFinder::find_normals() {
  for (const mesh::Edge& e : surface_.edges) outward_[at(e[0])] = outward_[at(e[1])] = Vec2{};
  for (const mesh::Edge& e : surface_.edges) {
    const Vec2 along = positions_[at(e[1])] - positions_[at(e[0])];
    const Vec2 normal = -turn90(along) / norm(along);
    outward_[at(e[0])] += normal;
    outward_[at(e[1])] += normal;
  }
}

/// An edge of another body, or of the same if that is wanted, that faces the node.
bool ContactFinder::may_touch(std::size_t candidate, int edge) const {
  const SurfaceContact& s = *model_.surfaces;
  const auto node = at(s.nodes[candidate]);
  const mesh::Edge& e = surface_.edges[at(edge)];
  const bool same = body_of(node) == body_of(at(e[0]));
  if (same && (!s.self || across_a_wall(node, e))) return false;
  const Vec2 along = positions_[at(e[1])] - positions_[at(e[0])];
  return dot(outward_[node], -turn90(along)) < 0.0;
}

/// The edge is the other side of a wall at the node: undeformed, the node is behind it, and near.
bool ContactFinder::across_a_wall(std::size_t node, const mesh::Edge& edge) const {
  const Vec2 a = model_.reference[at(edge[0])];
  const Vec2 along = model_.reference[at(edge[1])] - a, to = model_.reference[node] - a;
  if (cross(along, to) < 0.0) return false;  // in front: the outward normal is on the right
  const double on = std::clamp(dot(along, to) / dot(along, along), 0.0, 1.0);
  return norm(to - on * along) < norm(along);
}

void ContactFinder::find_segments(std::vector<ContactRow>& rows) {
  const SurfaceContact& s = *model_.surfaces;
  find_normals();
  grid_.update(positions_, surface_.edges, deepest_, 2.0 * deepest_);
  for (std::size_t i = 0; i < s.nodes.size(); ++i) {
    const int node = s.nodes[i];
    grid_.near(positions_[at(node)], near_);
    std::erase_if(near_, [&](int edge) { return !may_touch(i, edge); });
    if (near_.empty()) continue;
    const contact::EdgeTouches touches =
        contact::touch_boundary({positions_[at(node)], node, body_of(at(node)), s.self},
                                {surface_, positions_, near_, deepest_});
    for (int t = 0; t < touches.count; ++t) {
      const EdgeTouch& found = touches.at[at(t)];
      const mesh::Edge& e = surface_.edges[at(found.edge)];
      const double length = norm(positions_[at(e[1])] - positions_[at(e[0])]);
      if (-found.touch.gap > surface_limit_[at(found.edge)]) continue;
      ContactRow row;
      row.kind = ContactKind::segment;
      row.rows = contact::node_rows(found.touch, length, node, e[0], e[1]);
      row.point = positions_[at(node)];
      row.key = key_of(row.kind, i, at(found.edge));
      row.normal = found.touch.normal;
      row.gap = found.touch.gap;
      row.tributary = 0.5 * s.tributary[i];  // the other side counts its own half
      row.law = s.law;
      rows.push_back(row);
    }
  }
}

}  // namespace rondo::dynamics
