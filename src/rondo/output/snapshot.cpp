// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/snapshot.hpp"

#include <vector>

namespace rondo::study {
namespace {

/// Of a wheel in three dimensions; the ground is extruded along t2.
void add_lateral(const dynamics::ActiveContact& c, double camber, double dt, ContactForce& to) {
  to.lateral = c.lateral.impulse / dt;
  const Vec3 fixed = dynamics::GroundAxes(camber).to_wheel(to.force_fixed, to.lateral);
  to.force_fixed = fixed.plane();
  to.fixed_axial = fixed.z;
  to.sticks = c.status == contact::Status::stick;
}

/// A node held by two facets is pressed along the frame of the deeper one, listed first.
void take_contacts(const dynamics::Model& model, const dynamics::State& state,
                   std::vector<ContactForce>& contacts) {
  const double dt = model.dt;
  contacts.clear();
  Vec2 normal;
  for (const dynamics::ActiveContact& c : state.active) {
    if (contacts.empty() || c.candidate != contacts.back().candidate) normal = c.normal;
    const Vec2 force = from_frame(c.normal, c.impulse) / dt;
    contacts.push_back({c.candidate, to_frame(normal, force), force, c.on_ground});
    if (model.solid) add_lateral(c, model.motion.camber, dt, contacts.back());
  }
}

}  // namespace

Snapshot& fill_snapshot(const Setup& setup, const dynamics::State& state, Snapshot& s) {
  s.time = state.frame.time;
  const double behind = setup.model.subdomains ? 0.0 : 0.5 * setup.model.dt;
  s.time_velocity = state.step == 0 ? 0.0 : state.frame.time - behind;
  s.angle = state.frame.angle;
  s.angle_velocity = setup.model.rim ? state.frame.angle - 0.5 * state.frame.turn_before
                                     : setup.model.motion.angle(s.time_velocity);
  s.center = state.frame.center;
  s.lateral = state.frame.lateral;
  s.u = state.u;
  s.v = state.v;
  s.axial_u = state.axial_u;
  s.axial_v = state.axial_v;
  s.poses = state.poses;
  take_contacts(setup.model, state, s.contacts);
  return s;
}

}  // namespace rondo::study
