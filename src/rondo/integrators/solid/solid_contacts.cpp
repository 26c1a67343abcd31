// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_contacts.hpp"

#include <span>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {

SolidContacts::SolidContacts(const Model& model) : model_(model) {
  if (!model.contact) return;
  const std::size_t most = 2 * model.contact->nodes.size();
  active_.reserve(most);
  if (!has_friction_law(model)) return;
  kept_.reserve(most);
  before_.reserve(most);
}

ContactReport SolidContacts::solve(const SolidContactStep& step, std::span<const Vec3> u,
                                   std::span<const Vec3> v, std::span<Vec3> next) noexcept {
  ContactReport report;
  active_.clear();
  if (!model_.contact) return report;
  RONDO_ASSERT(u.size() == model_.n_nodes() && v.size() == model_.n_nodes() &&
                   next.size() == model_.n_nodes() && model_.solid,
               u.size(), v.size(), next.size(), model_.n_nodes());
  const ContactModel& contact = *model_.contact;
  const bool asks = !contact.law.friction.is_constant();
  std::swap(before_, kept_);
  kept_.clear();
  for (std::size_t candidate = 0; candidate < contact.nodes.size(); ++candidate) {
    const auto k = static_cast<std::size_t>(contact.nodes[candidate]);
    const Vec3 arm = Vec3(model_.reference[k], model_.solid->axial[k]) + u[k];
    const contact::Touches touches = contact.ground.touches(place_on_ground(step, arm));
    if (touches.count == 0) continue;
    const std::size_t first = active_.size(), count = static_cast<std::size_t>(touches.count);
    active_.resize(first + count);
    const std::span active = std::span(active_).subspan(first);
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
