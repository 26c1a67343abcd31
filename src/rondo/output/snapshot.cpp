// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/snapshot.hpp"

#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/model/friction_work.hpp"
#include "rondo/output/friction_record.hpp"

namespace rondo::study {
namespace {

/// Components in the frame of a contact, of a force along the axes of the ground.
Vec3 to_frame_of(const dynamics::ActiveContact& c, bool in_space, Vec3 force) {
  return in_space ? c.space.to(force) : Vec3(to_frame(c.normal, force.plane()));
}

/// The force of a contact along the axes of the ground.
Vec3 force_of(const dynamics::ActiveContact& c, bool in_space, double dt) {
  return in_space ? c.space.from(c.impulse) / dt
                  : Vec3(from_frame(c.normal, c.impulse.plane()) / dt);
}

/// A node that touches two facets is given in the frame of the deeper one, which is listed first.
void take_contacts(const dynamics::Model& model, const dynamics::State& state,
                   std::vector<ContactForce>& contacts) {
  const GroundFrame ground(model.motion.camber);
  RONDO_DEMAND(state.active.empty() || has_candidates(model), state.active.size());
  contacts.clear();
  const bool in_space = model.solid.has_value();
  const dynamics::ActiveContact* first = nullptr;
  for (const dynamics::ActiveContact& c : state.active) {
    if (!first || c.candidate != first->candidate) first = &c;
    const Vec3 force = force_of(c, in_space, model.dt);
    contacts.push_back({.candidate = c.candidate,
                        .force = to_frame_of(*first, in_space, force),
                        .force_fixed = ground.to_wheel(force),
                        .on_ground = c.on_ground,
                        .sticks = in_space && c.status == contact::Status::stick,
                        .power = dynamics::friction_work_of(c) / model.dt});
  }
}

}  // namespace

Snapshot& fill_snapshot(const Setup& setup, const dynamics::State& state, Snapshot& s) {
  RONDO_DEMAND(state.u.size() == setup.model.n_nodes() && state.v.size() == setup.model.n_nodes() &&
                   state.u.components() == setup.model.components(),
               state.u.size(), state.v.size(), state.u.components(), setup.model.n_nodes());
  RONDO_DEMAND(state.step >= 0 && setup.model.dt > 0.0, state.step, setup.model.dt);
  s.time = state.frame.time;
  const double behind = setup.model.subdomains ? 0.0 : 0.5 * setup.model.dt;
  s.time_velocity = state.step == 0 ? 0.0 : state.frame.time - behind;
  s.angle = state.frame.angle;
  s.angle_velocity = setup.model.rim ? state.frame.angle - 0.5 * state.frame.turn_before
                                     : setup.model.motion.angle(s.time_velocity);
  s.center = state.frame.center;
  s.u = state.u;
  s.v = state.v;
  s.poses = state.poses;
  take_contacts(setup.model, state, s.contacts);
  s.series.clear();
  append_friction_work(setup.model, s.series);
  return s;
}

}  // namespace rondo::study
