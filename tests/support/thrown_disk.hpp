// SPDX-License-Identifier: BSD-3-Clause
/// @file  A free annulus thrown along flat ground without spin, which finally rolls.
#pragma once
#include <utility>
#include <vector>

#include "rondo/mesh/disk.hpp"
#include "support/blocks.hpp"
#include "support/stepping.hpp"

namespace rondo::test {

/// An unconstrained disk.
inline mesh::Mesh free_disk(const mesh::Disk& disk) {
  mesh::Mesh mesh = mesh::make_disk(disk);
  mesh.clamped.clear();
  return mesh;
}

struct ThrownDisk {
  int columns = 120, layers = 8;
  double outer = 0.3, inner = 0.2;  ///< radii                                          [m]
  double youngs = 1.0e8;            ///< [Pa]
  double beta = 1.0e-5;             ///< stiffness damping, so that the bounce decays            [s]
  double friction = 0.5;            ///< [-]
  double speed = 1.0;               ///< [m/s]
  double ramp = 0.02;               ///< of gravity, so that its weight does not act at once [s]
};

/// Mean velocities while it rolls, over [0.1, 0.2] s.
struct Rolling {
  double squared_radius = 0.0;  ///< k² of the mesh: moment of inertia over mass          [m²]
  double speed = 0.0;           ///< of the center                                       [m/s]
  double rim = 0.0;             ///< ω b                                                 [m/s]
  double in_the_air = 0.0;      ///< fraction of the steps
  double relative = 0.0;        ///< residual of the ledger
};

inline Rolling roll(const ThrownDisk& of) {
  const mesh::Mesh mesh = free_disk({.outer_radius = of.outer,
                                     .inner_radius = of.inner,
                                     .radial = of.layers,
                                     .circumferential = of.columns,
                                     .grading = 1.0,
                                     .tread = {}});
  const fem::Material stiff{of.youngs, 0.3, 1000.0, fem::Plane::strain};
  dynamics::Model model = body_model(mesh, stiff, 0.0, of.beta, 0.8);
  model.motion.gravity = dynamics::Table({{0.0, 0.0}, {of.ramp, 9.81}});
  // The center of the disk is the origin; the lowest node touches the ground.
  add_ground(model, mesh, {.profile = {{-1.0, -of.outer}, {1.0, -of.outer}}}, {of.friction, 0.0});
  const std::vector<Vec2> none(model.n_nodes()), v(model.n_nodes(), Vec2{of.speed, 0.0});
  Stepping run(model, dynamics::start(model, none, v));
  run.advance_to(0.1);
  const dynamics::Pose before = run.state().poses[0];
  const double from = run.report().frame.time;
  long long steps = 0, flying = 0;
  run.advance_to(0.2, [&](const dynamics::StepReport& report) {
    ++steps;
    flying += report.contact.nodes == 0 ? 1 : 0;
  });
  const double time = run.report().frame.time - from;
  Rolling rolling;
  for (std::size_t k = 0; k < model.n_nodes(); ++k)
    rolling.squared_radius +=
        model.mass[k] * dot(model.reference[k], model.reference[k]) / model.free_bodies[0].mass;
  rolling.speed = (run.state().poses[0].center.x - before.center.x) / time;
  rolling.rim = of.outer * (before.angle - run.state().poses[0].angle) / time;
  rolling.in_the_air = static_cast<double>(flying) / static_cast<double>(steps);
  rolling.relative = run.balance().relative;
  return rolling;
}

}  // namespace rondo::test
