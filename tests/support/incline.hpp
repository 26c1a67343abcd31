// SPDX-License-Identifier: BSD-3-Clause
/// @file  An elastic block with its foot on an incline; gravity increases over many of its periods.
#pragma once
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/blocks.hpp"
#include "support/stepping.hpp"

namespace rondo::test {

/// Its height is a quarter of its width, so that the weight keeps the whole foot in contact at 30°.
struct Incline {
  double angle = 30.0;    ///< down to the right                                      [degrees]
  double friction = 0.3;  ///< [-]
  double scale = 1.0;     ///< width of the block                                     [m]
  double youngs = 1.0e7;  ///< [Pa]
  double gravity = 9.81;  ///< [m/s²]
  double periods = 20.0;  ///< of the ramp

  [[nodiscard]] double radians() const { return angle * std::numbers::pi / 180.0; }
  [[nodiscard]] Vec2 down() const { return direction_at(-radians()); }  ///< along the slope
  [[nodiscard]] double height() const { return 0.25 * scale; }
  /// Approximate period of the first shear wave up and down the block                    [s]
  [[nodiscard]] double period() const {
    return 4.0 * height() / (0.6 * std::sqrt(youngs / 1000.0));
  }
};

inline dynamics::Model incline_model(const Incline& of) {
  mesh::Mesh mesh;
  add_block(mesh, {.corner = {},
                   .width = of.scale,
                   .height = of.height(),
                   .columns = 8,
                   .rows = 4,
                   .turned = -of.radians()});
  const fem::Material rubber{of.youngs, 0.3, 1000.0, fem::Plane::strain};
  // A tenth of the critical damping of the slowest wave: β = 2ζ/ω.
  const double beta = 0.2 * of.period() / (2.0 * std::numbers::pi);
  dynamics::Model model = body_model(mesh, rubber, 0.0, beta, 0.8);
  model.motion.gravity = dynamics::Table({{0.0, 0.0}, {of.periods * of.period(), of.gravity}});
  add_ground(model, mesh, {.profile = {{}, of.scale * of.down()}}, {of.friction, 0.0});
  return model;
}

/// Velocity of the center of mass of the only body, half a step before the state's time [m/s].
inline Vec2 mean_velocity(const dynamics::Model& model, const dynamics::State& state) {
  return momentum(model, state).linear / model.free_bodies[0].mass;
}

/// A block that sticks, after 60 periods: displacements of its foot before and after `steps` more.
struct Stuck {
  std::vector<Vec2> before, after;  ///< (9)                                           [m]
  int sticking = 0;                 ///< smallest number of sticking foot nodes in these steps
};
inline Stuck stick(const Incline& of, long long steps) {
  const dynamics::Model model = incline_model(of);
  const std::vector<Vec2> none(model.n_nodes());
  Stepping run(model, dynamics::start(model, none, none));
  run.advance_to(60.0 * of.period());
  const auto foot = [&] { return to_vector(run.state().u.plane().first(9)); };
  Stuck stuck{foot(), {}, 9};
  run.advance(steps, [&](const dynamics::StepReport& report) {
    stuck.sticking = std::min(stuck.sticking, report.contact.sticking);
  });
  stuck.after = foot();
  return stuck;
}

}  // namespace rondo::test
