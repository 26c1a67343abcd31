// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/near_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

/// How much farther than the reach edges are looked for, over it. Half of it may then be come by
/// the candidate and half by the edge; a little less, for places are rounded.
constexpr double skin = 2.0, travel = 0.499;
/// With more bodies the grid is asked for all nodes.
constexpr std::size_t most_boxes = 16;

void widen(Box& box, Vec2 x, double by) noexcept {
  box.low = {std::min(box.low.x, x.x - by), std::min(box.low.y, x.y - by)};
  box.high = {std::max(box.high.x, x.x + by), std::max(box.high.y, x.y + by)};
}

bool contains(const Box& box, Vec2 x) noexcept {
  return x.x >= box.low.x && x.x <= box.high.x && x.y >= box.low.y && x.y <= box.high.y;
}

}  // namespace

NearEdges::NearEdges(const Model& model, const contact::Boundary& surface, double reach)
    : model_(model), surface_(surface), reach_(reach) {
  if (!model.surfaces) return;
  RONDO_DEMAND(surface.body.size() == surface.edges.size() &&
                   surface.edges.size() == model.surfaces->edges.size() &&
                   (reach > 0.0 || surface.edges.empty()),
               surface.body.size(), surface.edges.size(), reach);
  boundary_ = model.surfaces->nodes;
  for (const mesh::Edge& edge : surface.edges)
    boundary_.insert(boundary_.end(), edge.begin(), edge.end());
  bodies_ = surface.body;
  for (std::vector<int>* list : {&boundary_, &bodies_}) {
    std::ranges::sort(*list);
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  boxes_.resize(bodies_.size() <= most_boxes && !model.surfaces->self ? bodies_.size() : 0);
}

void NearEdges::update(std::span<const Vec2> positions) {
  RONDO_ASSERT(model_.surfaces && positions.size() == model_.n_nodes(), positions.size());
  if (!holds(positions)) build(positions);
}

/// No node has come too far in x or y.
bool NearEdges::holds(std::span<const Vec2> positions) noexcept {
  if (built_at_.empty()) return false;
  double farthest = 0.0;
  for (std::size_t i = 0; i < boundary_.size(); ++i) {
    const Vec2 moved = positions[at(boundary_[i])] - built_at_[i];
    farthest = std::max({farthest, std::abs(moved.x), std::abs(moved.y)});
  }
  slack_ = travel * skin * reach_ - farthest;
  return slack_ >= 0.0;
}

void NearEdges::build(std::span<const Vec2> positions) {
  slack_ = travel * skin * reach_;
  built_at_.clear();
  for (const int node : boundary_) built_at_.push_back(positions[at(node)]);
  grid_.build(positions, surface_.edges, reach_, skin * reach_);
  find_boxes(positions);
  candidates_.clear();
  edges_.clear();
  start_.assign(1, 0);
  const std::vector<int>& nodes = model_.surfaces->nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int node = nodes[i];
    if (!near_another_body(body_of(node), positions[at(node)])) continue;
    grid_.near(positions[at(node)], near_);
    for (const int edge : near_)
      if (may_touch(node, edge)) edges_.push_back(edge);
    if (static_cast<int>(edges_.size()) == start_.back()) continue;
    candidates_.push_back(static_cast<int>(i));
    start_.push_back(static_cast<int>(edges_.size()));
  }
}

void NearEdges::find_boxes(std::span<const Vec2> positions) {
  if (boxes_.empty()) return;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::ranges::fill(boxes_, Box{{infinity, infinity}, {-infinity, -infinity}});
  for (std::size_t i = 0; i < surface_.edges.size(); ++i) {
    const auto body = std::ranges::lower_bound(bodies_, surface_.body[i]) - bodies_.begin();
    RONDO_ASSERT(static_cast<std::size_t>(body) < boxes_.size(), body, boxes_.size());
    for (const int node : surface_.edges[i])
      widen(boxes_[at(body)], positions[at(node)], (1.0 + skin) * reach_);
  }
}

bool NearEdges::near_another_body(int body, Vec2 x) const noexcept {
  if (boxes_.empty()) return true;
  for (std::size_t b = 0; b < boxes_.size(); ++b)
    if (bodies_[b] != body && contains(boxes_[b], x)) return true;
  return false;
}

/// An edge of another body, or of the same if that is wanted.
bool NearEdges::may_touch(int node, int edge) const noexcept {
  const mesh::Edge& e = surface_.edges[at(edge)];
  if (body_of(node) != body_of(e[0])) return true;
  if (!model_.surfaces->self || e[0] == node || e[1] == node) return false;
  return !across_a_wall(at(node), e);
}

/// The edge is the other side of a wall at the node: undeformed, the node is behind it, and near.
bool NearEdges::across_a_wall(std::size_t node, const mesh::Edge& edge) const noexcept {
  const Vec2 a = model_.reference[at(edge[0])];
  const Vec2 along = model_.reference[at(edge[1])] - a, to = model_.reference[node] - a;
  if (cross(along, to) < 0.0) return false;  // in front: the outward normal is on the right
  const double on = std::clamp(dot(along, to) / dot(along, along), 0.0, 1.0);
  return norm(to - on * along) < norm(along);
}

}  // namespace rondo::dynamics
