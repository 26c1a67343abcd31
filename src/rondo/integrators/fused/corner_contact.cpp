// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/corner_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Box empty_box() noexcept {
  return {{infinity, infinity}, {-infinity, -infinity}};
}

void include(Box& box, Vec2 x) noexcept {
  box.low = {std::min(box.low.x, x.x), std::min(box.low.y, x.y)};
  box.high = {std::max(box.high.x, x.x), std::max(box.high.y, x.y)};
}

Box widened(const Box& box, double by) noexcept {
  return {box.low - Vec2{by, by}, box.high + Vec2{by, by}};
}

bool overlap(const Box& a, const Box& b) noexcept {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// (n) place of each node among the candidates, -1: it is none.
std::vector<int> places(const Model& model) {
  std::vector<int> place(model.n_nodes(), -1);
  const std::vector<int>& nodes = model.contact->nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) place[at(nodes[i])] = static_cast<int>(i);
  return place;
}

Model boundary_of(const Model& model) {
  RONDO_DEMAND(has_sharp_corners(model) && model.free_bodies.empty());
  Model b;
  b.contact = model.contact;
  b.coupled = model.coupled;
  b.motion = model.motion;
  b.rim = model.rim;
  b.scheme = model.scheme;
  b.mass_damping = model.mass_damping;
  b.dt = model.dt;
  std::vector<int>& nodes = b.contact->nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    b.reference.push_back(model.reference[at(nodes[i])]);
    b.mass.push_back(model.mass[at(nodes[i])]);
    if (!model.body.empty()) b.body.push_back(model.body[at(nodes[i])]);
    nodes[i] = static_cast<int>(i);
  }
  RONDO_DEMAND(b.dt > 0.0 && b.contact->tributary.size() == nodes.size(), b.dt,
               b.contact->tributary.size(), nodes.size());
  const std::vector<int> place = places(model);
  for (mesh::Edge& edge : b.contact->edges)
    for (int& node : edge) {
      node = place[at(node)];
      RONDO_DEMAND(node >= 0);
    }
  return b;
}

std::vector<std::vector<NodalLoad>> loads_of(const Model& model) {
  std::vector<std::vector<NodalLoad>> loads;
  if (model.pressures.empty()) return loads;
  loads.resize(model.contact->nodes.size());
  const std::vector<int> place = places(model);
  for (const NodalLoad& l : nodal_loads(model))
    if (place[at(l.node)] >= 0) loads[at(place[at(l.node)])].push_back(l);
  return loads;
}

}  // namespace

CornerContact::CornerContact(const Model& model)
    : boundary_(boundary_of(model)),
      state_(boundary_),
      contact_(boundary_),
      begin_(boundary_.n_nodes()),
      edge_boxes_(boundary_.contact->edges.size()),
      wanted_(boundary_.n_nodes()),
      is_held_(boundary_.n_nodes()),
      load_of_(loads_of(model)) {}

/// A touch is half an edge deep at the most. A node is not missed if it moves no more than twice as
/// fast as the fastest candidate now, or two edges in the batch (a wave passes some 16 edges).
/// Impacts are as fast as the corner is in the co-rotating frame, whose path counts besides.
/// unseen() tells whether it was so.
CornerContact::Extent CornerContact::extent(std::size_t n_steps,
                                            const CandidateFields& fields) noexcept {
  double farthest = 0.0, fastest = 0.0;
  for (std::size_t k = 0; k < boundary_.n_nodes(); ++k) {
    const CandidateMotion motion = fields.motion_of(k);
    state_.u.plane()[k] = begin_[k] = motion.u;
    const Vec2 arm = boundary_.reference[k] + motion.u;
    farthest = std::max(farthest, dot(arm, arm));
    fastest = std::max(fastest, dot(motion.v, motion.v));
  }
  farthest = std::sqrt(farthest);
  fastest = std::sqrt(fastest);
  const double time = static_cast<double>(n_steps) * boundary_.dt;
  const double touch = contact_.finder().deepest();
  way_ = 4.0 * touch + 2.0 * time * fastest;
  farthest_ = farthest;
  return {touch + way_ + boundary_.contact->ground.bend_reach(), farthest};
}

void CornerContact::look_out(std::span<StepContext> steps, const CandidateFields& fields) noexcept {
  RONDO_ASSERT(!steps.empty(), boundary_.n_nodes());
  const bool was_near = any_near();
  n_near_ = 0;
  for (const int node : nodes_) wanted_[at(node)] = 0;
  nodes_.clear();
  const Extent e = extent(steps.size(), fields);
  Box centers = empty_box();
  for (const StepContext& step : steps) include(centers, step.frame.center.plane());
  const Box around = around_ = widened(centers, e.farthest + e.reach);
  const contact::Ground& ground = boundary_.contact->ground;
  const auto corners = ground.corners(around.low.x, around.high.x);
  if (!corners.empty()) set_edge_boxes();
  for (const contact::Corner& c : corners)
    if (c.position.y >= around.low.y && c.position.y <= around.high.y)
      look_at(static_cast<std::size_t>(&c - ground.corners().data()), steps, e);
  for (StepContext& step : steps) step.held = any_near() ? is_held_.data() : nullptr;
  if (any_near() || !was_near) return;
  release();
  contact_.coupled().kept.clear();
}

