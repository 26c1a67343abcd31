// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_contacts.hpp"

#include <span>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/integrators/general/readable_step.hpp"

namespace rondo::dynamics {

SolidContacts::SolidContacts(const Model& model) : model_(model) {
  if (!model.contact || !has_friction_law(model)) return;
  const std::size_t most = 2 * model.contact->nodes.size();
  kept_.reserve(most);
  before_.reserve(most);
}

ContactReport SolidContacts::solve(const SolidContactStep& step, State& state) noexcept {
  ContactReport report;
  state.active.clear();
  if (!model_.contact) return report;
  const std::span u = state.u.space(), v = state.v.space(), next = state.v_next.space();
  RONDO_ASSERT(u.size() == model_.n_nodes() && v.size() == model_.n_nodes() &&
                   next.size() == model_.n_nodes() && model_.solid,
               u.size(), v.size(), next.size(), model_.n_nodes());
  const ContactModel& contact = *model_.contact;
  const bool asks = !contact.law.friction.is_constant();
  std::swap(before_, kept_);
  kept_.clear();
  for (std::size_t candidate = 0; candidate < contact.nodes.size(); ++candidate) {
    const std::size_t k = at(contact.nodes[candidate]);
    const Vec3 arm = reference_of<Vec3>(model_, k) + u[k];
    const contact::Touches touches = contact.ground.touches(place_on_ground(step, arm));
    if (touches.count == 0) continue;
    const std::size_t first = state.active.size(), count = at(touches.count);
    state.active.resize(first + count);
    const std::span active = std::span(state.active).subspan(first);
    SolidContactNode node{
        candidate, model_.mass[k], contact.tributary[candidate], arm, v[k], next[k], {}};
    for (std::size_t i = 0; asks && i < count; ++i)
      node.pressure[i] =
          contact::kept_impulse(before_, 2 * candidate + i).x / (model_.dt * node.tributary);
    next[k] = solve_contacts(step, node, touches, active, report);
    for (std::size_t i = 0; asks && i < count; ++i)
      kept_.emplace_back(2 * candidate + i, active[i].impulse.plane());
  }
  return report;
}

}  // namespace rondo::dynamics
