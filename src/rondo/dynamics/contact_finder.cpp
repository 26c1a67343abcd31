// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/contact_finder.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "rondo/contact/node_to_segment.hpp"

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

double shortest_edge(const Model& model, const std::vector<mesh::Edge>& edges) noexcept {
  double shortest = std::numeric_limits<double>::infinity();
  for (const mesh::Edge& e : edges)
    shortest = std::min(shortest, norm(model.reference[at(e[1])] - model.reference[at(e[0])]));
  return shortest;
}

}  // namespace

ContactFinder::ContactFinder(const Model& model)
    : model_(model), positions_(model.n_nodes()), outward_(model.surfaces ? model.n_nodes() : 0) {
  if (model.contact && !model.contact->ground.corners().empty())
    ground_side_ = contact::make_boundary(model.contact->edges, model.body);
  all_edges_.resize(ground_side_.edges.size());
  std::iota(all_edges_.begin(), all_edges_.end(), 0);
  if (model.surfaces) surface_ = contact::make_boundary(model.surfaces->edges, model.body);
  // A point half an edge deep is in the body, not at its boundary.
  deepest_ = 0.5 * std::min(shortest_edge(model, ground_side_.edges),
                            shortest_edge(model, surface_.edges));
}

void ContactFinder::find(const State& state, std::vector<ContactRow>& rows) {
  rows.clear();
  for (std::size_t k = 0; k < positions_.size(); ++k) positions_[k] = position(model_, state, k);
  if (model_.contact) find_on_ground(rows);
  if (!ground_side_.edges.empty()) find_corners(rows);
  if (model_.surfaces) find_segments(rows);
}

void ContactFinder::find_on_ground(std::vector<ContactRow>& rows) const {
  const ContactModel& contact = *model_.contact;
  for (std::size_t i = 0; i < contact.nodes.size(); ++i) {
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
}

void ContactFinder::find_corners(std::vector<ContactRow>& rows) const {
  const auto corners = model_.contact->ground.corners();
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const contact::EdgeTouches touches = contact::touch_boundary(
        {.position = corners[c].position}, {ground_side_, positions_, all_edges_, deepest_});
    for (int t = 0; t < touches.count; ++t) {
      const EdgeTouch& found = touches.at[at(t)];
      const mesh::Edge& e = ground_side_.edges[at(found.edge)];
      ContactRow row;
      row.kind = ContactKind::corner;
      row.rows = contact::corner_rows(
          found.touch, norm(positions_[at(e[1])] - positions_[at(e[0])]), e[0], e[1]);
      row.key = key_of(row.kind, c, at(found.edge));
      row.normal = found.touch.normal;
      row.gap = found.touch.gap;
      row.law = model_.contact->law;
      rows.push_back(row);
    }
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
  if (!s.self && body_of(node) == body_of(at(e[0]))) return false;
  const Vec2 along = positions_[at(e[1])] - positions_[at(e[0])];
  return dot(outward_[node], -turn90(along)) < 0.0;
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
      ContactRow row;
      row.kind = ContactKind::segment;
      row.rows = contact::node_rows(found.touch, norm(positions_[at(e[1])] - positions_[at(e[0])]),
                                    node, e[0], e[1]);
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
