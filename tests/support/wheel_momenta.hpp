// SPDX-License-Identifier: BSD-3-Clause
/// @file  Momenta of a wheel, rim and body together, from the state after a step: absolute
/// velocities are those of the half step after it.
#pragma once
#include <cmath>

#include "rondo/model/model.hpp"

namespace rondo::test {

struct WheelMomenta {
  double mass = 0.0;     ///< of rim and body                                          [kg/m]
  Vec2 center;           ///< of mass, at t_{n+1}                                      [m]
  Vec2 linear;           ///< [N·s/m]
  double angular = 0.0;  ///< about the origin of the fixed frame                      [N·s]
};

/// V = ċ + R [(e^{iδ} - 1)(X + u)/Δt + e^{iδ} v⁺]; x_{n+1} × V equals x_{n+2} × V.
inline WheelMomenta wheel_momenta(const dynamics::Model& model, const dynamics::State& state) {
  const dynamics::FrameStep& f = state.frame;
  const double half = std::sin(0.5 * f.turn), spin = std::sin(f.turn) / model.dt;
  const Complex turn{-2.0 * half * half, std::sin(f.turn)};
  WheelMomenta sum;
  const auto add = [&](double mass, Vec2 place, Vec2 velocity) {
    sum.mass += mass;
    sum.center += mass * place;
    sum.linear += mass * velocity;
    sum.angular += mass * cross(place, velocity);
  };
  const Vec2 center = f.center.plane(), of_rim = f.advance.plane() / model.dt;
  add(model.rim->mass, center, of_rim);
  sum.angular += model.rim->inertia * spin;
  for (const int node : model.free) {
    const auto k = static_cast<std::size_t>(node);
    const Vec2 arm = model.reference[k] + state.u.plane()[k], v = state.v_next.plane()[k];
    const Vec2 relative = (turn * arm) / model.dt + v + turn * v;
    add(model.mass[k], center + f.rotation * arm, of_rim + f.rotation * relative);
  }
  sum.center = sum.center / sum.mass;
  return sum;
}

}  // namespace rondo::test
