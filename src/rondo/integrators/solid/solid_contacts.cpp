// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_contacts.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/integrators/general/readable_step.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::dynamics {

SolidContacts::SolidContacts(const Model& model) : model_(model) {
  if (has_sharp_corners(model)) {
    corners_.emplace(model);
    is_held_.resize(model.n_nodes());
  }
  if (!model.contact || !has_friction_law(model)) return;
  const std::size_t most = 2 * model.contact->nodes.size();
  kept_.reserve(most);
  before_.reserve(most);
}

ContactReport SolidContacts::solve(const SolidContactStep& step, State& state) noexcept {
  ContactReport report;
  state.active.clear();
  if (!model_.contact) return report;
  RONDO_ASSERT(state.u.size() == model_.n_nodes() && state.v.size() == model_.n_nodes() &&
                   state.v_next.size() == model_.n_nodes() && model_.solid,
               state.u.size(), state.v.size(), state.v_next.size(), model_.n_nodes());
  std::swap(before_, kept_);
  kept_.clear();
  if (corners_) find_at_corners(step, state);
  for (std::size_t i = 0; i < model_.contact->nodes.size(); ++i)
    if (!corners_ || !is_held_[at(model_.contact->nodes[i])]) solve_alone(step, i, state, report);
  if (!corners_) return report;
  corners_->solve(step, before_, state, report);
  corners_->add_impulses_to(kept_);
  std::ranges::sort(kept_, {}, [](const auto& k) { return k.first; });
  sort_by_candidate(state.active);
  return report;
}

void SolidContacts::find_at_corners(const SolidContactStep& step, const State& state) {
  CornerFinder& finder = corners_->finder();
  const std::span u = state.u.space();
  for (const int node : model_.contact->nodes) {
    finder.set_place(node,
                     place_in_space(step, reference_of<Vec3>(model_, at(node)) + u[at(node)]));
    is_held_[at(node)] = 0;
  }
  finder.find_near(finder.deepest() + finder.bend_reach(), near_);
  for (const CornerRow& row : corners_->find(near_))
    for (int i = 0; i < row.count; ++i) is_held_[at(row.node[at(i)])] = 1;
}

void SolidContacts::solve_alone(const SolidContactStep& step, std::size_t candidate, State& state,
                                ContactReport& report) {
  const ContactModel& contact = *model_.contact;
  const std::size_t k = at(contact.nodes[candidate]);
  const Vec3 arm = reference_of<Vec3>(model_, k) + state.u.space()[k];
  const contact::SpaceTouches touches = touches_in_space(contact, place_in_space(step, arm));
  if (touches.count == 0) return;
  const bool asks = !contact.law.friction.is_constant();
  const std::size_t first = state.active.size(), count = at(touches.count);
  state.active.resize(first + count);
  const std::span active = std::span(state.active).subspan(first);
  SolidContactNode node{candidate, model_.mass[k],     contact.tributary[candidate],
                        arm,       state.v.space()[k], state.v_next.space()[k],
                        {}};
  for (std::size_t i = 0; asks && i < count; ++i)
    node.pressure[i] =
        contact::kept_impulse(before_, 2 * candidate + i).x / (model_.dt * node.tributary);
  state.v_next.space()[k] = solve_contacts(step, node, touches, active, report);
  for (std::size_t i = 0; asks && i < count; ++i)
    kept_.emplace_back(2 * candidate + i, active[i].impulse.plane());
}

}  // namespace rondo::dynamics
