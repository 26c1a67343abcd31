// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/contact_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "rondo/contact/coupled/node_to_segment.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

using contact::EdgeTouch;

std::uint64_t key_of(ContactKind kind, std::size_t first, std::size_t second) noexcept {
  RONDO_ASSERT(first >> key_bits_of_edge == 0 && second >> key_bits_of_edge == 0, first, second);
  return static_cast<std::uint64_t>(kind) << 62U |
         static_cast<std::uint64_t>(first) << key_bits_of_edge | static_cast<std::uint64_t>(second);
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

contact::Boundary ground_side_of(const Model& model) {
  if (!has_sharp_corners(model)) return {};
  return contact::make_boundary(model.contact->edges, model.body);
}

contact::Boundary surface_of(const Model& model) {
  if (!model.surfaces) return {};
  return contact::make_boundary(model.surfaces->edges, model.body);
}

double largest(const std::vector<double>& limits) noexcept {
  double most = 0.0;
  for (const double limit : limits) most = std::max(most, limit);
  return most;
}

std::vector<int> boundary_of(const Model& model) {
  std::vector<int> nodes;
  const auto add = [&](const std::vector<int>& candidates, const std::vector<mesh::Edge>& edges) {
    nodes.insert(nodes.end(), candidates.begin(), candidates.end());
    for (const mesh::Edge& edge : edges) nodes.insert(nodes.end(), edge.begin(), edge.end());
  };
  if (model.contact) add(model.contact->nodes, model.contact->edges);
  if (model.surfaces) add(model.surfaces->nodes, model.surfaces->edges);
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

ContactFinder::ContactFinder(const Model& model)
    : model_(model),
      ground_side_(ground_side_of(model)),
      surface_(surface_of(model)),
      ground_side_limit_(depth_limits(model, ground_side_)),
      surface_limit_(depth_limits(model, surface_)),
      deepest_(std::max(largest(ground_side_limit_), largest(surface_limit_))),
      boundary_(boundary_of(model)),
      positions_(model.n_nodes()),
      near_edges_(model, surface_, deepest_),
      is_near_(model.n_nodes()) {
  RONDO_DEMAND(!model.contact || model.contact->tributary.size() == model.contact->nodes.size(),
               model.contact->tributary.size(), model.contact->nodes.size());
  RONDO_DEMAND(!model.surfaces || model.surfaces->tributary.size() == model.surfaces->nodes.size(),
               model.surfaces->tributary.size(), model.surfaces->nodes.size());
  if (model.contact && !model.contact->tributary.empty())
    ground_margin_ = std::ranges::min(model.contact->tributary);
  if (!model.surfaces) return;
  first_edge_.assign(model.n_nodes() + 2, 0);  // shifted by one: filling moves each to its place
  for (const mesh::Edge& e : surface_.edges)
    for (const int node : e) ++first_edge_[at(node) + 2];
  std::partial_sum(first_edge_.begin(), first_edge_.end(), first_edge_.begin());
  edges_at_.resize(2 * surface_.edges.size());
  for (std::size_t i = 0; i < surface_.edges.size(); ++i)
    for (const int node : surface_.edges[i])
      edges_at_[at(first_edge_[at(node) + 1]++)] = static_cast<int>(i);
}

std::span<const int> ContactFinder::boundary_after(double travelled) noexcept {
  RONDO_ASSERT(!(travelled < 0.0), travelled);
  slack_ -= travelled;
  near_alone_ = slack_ > 0.0;
  return near_alone_ ? near_nodes_ : boundary_;
}

/// False: some place is none.
bool ContactFinder::set_positions(const State& state) {
  RONDO_ASSERT(state.u.size() == model_.n_nodes(), state.u.size(), model_.n_nodes());
  Vec2 sum;
  for (const int node : near_alone_ ? near_nodes_ : boundary_)
    sum += positions_[at(node)] = position(model_, state, at(node));
  return std::isfinite(sum.x) && std::isfinite(sum.y);
}

void ContactFinder::find(const State& state, std::vector<ContactRow>& rows) {
  rows.clear();
  const bool finite = set_positions(state);
  if (!finite) slack_ = 0.0;
  if (finite && !near_alone_) find_near();
  near_alone_ = false;
  if (!finite) return;  // the ledger will tell
  for (const int i : near_ground_) find_on_ground(at(i), rows);
  if (!ground_side_.edges.empty()) find_corners(rows);
  if (model_.surfaces) find_segments(rows);
}

/// Finds what may touch while no node comes farther than the slack.
void ContactFinder::find_near() {
  // Corners of the ground look at all edges.
  slack_ = ground_side_.edges.empty() ? std::numeric_limits<double>::infinity() : 0.0;
  for (const int node : near_nodes_) is_near_[at(node)] = 0;
  if (model_.contact) find_near_ground();
  if (model_.surfaces) find_near_edges();
  near_nodes_.clear();
  for (const int node : boundary_)
    if (is_near_[at(node)]) near_nodes_.push_back(node);
}

void ContactFinder::find_near_ground() {
  slack_ = std::min(slack_, ground_margin_);
  near_ground_.clear();
  const contact::Ground& ground = model_.contact->ground;
  const std::vector<int>& nodes = model_.contact->nodes;
  const double far = 2.0 * ground_margin_;  // it may come by the margin in x and in y
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec2 x = positions_[at(nodes[i])];
    if (x.y > ground.top() + far || ground.distance(x) > far) continue;
    near_ground_.push_back(static_cast<int>(i));
    is_near_[at(nodes[i])] = 1;
  }
}

/// With their neighbours, which say where a segment ends, and the edges of the candidates.
void ContactFinder::find_near_edges() {
  near_edges_.update(positions_);
  slack_ = std::min(slack_, near_edges_.slack());
  const auto mark = [&](int edge) {
    for (const int node : surface_.edges[at(edge)]) is_near_[at(node)] = 1;
  };
  const std::span<const int> candidates = near_edges_.candidates();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const int node = model_.surfaces->nodes[at(candidates[i])];
    is_near_[at(node)] = 1;
    for (int k = first_edge_[at(node)]; k < first_edge_[at(node) + 1]; ++k) mark(edges_at_[at(k)]);
    for (const int edge : near_edges_.edges_near(i)) {
      mark(edge);
      for (const int beside : surface_.beside[at(edge)])
        if (beside >= 0) mark(beside);
    }
  }
}

