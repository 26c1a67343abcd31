// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/corners/solid_corner_contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/friction_work.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::dynamics {

SolidCornerContact::SolidCornerContact(const Model& model)
    : HeldContact(model), solver_(boundary_), ground_(model.motion.camber) {}

Vec3 SolidCornerContact::place_of(const FrameStep& frame, std::size_t candidate) const noexcept {
  const Vec3 arm = reference_at(candidate) + state_.u.space()[candidate];
  return frame.center + ground_.from_wheel(frame.rotation * arm);
}

/// Way of a point of the boundary that does not deform, at the most                          [m]
double SolidCornerContact::travel(std::span<const StepContext> steps) const noexcept {
  double way = 0.0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const FrameStep &last = steps[i - 1].frame, &next = steps[i].frame;
    way += norm(next.center - last.center) + std::abs(next.angle - last.angle) * farthest();
  }
  return way;
}

void SolidCornerContact::look_out(std::span<StepContext> steps,
                                  const CandidateFields& fields) noexcept {
  RONDO_ASSERT(!steps.empty(), boundary_.n_nodes());
  if (!any_near() && is_far(steps)) {
    for (StepContext& step : steps) step.held = nullptr;
    return;
  }
  const bool was_near = any_near();
  near_.clear();
  forget_nodes();
  CornerFinder& finder = solver_.finder();
  const double reach = reach_of(steps.size(), fields, finder.deepest());
  look_around(steps, reach);
  if (is_beside_corner()) {
    for (std::size_t k = 0; k < boundary_.n_nodes(); ++k)
      finder.set_place(static_cast<int>(k), place_of(steps.front().frame, k));
    finder.find_near(reach + travel(steps), near_);
    // A touch is judged by an edge's neighbours too, and a touch of the neighbour by its own.
    for (const CornerFinder::Near& near : near_) want(finder.edges().boundary, near.edge, 2);
  }
  for (StepContext& step : steps) step.held = any_near() ? is_held_.data() : nullptr;
  if (any_near() || !was_near) return;
  release();
  kept_.clear();
}

void SolidCornerContact::release() noexcept {
  for (const Held& h : held_) is_held_[h.candidate] = 0;
  held_.clear();
  state_.active.clear();
}

void SolidCornerContact::find(const StepContext& step, const CandidateFields& fields) noexcept {
  release();
  state_.frame = step.frame;
  CornerFinder& finder = solver_.finder();
  for (const int node : nodes_) {
    state_.u.space()[at(node)] = fields.motion_of(at(node)).u;
    finder.set_place(node, place_in_space(*step.solid_contact,
                                          reference_at(at(node)) + state_.u.space()[at(node)]));
  }
  for (const CornerRow& row : solver_.find(near_))
    for (int i = 0; i < row.count; ++i) hold(step, fields, at(row.node[at(i)]));
}

void SolidCornerContact::hold(const StepContext& step, const CandidateFields& fields,
                              std::size_t k) {
  if (std::exchange(is_held_[k], char{1})) return;
  const CandidateMotion motion = fields.motion_of(k);
  const Complex back{step.wheel.back_x, step.wheel.back_y};  // 0 but with a loaded rim
  state_.v.space()[k] = motion.v + Vec3(back * motion.v.plane());
  held_.push_back({k,
                   {.change = motion.force,
                    .load = fields.pressed_by(step, k),
                    .elastic = {},
                    .internal = {},
                    .moved = motion.moved}});
}

void SolidCornerContact::keep_impulses() {
  kept_.clear();
  solver_.add_impulses_to(kept_);
  std::ranges::sort(kept_, {}, [](const auto& k) { return k.first; });
}

void SolidCornerContact::solve(const StepContext& step, CandidateFields& fields,
                               PartialStep& part) noexcept {
  part = {};
  if (held_.empty()) return keep_impulses();
  for (Held& h : held_) {
    const CandidateMotion motion = fields.motion_of(h.candidate);
    state_.v_next.space()[h.candidate] = h.free = motion.v;
    h.forces.change = motion.force - h.forces.change;
    h.forces.elastic = motion.force;
    h.forces.internal = motion.internal;
  }
  solver_.solve(*step.solid_contact, kept_, state_, part.contact);
  if (boundary_.friction_work) boundary_.friction_work->add(boundary_, state_);
  keep_impulses();
  for (const Held& h : held_) {
    const std::size_t k = h.candidate;
    const Vec3 after = state_.v_next.space()[k], u = state_.u.space()[k];
    const SolidContactNode node{k,
                                boundary_.mass[k],
                                boundary_.contact->tributary[k],
                                reference_at(k) + u,
                                state_.v.space()[k],
                                h.free,
                                {}};
    fields.move(k, after, u + boundary_.dt * after);
    if (boundary_.rim)
      correct_wheel_sums({1.0, 0.0}, node, after, h.forces, part.sums);
    else
      correct_sums(step, {1.0, 0.0}, node, after, h.forces, part.sums);
  }
}

}  // namespace rondo::dynamics
