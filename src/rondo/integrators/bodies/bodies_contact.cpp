// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/bodies/bodies_contact.hpp"

#include <algorithm>

#include "rondo/core/index.hpp"
#include "rondo/model/friction_work.hpp"

namespace rondo::dynamics {

BodiesContact::BodiesContact(const Model& model) : model_(model), contact_(model), state_(model) {}

std::span<TouchingNode> BodiesContact::find(const FrameStep& frame) {
  state_.frame = frame;
  touching_.clear();
  for (const ContactRow& row : contact_.find(state_))
    for (int i = 0; i < row.rows.count; ++i)
      touching_.push_back({.node = row.rows.node[at(i)], .before = {}, .free = {}, .after = {}});
  std::ranges::sort(touching_, {}, &TouchingNode::node);
  const auto same = [](const TouchingNode& a, const TouchingNode& b) { return a.node == b.node; };
  touching_.erase(std::unique(touching_.begin(), touching_.end(), same), touching_.end());
  return touching_;
}

ContactReport BodiesContact::solve(const BodyFrames& frames, Vec2 center) {
  for (const TouchingNode& t : touching_) {
    state_.v.plane()[at(t.node)] = t.before;
    state_.v_next.plane()[at(t.node)] = t.free;
  }
  const ContactReport report = contact_.solve_found(frames, center, state_);
  if (model_.friction_work) model_.friction_work->add(model_, state_);
  for (TouchingNode& t : touching_) t.after = state_.v_next.plane()[at(t.node)];
  return report;
}

}  // namespace rondo::dynamics