void ContactFinder::find_on_ground(std::size_t i, std::vector<ContactRow>& rows) const {
  const ContactModel& contact = *model_.contact;
  const contact::Touches touches = contact.ground.touches(positions_[at(contact.nodes[i])]);
  for (int t = 0; t < touches.count; ++t) {
    const contact::Touch& touch = touches.at[at(t)];
    ContactRow row;
    row.kind = ContactKind::facet;
    row.rows = contact::ground_rows(contact.nodes[i], touch.normal);
    row.point = positions_[at(contact.nodes[i])];
    row.key = key_of(row.kind, i, at(t));
    row.normal = touch.normal;
    row.gap = touch.gap;
    row.tributary = contact.tributary[i];
    row.law = &contact.law;
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

/// A profile may have many corners: each looks at the edges whose boxes it is near, no touch being
/// farther from its segment than `deepest_`.
void ContactFinder::find_corners(std::vector<ContactRow>& rows) {
  Box box = box_of_candidates();
  const contact::Ground& ground = model_.contact->ground;
  const contact::Corner* const first = ground.corners().data();
  const double reach = ground.bend_reach(), far = 1.001 * deepest_ + reach;  // places are rounded
  box = {box.low - Vec2{reach, reach}, box.high + Vec2{reach, reach}};
  corner_edges_.clear();
  if (ground.corners(box.low.x, box.high.x).empty()) return;
  for (std::size_t i = 0; i < ground_side_.edges.size(); ++i) {
    const Vec2 a = positions_[at(ground_side_.edges[i][0])];
    const Vec2 b = positions_[at(ground_side_.edges[i][1])];
    const double low = std::max(std::min(a.y, b.y) - far, box.low.y);
    const double high = std::min(std::max(a.y, b.y) + far, box.high.y);
    for (const contact::Corner& c : ground.corners(std::max(std::min(a.x, b.x) - far, box.low.x),
                                                   std::min(std::max(a.x, b.x) + far, box.high.x)))
      if (c.position.y >= low && c.position.y <= high)
        corner_edges_.emplace_back(static_cast<std::size_t>(&c - first), static_cast<int>(i));
  }
  std::ranges::sort(corner_edges_);
  for (auto of = corner_edges_.begin(); of != corner_edges_.end();) {
    const std::size_t corner = of->first;
    near_corner_.clear();
    for (; of != corner_edges_.end() && of->first == corner; ++of)
      near_corner_.push_back(of->second);
    find_corner(corner, near_corner_, rows);
  }
}

void ContactFinder::find_corner(std::size_t c, std::span<const int> edges,
                                std::vector<ContactRow>& rows) const {
  RONDO_ASSERT(c < model_.contact->ground.corners().size(), c);
  const contact::Corner& corner = model_.contact->ground.corners()[c];
  const Vec2 facing = corner.normals[0] + corner.normals[1];
  const contact::EdgeTouches touches = contact::touch_boundary(
      {.position = corner.position, .bend = &corner}, {ground_side_, positions_, edges, deepest_});
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
    row.point = contact::first_met(corner, -found.touch.normal);
    row.key = key_of(row.kind, c, at(found.edge));
    row.normal = found.touch.normal;
    row.gap = found.touch.gap;
    row.law = &model_.contact->law;
    rows.push_back(row);
  }
}

/// Sum of the normals of a node's edges, out of the body.
Vec2 ContactFinder::outward_of(int node) const {
  RONDO_ASSERT(model_.surfaces && at(node) + 1 < first_edge_.size(), node, first_edge_.size());
  Vec2 sum;
  for (int i = first_edge_[at(node)]; i < first_edge_[at(node) + 1]; ++i) {
    const mesh::Edge& e = surface_.edges[at(edges_at_[at(i)])];
    const Vec2 along = positions_[at(e[1])] - positions_[at(e[0])];
    sum += -turn90(along) / norm(along);
  }
  return sum;
}

void ContactFinder::find_segments(std::vector<ContactRow>& rows) {
  const std::span<const int> candidates = near_edges_.candidates();
  for (std::size_t i = 0; i < candidates.size(); ++i)
    find_touches(at(candidates[i]), near_edges_.edges_near(i), rows);
}

/// Finds the touches of a candidate on the edges near it that face it.
void ContactFinder::find_touches(std::size_t i, std::span<const int> near,
                                 std::vector<ContactRow>& rows) {
  const SurfaceContact& s = *model_.surfaces;
  const int node = s.nodes[i];
  const Vec2 outward = outward_of(node);
  facing_.clear();
  for (const int edge : near) {
    const mesh::Edge& e = surface_.edges[at(edge)];
    const Vec2 along = positions_[at(e[1])] - positions_[at(e[0])];
    if (dot(outward, -turn90(along)) < 0.0) facing_.push_back(edge);
  }
  if (facing_.empty()) return;
  const contact::EdgeTouches touches =
      contact::touch_boundary({positions_[at(node)], node, body_of(node), s.self},
                              {surface_, positions_, facing_, deepest_});
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
    row.law = &s.law;
    rows.push_back(row);
  }
}

}  // namespace rondo::dynamics
