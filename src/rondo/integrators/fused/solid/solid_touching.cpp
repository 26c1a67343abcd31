// SPDX-License-Identifier: BSD-3-Clause
/// Contacts of a chunk's nodes with the ground.
#include <array>
#include <cmath>
#include <span>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/fused/solid/solid_chunk.hpp"
#include "rondo/model/friction_work.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::dynamics {

CandidateMotion SolidChunk::motion_of(CyclicPlace place) const noexcept {
  const int c = place.sector - range_.first;
  RONDO_ASSERT(c >= 0 && c < range_.columns, place.sector, range_.first, range_.columns);
  const Complex axes = frame(place.row, c);
  const Vec3 u = at(place.row, field_now(), c);
  const Vec3 force = plan_.keeps_force ? axes * at(place.row, field_force, c) : Vec3{};
  return {axes * u, axes * at(place.row, field_v, c), force,
          plan_.wheel ? axes * (u - at(place.row, field_next(), c)) : Vec3{},
          plan_.faces ? force : Vec3{}};
}

void SolidChunk::move(CyclicPlace place, Vec3 v, Vec3 u) noexcept {
  const int c = place.sector - range_.first;
  const Complex to_node = conj(frame(place.row, c));
  put(place.row, field_v, c, to_node * v);
  if (plan_.wheel) return;
  put(place.row, field_now(), c, to_node * u);
  if (plan_.cut.halo == Halo::ring)
    wrap(fields(), place.row, field_now());
  else
    give_edges();
}

Vec3 SolidChunk::load_on(const StepContext& step, CyclicPlace place) const noexcept {
  return frame(place.row, place.sector - range_.first) * load_on(step, place.row);
}

void SolidChunk::find_touching(const Work& work, int row) noexcept {
  const kernels::SolidRow& r = plan_.rows[static_cast<std::size_t>(row)];
  const SolidContactStep& contact = *work.step->solid_contact;
  const Complex rotation = contact.plane.rotation * Complex{r.turn_x, r.turn_y};
  const Vec3 normal = contact.ground.to_wheel({0.0, 1.0, 0.0});
  constexpr double margin = 1e-9;  // m: the nodes found are looked at again, exactly
  // No node is farther from the center than this, or the mesh has turned inside out.
  const double reach = 2.0 * std::hypot(r.x, r.y, r.z), x = contact.plane.center.x;
  const double top = top_between(*model_.contact, x - reach, x + reach);
  const int n = table_.low_columns({.u = field(row, work.now),
                                    .stride = plan_.stride,
                                    .x = r.x,
                                    .y = r.y,
                                    .z = r.z,
                                    .turn_x = turn_x(),
                                    .turn_y = turn_y(),
                                    .rotation_x = rotation.re,
                                    .rotation_y = rotation.im,
                                    .normal_y = normal.y,
                                    .normal_z = normal.z,
                                    .limit = top - contact.plane.center.y + margin,
                                    .first = work.extent.first_column,
                                    .last = work.extent.last_column},
                                   low_.data());
  for (int i = 0; i < n; ++i) {
    const int c = low_[static_cast<std::size_t>(i)];
    const Vec3 place = frame(row, c) * arm(row, at(row, work.now, c));
    const contact::SpaceTouches touches =
        touches_in_space(*model_.contact, place_in_space(contact, place));
    if (touches.count == 0) continue;
    if (work.step->held && work.step->held[candidate_at(row, c)]) continue;
    touching_.push_back({row, c, touches, at(row, field_v, c),
                         plan_.keeps_force ? at(row, field_force, c) : Vec3{},
                         kept_impulse(row, c)});
  }
  forget_impulses(row, work.extent);
}

void SolidChunk::solve_node(const Work& work, const Touching& t) noexcept {
  const kernels::SolidRow& row = plan_.rows[static_cast<std::size_t>(t.row)];
  const std::size_t k = candidate_at(t.row, t.column);
  const Complex frame = this->frame(t.row, t.column);
  const Vec3 u = at(t.row, work.now, t.column), free = at(t.row, field_v, t.column);
  const Complex back{work.step->wheel.back_x, work.step->wheel.back_y};
  const Vec3 before = plan_.wheel ? Vec3(t.v.plane() + back * t.v.plane(), t.v.z) : t.v;
  const SolidContactNode node{k,
                              row.mass,
                              model_.contact->tributary[k],
                              frame * arm(t.row, u),
                              frame * before,
                              frame * free,
                              pressures_before(t, model_.contact->tributary[k])};
  std::array<ActiveContact, 2> contacts;
  const std::span active(contacts.data(), static_cast<std::size_t>(t.touches.count));
  ContactReport report;
  const Vec3 after =
      conj(frame) * solve_contacts(*work.step->solid_contact, node, t.touches, active, report);
  put(t.row, field_v, t.column, after);
  if (!plan_.wheel) put(t.row, work.next, t.column, u + model_.dt * after);
  keep_impulse(t, active);
  // The neighbour reports the contacts of its own nodes.
  if (!is_own(t.column)) return;
  PartialStep& part = part_of(work.place, t.column);
  const Vec3 force = plan_.keeps_force ? at(t.row, field_force, t.column) : Vec3{};
  const NodeForcesOf<Vec3> forces{.change = force - t.force,
                                  .load = load_on(*work.step, t.row),
                                  .elastic = force,
                                  .internal = plan_.faces ? force : Vec3{},
                                  .moved = u - at(t.row, work.next, t.column)};
  const SolidContactNode own{k, row.mass, 0.0, arm(t.row, u), before, free, {}};  // in its axes
  if (plan_.wheel)
    correct_wheel_sums(frame, own, after, forces, part.sums);
  else
    correct_sums(*work.step, frame, own, after, forces, part.sums);
  part.contact.add(report);
  if (model_.friction_work) {
    const SolidContactStep& step = *work.step->solid_contact;
    model_.friction_work->add(step.ground.from_wheel(step.plane.rotation * node.arm), active);
  }
  if (work.last) active_.insert(active_.end(), active.begin(), active.end());
}

}  // namespace rondo::dynamics
