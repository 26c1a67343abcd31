// SPDX-License-Identifier: BSD-3-Clause
/// Contacts of a chunk's nodes with the ground.
#include <array>
#include <span>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/fused/solid/solid_chunk.hpp"

namespace rondo::dynamics {

void SolidChunk::find_touching(const Work& work, int row) noexcept {
  const kernels::SolidRow& r = plan_.rows[static_cast<std::size_t>(row)];
  const SolidContactStep& contact = *work.step->solid_contact;
  const contact::Ground& ground = model_.contact->ground;
  const Complex rotation = contact.plane.rotation * Complex{r.turn_x, r.turn_y};
  const Vec3 normal = contact.ground.to_wheel({0.0, 1.0, 0.0});
  constexpr double margin = 1e-9;  // m: the nodes found are looked at again, exactly
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
                                    .limit = ground.top() - contact.plane.center.y + margin,
                                    .first = work.extent.first_column,
                                    .last = work.extent.last_column},
                                   low_.data());
  for (int i = 0; i < n; ++i) {
    const int c = low_[static_cast<std::size_t>(i)];
    const Vec3 place = frame(row, c) * arm(row, at(row, work.now, c));
    const contact::Touches touches = ground.touches(place_on_ground(contact, place));
    if (touches.count == 0) continue;
    touching_.push_back({row, c, touches, at(row, field_v, c),
                         plan_.keeps_force ? at(row, field_force, c) : Vec3{}});
  }
}

/// Adds to the sums, which were made with the velocity free of contact, what the impulse changed;
/// all in the frame of the node.
void SolidChunk::correct_sums(const Work& work, const Touching& t, Vec3 free, Vec3 after,
                              StepSums& sums) const noexcept {
  const kernels::SolidRow& row = plan_.rows[static_cast<std::size_t>(t.row)];
  const kernels::StepFactors& f = work.factors.plane;
  const Vec2 pull = conj(frame(t.row, t.column)) * Vec2{f.pull_x, f.pull_y};
  const Vec3 place = arm(t.row, at(t.row, work.now, t.column));
  const Vec3 acceleration(Complex{f.rate_x, f.rate_y} * place.plane() + pull,
                          work.factors.axial_pull);
  const Vec3 change = after - free;
  sums[kernels::sum_frame] += row.mass * dot(change, acceleration);
  sums[kernels::sum_mass] += row.mass * dot(change, after + free + 2.0 * t.v);
  if (plan_.keeps_force)
    sums[kernels::sum_stiffness] += dot(change, at(t.row, field_force, t.column) - t.force);
  if (plan_.faces) sums[kernels::sum_mean_force] += dot(change, at(t.row, field_force, t.column));
  if (!plan_.loads.empty()) sums[kernels::sum_load] += dot(change, load_on(work, t.row));
}

/// Does the same on a loaded rim. The velocities of contacts are turned to the axes of R_{n+1}.
void SolidChunk::correct_wheel_sums(const Work& work, const Touching& t, Vec3 free, Vec3 after,
                                    StepSums& sums) const noexcept {
  const double mass = plan_.rows[static_cast<std::size_t>(t.row)].mass;
  const Vec3 change = after - free, force = at(t.row, field_force, t.column);
  const Vec3 moved = at(t.row, work.now, t.column) - at(t.row, work.next, t.column);
  const Vec3 momentum = mass * (frame(t.row, t.column) * change);
  sums[kernels::wheel_force_after] += dot(force.plane(), change.plane());
  sums[kernels::wheel_force_across] += cross(force.plane(), change.plane());
  sums[kernels::wheel_mass_mean] += mass * dot(moved, change);
  sums[kernels::wheel_change_mean] += dot(force - t.force, change);
  sums[kernels::wheel_momentum_x] += momentum.x;
  sums[kernels::wheel_momentum_y] += momentum.y;
  sums[kernels::wheel_momentum_z] += momentum.z;
  if (!plan_.loads.empty()) sums[kernels::wheel_load] += dot(change, load_on(work, t.row));
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
                              {}};
  std::array<ActiveContact, 2> contacts;
  const std::span active(contacts.data(), static_cast<std::size_t>(t.touches.count));
  ContactReport report;
  const Vec3 after =
      conj(frame) * solve_contacts(*work.step->solid_contact, node, t.touches, active, report);
  put(t.row, field_v, t.column, after);
  if (!plan_.wheel) put(t.row, work.next, t.column, u + model_.dt * after);
  // The neighbour reports the contacts of its own nodes.
  if (!is_own(t.column)) return;
  PartialStep& part = part_of(work.place, t.column);
  if (plan_.wheel)
    correct_wheel_sums(work, t, free, after, part.sums);
  else
    correct_sums(work, t, free, after, part.sums);
  part.contact.add(report);
  if (work.last) active_.insert(active_.end(), active.begin(), active.end());
}

}  // namespace rondo::dynamics
