// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/corners/corner_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/friction_work.hpp"

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

std::vector<std::vector<NodalLoad>> loads_of(const Model& model) {
  std::vector<std::vector<NodalLoad>> loads;
  if (model.pressures.empty()) return loads;
  loads.resize(model.contact->nodes.size());
  const std::vector<int> place = places_among(model.contact->nodes, model.n_nodes());
  for (const NodalLoad& l : nodal_loads(model))
    if (place[at(l.node)] >= 0) loads[at(place[at(l.node)])].push_back(l);
  return loads;
}

}  // namespace

CornerContact::CornerContact(const Model& model)
    : HeldContact(model),
      contact_(boundary_),
      edge_boxes_(boundary_.contact->edges.size()),
      load_of_(loads_of(model)) {}

void CornerContact::look_out(std::span<StepContext> steps, const CandidateFields& fields) noexcept {
  if (!any_near() && is_far(steps)) {
    for (StepContext& step : steps) step.held = nullptr;
    return;
  }
  const bool was_near = any_near();
  n_near_ = 0;
  forget_nodes();
  const double reach = reach_of(steps.size(), fields, contact_.finder().deepest());
  look_around(steps, reach);
  const contact::Ground& ground = boundary_.contact->ground;
  const auto corners = ground.corners(around().low.x, around().high.x);
  if (!corners.empty()) set_edge_boxes();
  for (const contact::Corner& c : corners)
    if (c.position.y >= around().low.y && c.position.y <= around().high.y)
      look_at(static_cast<std::size_t>(&c - ground.corners().data()), steps, reach);
  for (StepContext& step : steps) step.held = any_near() ? is_held_.data() : nullptr;
  if (any_near() || !was_near) return;
  release();
  kept().clear();
}

/// Looks in the co-rotating frame, where the corner moves and the boundary is nearly at rest.
void CornerContact::look_at(std::size_t corner, std::span<const StepContext> steps, double reach) {
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
  if (nearest <= farthest_ + reach + length) add_near(corner, widened(path, reach + length));
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
  // A touch is judged by an edge's neighbours too, and a touch of the neighbour by its own.
  for (const int edge : near.edges) want(contact_.finder().ground_side(), edge, 2);
}

void CornerContact::release() noexcept {
  for (const Held& h : held_) is_held_[h.candidate] = 0;
  held_.clear();
  state_.active.clear();
}

void CornerContact::find(const StepContext& step, const CandidateFields& fields) noexcept {
  release();
  state_.frame = step.frame;
  for (const int node : nodes_) state_.u.plane()[at(node)] = fields.motion_of(at(node)).u.plane();
  for (const ContactRow& row :
       contact_.find_at_corners(state_, std::span(near_).first(n_near_), nodes_))
    for (int i = 0; i < row.rows.count; ++i) {
      const std::size_t k = at(row.rows.node[at(i)]);
      if (std::exchange(is_held_[k], char{1})) continue;
      const CandidateMotion motion = fields.motion_of(k);
      const Vec2 v = motion.v.plane();
      const Complex back{step.wheel.back_x, step.wheel.back_y};  // 0 but with a loaded rim
      state_.v.plane()[k] = v + back * v;
      held_.push_back({k,
                       {.change = motion.force.plane(),
                        .load = load_on(step, k),
                        .moved = motion.moved.plane()}});
    }
}

void CornerContact::solve(const StepContext& step, CandidateFields& fields,
                          PartialStep& part) noexcept {
  part = {};
  if (held_.empty()) return kept().clear();
  for (Held& h : held_) {
    RONDO_ASSERT(is_held_[h.candidate] != 0, h.candidate);  // since find()
    const CandidateMotion motion = fields.motion_of(h.candidate);
    state_.v_next.plane()[h.candidate] = h.free = motion.v.plane();
    h.forces.change = motion.force.plane() - h.forces.change;
    h.forces.elastic = motion.force.plane();
    h.forces.internal = motion.internal.plane();
  }
  const VelocityUpdate update =
      velocity_update(boundary_.scheme, boundary_.dt, boundary_.mass_damping, step.frame.spin);
  const BodyFrames frames({step.frame, update, *step.contact});
  part.contact = contact_.solve_found(frames, step.frame.center.plane(), state_);
  if (boundary_.friction_work) boundary_.friction_work->add(boundary_, state_);
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

}  // namespace rondo::dynamics
