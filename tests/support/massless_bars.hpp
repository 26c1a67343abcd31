// SPDX-License-Identifier: BSD-3-Clause
/// @file  The motion of the bars of V2 and V3, whose foot may be massless.
#pragma once
#include <algorithm>
#include <cmath>

#include "support/bars.hpp"

namespace rondo::test {

inline constexpr double period = 16.0 / 3.0;  ///< of V3                                    [s]

struct BarHit {
  double lost = 0.0;         ///< in impacts, relative to the energy at the start
  double scatter = 0.0;      ///< rms of the contact force about ρcv, for .55 < t < 1.12  [N]
  double rebound = 0.0;      ///< velocity of the center of mass after it                  [m/s]
  double relative = 0.0;     ///< residual of the ledger
  double residual = 0.0;     ///< of the law, relative
  double penetration = 0.0;  ///< [m]
};

/// V2: it hits a wall at 10 m/s.
inline BarHit hit(const Bar& bar) {
  constexpr double speed = 10.0, force = 300.0;
  const dynamics::Model model = bar_model(bar);
  const std::vector<Vec2> none(model.n_nodes()), v(model.n_nodes(), Vec2{0.0, -speed});
  Stepping run(model, dynamics::start(model, none, v));
  BarHit out;
  double squares = 0.0, fastest = 0.0;
  int n = 0;
  run.advance_to(1.5, [&](const dynamics::StepReport& step) {
    fastest = std::max(fastest, step.contact.free_velocity);
    out.residual = std::max(out.residual, step.contact.residual);
    out.penetration = std::max(out.penetration, step.contact.penetration);
    if (step.frame.time <= 0.55 || step.frame.time >= 1.12) return;
    squares += std::pow(step.contact.impulse.y / model.dt / bar.width() - force, 2);
    ++n;
  });
  out.lost = run.balance().works.loss_impact / (0.5 * bar.mass() * speed * speed);
  out.scatter = std::sqrt(squares / n);
  out.rebound = momentum(model, run.state()).linear.y / bar.mass();
  out.relative = run.balance().relative;
  out.residual /= fastest;
  return out;
}

struct BarBounce {
  double left = 0.0;      ///< energy left, relative to that of a fall from 5 m
  double relative = 0.0;  ///< residual of the ledger
};

/// V3: it falls by 5 m under gravity and bounces, until the time `end` [s].
inline BarBounce bounce(Bar bar, double end) {
  constexpr double gravity = 10.0;
  bar.gap = 5.0;
  dynamics::Model model = bar_model(bar);
  model.motion.gravity = dynamics::Table(gravity);
  const std::vector<Vec2> none(model.n_nodes());
  double first = 0.0;  // first moment of the masses about the ground, at the start
  for (std::size_t k = 0; k < model.n_nodes(); ++k) first += model.mass[k] * model.reference[k].y;
  Stepping run(model, dynamics::start(model, none, none));
  run.advance_to(end);
  double moment = -first;
  const dynamics::State& s = run.state();
  for (std::size_t k = 0; k < model.n_nodes(); ++k)
    moment += model.mass[k] * (position(model, s, k).y - 0.5 * model.dt * s.v.plane()[k].y);
  const dynamics::Balance& b = run.balance();
  return {1.0 + (b.kinetic + b.strain + gravity * moment) / (bar.mass() * gravity * bar.gap),
          b.relative};
}

}  // namespace rondo::test
