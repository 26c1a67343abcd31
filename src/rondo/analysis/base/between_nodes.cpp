// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/base/between_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/contact/intrusion.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::study {

BetweenNodes::BetweenNodes(const dynamics::Model& model)
    : model_(model), ground_(model.motion.camber) {
  if (!model.contact) return;
  const double spacing = model.contact->ground.spacing();
  if (!(spacing > 0.0)) return;
  for (std::size_t set = 0; set < profile_count(*model.contact); ++set) {
    const contact::Ground& ground = dynamics::profile_of(*model.contact, set);
    watches_ |=
        !ground.bends().empty() && contact::hidden_between_nodes(ground, spacing).deepest.depth >
                                       contact::least_hidden * spacing;
  }
  for (const int node : model.contact->nodes)
    radius_ = std::max(radius_, 1.5 * norm(model.reference[at(node)]));
}

bool BetweenNodes::may_be_deep(const dynamics::FrameStep* frame, long long steps) const noexcept {
  if (!watches_) return false;
  const std::size_t profiles = dynamics::profile_count(*model_.contact);
  if (!frame || !model_.free_bodies.empty() || profiles > 1) return true;
  const contact::Ground& ground = model_.contact->ground;
  const double way = 2.0 * static_cast<double>(steps) * norm(frame->advance);
  const double reach = radius_ + way + ground.bend_reach();
  const Vec2 center = dynamics::on_profile(*model_.contact, frame->center);
  const auto bends = ground.bends();  // left to right
  auto bend = std::partition_point(bends.begin(), bends.end(), [&](const contact::Corner& k) {
    return k.position.x < center.x - reach;
  });
  for (; bend != bends.end() && bend->position.x <= center.x + reach; ++bend)
    if (std::abs(bend->position.y - center.y) <= reach) return true;
  return false;
}

Vec2 BetweenNodes::place(const dynamics::State& state, std::size_t set, int node) const noexcept {
  const std::size_t k = at(node);
  if (!model_.solid) return position(model_, state, k);
  const Vec3 arm = Vec3(model_.reference[k], model_.solid->axial[k]) + state.u.space()[k];
  return on_profile(*model_.contact, set,
                    state.frame.center + ground_.from_wheel(state.frame.rotation * arm));
}

double BetweenNodes::depth(const dynamics::State& state) const noexcept {
  double deepest = 0.0;
  for (std::size_t set = 0; set < dynamics::profile_count(*model_.contact); ++set) {
    const contact::Ground& ground = dynamics::profile_of(*model_.contact, set);
    for (const auto& [first, second] : model_.contact->edges) {
      const Vec2 a = place(state, set, first), b = place(state, set, second);
      deepest = std::max(deepest, contact::deepest_inside(ground, a, b, norm(b - a)).depth);
    }
  }
  return deepest;
}

}  // namespace rondo::study
