// SPDX-License-Identifier: BSD-3-Clause
/// Contacts of a chunk's nodes with the ground.
#include <array>
#include <span>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/fused/cyclic_chunk.hpp"
#include "rondo/model/friction_work.hpp"

namespace rondo::dynamics {

CandidateMotion CyclicChunk::motion_of(CyclicPlace place, int field_u) const noexcept {
  const int c = place.sector - range_.first;
  RONDO_ASSERT(c >= 0 && c < range_.columns, place.sector, range_.first, range_.columns);
  const Complex frame = turn(c);
  const Vec2 u = at(place.row, field_u, c);
  return {frame * u,
          frame * at(place.row, field_v, c),
          plan_.keeps_force ? frame * at(place.row, field_force, c) : Vec2{},
          plan_.wheel ? frame * (u - at(place.row, field_next(), c)) : Vec2{},
          {}};
}

void CyclicChunk::set_motion(CyclicPlace place, int field_u, Vec2 v, Vec2 u) noexcept {
  const int c = place.sector - range_.first;
  put(place.row, field_v, c, conj(turn(c)) * v);
  if (plan_.wheel) return;
  put(place.row, field_u, c, conj(turn(c)) * u);
  if (plan_.cut.halo == Halo::ring) wrap(fields(), place.row, field_u);
}

CandidateMotion CyclicChunk::motion_of(CyclicPlace place) const noexcept {
  return motion_of(place, field_now());
}

void CyclicChunk::move(CyclicPlace place, Vec2 v, Vec2 u) noexcept {
  set_motion(place, field_now(), v, u);
  if (plan_.cut.halo != Halo::ring && !plan_.wheel) give_edges();
}

void CyclicChunk::find_touching(const Work& work, int a) noexcept {
  const kernels::CyclicRow& row = plan_.rows[static_cast<std::size_t>(a)];
  const ContactStep& contact = *work.step->contact;
  const contact::Ground& ground = model_.contact->ground;
  constexpr double margin = 1e-9;  // m: the nodes found are looked at again, exactly
  const int n = table_.low_columns({.u = field(a, work.now),
                                    .stride = plan_.stride,
                                    .x = row.x,
                                    .y = row.y,
                                    .turn_x = turn_x(),
                                    .turn_y = turn_y(),
                                    .rotation_x = contact.rotation.re,
                                    .rotation_y = contact.rotation.im,
                                    .limit = ground.top() - contact.center.y + margin,
                                    .first = work.extent.first_column,
                                    .last = work.extent.last_column},
                                   low_.data());
  for (int i = 0; i < n; ++i) {
    const int c = low_[static_cast<std::size_t>(i)];
    const Vec2 arm = turn(c) * (Vec2{row.x, row.y} + at(a, work.now, c));
    const contact::Touches touches = ground.touches(contact.center + contact.rotation * arm);
    if (touches.count == 0) continue;
    if (work.step->held && work.step->held[candidate_at(a, c)]) continue;
    touching_.push_back({a, c, touches, at(a, field_v, c),
                         plan_.keeps_force ? at(a, field_force, c) : Vec2{}, kept_impulse(a, c)});
  }
  forget_impulses(a, work.extent);
}

/// Adds to the sums what a contact's impulse changes, and puts the node where it leaves it.
void CyclicChunk::take_impulse(const Work& work, const Touching& t, const ContactNode& node,
                               Vec2 after, StepSums* sums) noexcept {
  const Complex frame = turn(t.column);
  const Vec2 u = at(t.row, work.now, t.column), v = conj(frame) * after;
  put(t.row, field_v, t.column, v);
  if (!plan_.wheel) put(t.row, work.next, t.column, u + model_.dt * v);
  if (!sums) return;
  NodeForces forces{.load = frame * load_on(work, t.row, t.column)};
  if (plan_.keeps_force) forces.change = frame * (at(t.row, field_force, t.column) - t.force);
  if (!plan_.wheel) return correct_sums(*work.step, node, after, forces, *sums);
  forces.elastic = frame * at(t.row, field_force, t.column);
  forces.moved = frame * (u - at(t.row, work.next, t.column));
  correct_wheel_sums(node, after, forces, *sums);
}

void CyclicChunk::solve_node(const Work& work, const Touching& t) noexcept {
  const kernels::CyclicRow& row = plan_.rows[static_cast<std::size_t>(t.row)];
  const std::size_t k = candidate_at(t.row, t.column);
  const Complex frame = turn(t.column);
  const Vec2 u = at(t.row, work.now, t.column);
  const Complex back{work.step->wheel.back_x, work.step->wheel.back_y};
  const Vec2 before = plan_.wheel ? t.v + back * t.v : t.v;
  const ContactNode node{k,
                         row.mass,
                         model_.contact->tributary[k],
                         frame * (Vec2{row.x, row.y} + u),
                         frame * before,
                         frame * at(t.row, field_v, t.column),
                         pressures_before(t, model_.contact->tributary[k])};
  std::array<ActiveContact, 2> contacts;
  const std::span active(contacts.data(), static_cast<std::size_t>(t.touches.count));
  ContactReport report;
  const Vec2 after = solve_contacts(*work.step->contact, node, t.touches, active, report);
  keep_impulse(t, active);
  // The neighbour reports the contacts of its own nodes.
  PartialStep* part = is_own(t.column) ? &part_of(work.place, t.column) : nullptr;
  take_impulse(work, t, node, after, part ? &part->sums : nullptr);
  if (!part) return;
  part->contact.add(report);
  if (model_.friction_work)
    model_.friction_work->add(work.step->contact->rotation * node.arm, active);
  if (work.last) active_.insert(active_.end(), active.begin(), active.end());
}

}  // namespace rondo::dynamics
