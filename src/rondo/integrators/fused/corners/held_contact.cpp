// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/corners/held_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::dynamics {

namespace {

Model boundary_of(const Model& model) {
  RONDO_DEMAND(has_sharp_corners(model) && model.free_bodies.empty());
  Model b;
  b.contact = model.contact;
  b.coupled = model.coupled;
  b.friction_work = model.friction_work;
  b.motion = model.motion;
  b.rim = model.rim;
  b.scheme = model.scheme;
  b.mass_damping = model.mass_damping;
  b.dt = model.dt;
  if (model.solid) b.solid.emplace();
  std::vector<int>& nodes = b.contact->nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    b.reference.push_back(model.reference[at(nodes[i])]);
    b.mass.push_back(model.mass[at(nodes[i])]);
    if (model.solid) b.solid->axial.push_back(model.solid->axial[at(nodes[i])]);
    if (!model.body.empty()) b.body.push_back(model.body[at(nodes[i])]);
    nodes[i] = static_cast<int>(i);
  }
  RONDO_DEMAND(b.dt > 0.0 && b.contact->tributary.size() == nodes.size(), b.dt,
               b.contact->tributary.size(), nodes.size());
  const std::vector<int> place = places_among(model.contact->nodes, model.n_nodes());
  for (mesh::Edge& edge : b.contact->edges)
    for (int& node : edge) {
      node = place[at(node)];
      RONDO_DEMAND(node >= 0);
    }
  return b;
}

/// Batches for which a look from afar holds.
constexpr int batches_between_looks = 64;

/// With several profiles each point counts its height from the others: the center from those below
/// it, which are not those below the boundary.
void forget_heights(Box& box) noexcept {
  box.low.y = -std::numeric_limits<double>::infinity();
  box.high.y = std::numeric_limits<double>::infinity();
}

bool has_corner_within(const contact::Ground& ground, const Box& box) noexcept {
  return std::ranges::any_of(ground.corners(box.low.x, box.high.x), [&](const contact::Corner& c) {
    return c.position.x >= box.low.x && c.position.x <= box.high.x && c.position.y >= box.low.y &&
           c.position.y <= box.high.y;
  });
}

}  // namespace

HeldContact::HeldContact(const Model& model)
    : boundary_(boundary_of(model)),
      state_(boundary_),
      begin_(boundary_.n_nodes()),
      around_(profile_count(*boundary_.contact)),
      wanted_(boundary_.n_nodes()),
      is_held_(boundary_.n_nodes()) {
  for (std::size_t set = 0; set < around_.size(); ++set)
    bend_reach_ = std::max(bend_reach_, profile_of(*boundary_.contact, set).bend_reach());
}

/// A touch is half an edge deep at the most. A node is not missed if it moves no more than twice as
/// fast as the fastest candidate now, or two edges in the batch (a wave passes some 16 edges).
/// Impacts are as fast as the corner is in the co-rotating frame, whose path counts besides.
/// unseen() tells whether it was so.
double HeldContact::reach_of(std::size_t n_steps, const CandidateFields& fields,
                             double touch) noexcept {
  double farthest = 0.0, fastest = 0.0;
  for (std::size_t k = 0; k < boundary_.n_nodes(); ++k) {
    const CandidateMotion motion = fields.motion_of(k);
    begin_[k] = motion.u;
    if (boundary_.solid)
      state_.u.space()[k] = motion.u;
    else
      state_.u.plane()[k] = motion.u.plane();
    const Vec3 arm = reference_at(k) + motion.u;
    farthest = std::max(farthest, dot(arm, arm));
    fastest = std::max(fastest, dot(motion.v, motion.v));
  }
  farthest_ = std::sqrt(farthest);
  const double time = static_cast<double>(n_steps) * boundary_.dt;
  way_ = 4.0 * touch + 2.0 * time * std::sqrt(fastest);
  batches_left_ = batches_between_looks;
  far_ = farthest_ + 5.0 * touch + bend_reach_ +
         2.0 * batches_between_looks * time * std::sqrt(fastest);
  looked_ = true;
  return touch + way_ + bend_reach_;
}

bool HeldContact::is_far(std::span<const StepContext> steps) noexcept {
  looked_ = false;
  if (batches_left_ == 0) return false;
  --batches_left_;
  look_around(steps, far_ - farthest_);
  return !has_corner_around(0.0);
}

bool HeldContact::has_corner_around(double wider) const noexcept {
  const Vec2 by{wider, wider};
  for (std::size_t set = 0; set < around_.size(); ++set)
    if (has_corner_within(profile_of(*boundary_.contact, set),
                          {around_[set].low - by, around_[set].high + by}))
      return true;
  return false;
}

bool HeldContact::is_beside_corner() const noexcept {
  for (std::size_t set = 0; set < around_.size(); ++set)
    if (!profile_of(*boundary_.contact, set)
             .corners(around_[set].low.x, around_[set].high.x)
             .empty())
      return true;
  return false;
}

void HeldContact::look_around(std::span<const StepContext> steps, double reach) noexcept {
  RONDO_ASSERT(!steps.empty(), boundary_.n_nodes());
  const Vec2 by{farthest_ + reach, farthest_ + reach};
  for (std::size_t set = 0; set < around_.size(); ++set) {
    const Vec2 first = on_profile(*boundary_.contact, set, steps.front().frame.center);
    Box box{first, first};
    for (const StepContext& step : steps) {
      const Vec2 x = on_profile(*boundary_.contact, set, step.frame.center);
      box.low = {std::min(box.low.x, x.x), std::min(box.low.y, x.y)};
      box.high = {std::max(box.high.x, x.x), std::max(box.high.y, x.y)};
    }
    around_[set] = {box.low - by, box.high + by};
    if (around_.size() > 1) forget_heights(around_[set]);
  }
}

double HeldContact::unseen(const CandidateFields& fields, double astray) const noexcept {
  if (!looked_) return 0.0;
  double squared = 0.0;
  for (std::size_t k = 0; k < boundary_.n_nodes(); ++k) {
    const Vec3 way = fields.motion_of(k).u - begin_[k];
    squared = std::max(squared, dot(way, way));
  }
  const double moved = std::sqrt(squared) + astray;
  if (!(moved > way_)) return 0.0;
  return has_corner_around(moved) ? moved : 0.0;
}

void HeldContact::want(const contact::Boundary& boundary, int edge, int layers) {
  for (const int node : boundary.edges[at(edge)])
    if (!std::exchange(wanted_[at(node)], char{1})) nodes_.push_back(node);
  if (layers == 0) return;
  for (const int beside : boundary.beside[at(edge)])
    if (beside >= 0) want(boundary, beside, layers - 1);
}

void HeldContact::forget_nodes() noexcept {
  for (const int node : nodes_) wanted_[at(node)] = 0;
  nodes_.clear();
}

void HeldContact::save_active(std::vector<ActiveContact>& active) const {
  active.insert(active.end(), state_.active.begin(), state_.active.end());
}

}  // namespace rondo::dynamics
