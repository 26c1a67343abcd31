// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_contacts.hpp"

#include <span>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {

ContactReport solve_solid_contacts(const Model& model, const SolidContactStep& step,
                                   std::span<const Vec3> u, std::span<const Vec3> v,
                                   std::span<Vec3> next,
                                   std::vector<ActiveContact>& active) noexcept {
  ContactReport report;
  active.clear();
  if (!model.contact) return report;
  RONDO_ASSERT(u.size() == model.n_nodes() && v.size() == model.n_nodes() &&
                   next.size() == model.n_nodes() && model.solid,
               u.size(), v.size(), next.size(), model.n_nodes());
  const ContactModel& contact = *model.contact;
  for (std::size_t candidate = 0; candidate < contact.nodes.size(); ++candidate) {
    const auto k = static_cast<std::size_t>(contact.nodes[candidate]);
    const Vec3 arm = Vec3(model.reference[k], model.solid->axial[k]) + u[k];
    const contact::Touches touches = contact.ground.touches(place_on_ground(step, arm));
    if (touches.count == 0) continue;
    const std::size_t first = active.size();
    active.resize(first + static_cast<std::size_t>(touches.count));
    const SolidContactNode node{candidate, model.mass[k], contact.tributary[candidate],
                                arm,       v[k],          next[k]};
    next[k] = solve_contacts(step, node, touches, std::span(active).subspan(first), report);
  }
  return report;
}

}  // namespace rondo::dynamics