double CornerContact::unseen(const CandidateFields& fields, double astray) const noexcept {
  double squared = 0.0;
  for (std::size_t k = 0; k < boundary_.n_nodes(); ++k) {
    const Vec2 way = fields.motion_of(k).u - begin_[k];
    squared = std::max(squared, dot(way, way));
  }
  const double moved = std::sqrt(squared) + astray;
  if (!(moved > way_)) return 0.0;
  const Box within = widened(around_, moved);
  const auto corners = boundary_.contact->ground.corners(within.low.x, within.high.x);
  return std::ranges::any_of(corners,
                             [&](const auto& c) {
                               return overlap({c.position, c.position}, within);
                             })
             ? moved
             : 0.0;
}

/// Looks in the co-rotating frame, where the corner moves and the boundary is nearly at rest.
void CornerContact::look_at(std::size_t corner, std::span<const StepContext> steps,
                            const Extent& e) {
  const Vec2 position = boundary_.contact->ground.corners()[corner].position;
  Box path = empty_box();
  double length = 0.0, nearest = infinity;
  Vec2 last;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const FrameStep& frame = steps[i].frame;
    const Vec2 place = conj(frame.rotation) * (position - frame.center.plane());
    if (i > 0) length += norm(place - last);
    last = place;
    nearest = std::min(nearest, norm(place));
    include(path, place);
  }
  if (nearest <= e.farthest + e.reach + length) add_near(corner, widened(path, e.reach + length));
}

void CornerContact::set_edge_boxes() noexcept {
  const std::vector<mesh::Edge>& edges = boundary_.contact->edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    edge_boxes_[i] = empty_box();
    for (const int node : edges[i])
      include(edge_boxes_[i], boundary_.reference[at(node)] + state_.u.plane()[at(node)]);
  }
}

void CornerContact::add_near(std::size_t corner, const Box& box) {
  if (near_.size() == n_near_) near_.emplace_back();
  NearCorner& near = near_[n_near_];
  near.corner = corner;
  near.edges.clear();
  for (std::size_t i = 0; i < edge_boxes_.size(); ++i)
    if (overlap(edge_boxes_[i], box)) near.edges.push_back(static_cast<int>(i));
  if (near.edges.empty()) return;
  ++n_near_;
  for (const int edge : near.edges) want(edge, 2);
}

/// A touch is judged by an edge's neighbours too, and a touch of the neighbour by its own.
void CornerContact::want(int edge, int layers) {
  for (const int node : boundary_.contact->edges[at(edge)])
    if (!std::exchange(wanted_[at(node)], char{1})) nodes_.push_back(node);
  if (layers == 0) return;
  for (const int beside : contact_.finder().ground_side().beside[at(edge)])
    if (beside >= 0) want(beside, layers - 1);
}

void CornerContact::release() noexcept {
  for (const Held& h : held_) is_held_[h.candidate] = 0;
  held_.clear();
  state_.active.clear();
}

void CornerContact::find(const StepContext& step, const CandidateFields& fields) noexcept {
  release();
  state_.frame = step.frame;
  for (const int node : nodes_) state_.u.plane()[at(node)] = fields.motion_of(at(node)).u;
  for (const ContactRow& row :
       contact_.find_at_corners(state_, std::span(near_).first(n_near_), nodes_))
    for (int i = 0; i < row.rows.count; ++i) {
      const std::size_t k = at(row.rows.node[at(i)]);
      if (std::exchange(is_held_[k], char{1})) continue;
      const CandidateMotion motion = fields.motion_of(k);
      const Complex back{step.wheel.back_x, step.wheel.back_y};  // 0 but with a loaded rim
      state_.v.plane()[k] = motion.v + back * motion.v;
      held_.push_back(
          {k, {.change = motion.force, .load = load_on(step, k), .moved = motion.moved}});
    }
}

void CornerContact::solve(const StepContext& step, CandidateFields& fields,
                          PartialStep& part) noexcept {
  part = {};
  if (held_.empty()) return contact_.coupled().kept.clear();
  for (Held& h : held_) {
    RONDO_ASSERT(is_held_[h.candidate] != 0, h.candidate);  // since find()
    const CandidateMotion motion = fields.motion_of(h.candidate);
    state_.v_next.plane()[h.candidate] = h.free = motion.v;
    h.forces.change = motion.force - h.forces.change;
    h.forces.elastic = motion.force;
    h.forces.internal = motion.internal;
  }
  const VelocityUpdate update =
      velocity_update(boundary_.scheme, boundary_.dt, boundary_.mass_damping, step.frame.spin);
  const BodyFrames frames({step.frame, update, *step.contact});
  part.contact = contact_.solve_found(frames, step.frame.center.plane(), state_);
  for (const Held& h : held_) {
    const std::size_t k = h.candidate;
    const Vec2 after = state_.v_next.plane()[k];
    const ContactNode node{k,
                           boundary_.mass[k],
                           boundary_.contact->tributary[k],
                           boundary_.reference[k] + state_.u.plane()[k],
                           state_.v.plane()[k],
                           h.free};
    fields.move(k, after, state_.u.plane()[k] + boundary_.dt * after);
    if (boundary_.rim)
      correct_wheel_sums(node, after, h.forces, part.sums);
    else
      correct_sums(step, node, after, h.forces, part.sums);
  }
}

Vec2 CornerContact::load_on(const StepContext& step, std::size_t candidate) const noexcept {
  Vec2 load;
  if (load_of_.empty()) return load;
  RONDO_ASSERT(candidate < load_of_.size() && step.pressures, candidate, load_of_.size());
  for (const NodalLoad& l : load_of_[candidate]) load += step.pressures[l.load] * l.force;
  return load;
}

void CornerContact::save_active(std::vector<ActiveContact>& active) const {
  active.insert(active.end(), state_.active.begin(), state_.active.end());
}

}  // namespace rondo::dynamics
