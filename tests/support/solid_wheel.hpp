// SPDX-License-Identifier: BSD-3-Clause
/// @file  Models of wheels in three dimensions that several tests use.
#pragma once
#include <cmath>
#include <utility>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/mesh/solid/wheel.hpp"
#include "rondo/model/model.hpp"

namespace rondo::test {

/// The wheel of docs/wheel3d.md: radii .15 and .30 m, width .1 m, 3×4×90 elements.
inline mesh::Wheel box_wheel(int radial = 3, int axial = 4, int around = 90) {
  mesh::Wheel w;
  w.disk.inner_radius = 0.15;
  w.disk.outer_radius = 0.30;
  w.disk.radial = radial;
  w.disk.circumferential = around;
  w.width = 0.1;
  w.axial = axial;
  return w;
}

inline fem::Material box_rubber() {
  fem::Material m;
  m.youngs_modulus = 2e7;
  m.poissons_ratio = 0.3;
  m.density = 1100.0;
  return m;
}

/// The wheel rolls at 10 m/s with the axle .29 m above flat ground.
struct Cornering {
  double slip_angle = 0.0;  ///< [rad]
  double camber = 0.0;      ///< [rad]
  double friction = 0.3;
  double angular_velocity = 33.76455;  ///< [rad/s]
  double dt = 6.868931e-5;             ///< [s]
};

inline dynamics::Model solid_model(const mesh::Mesh& mesh, const fem::Material& material) {
  dynamics::Model m;
  const std::vector<fem::Material> materials{material};
  m.reference = mesh.coordinates;
  m.mass = fem::solid_mass(mesh, materials);
  m.free = fem::free_nodes(mesh);
  m.solid.emplace(dynamics::SolidBody{mesh.axial, fem::assemble_solid_sector(mesh, materials), {}});
  m.stiffness_operator = dynamics::StiffnessOperator::cyclic;
  return m;
}

inline void touch_flat_ground(const mesh::Mesh& mesh, contact::Law law, dynamics::Model& m) {
  m.contact.emplace(
      dynamics::ContactModel{contact::Ground({}), law, mesh.boundary, mesh.tributary});
}

/// A profile with sharp corners, which touch the edges around the wheel.
inline void touch_corners(const mesh::Mesh& mesh, const contact::GroundShape& ground,
                          contact::Law law, dynamics::Model& m) {
  const std::vector<mesh::Edge> edges = mesh::rolling_edges(mesh, "tread");
  m.contact.emplace(
      dynamics::ContactModel{contact::Ground(ground, mesh::longest_edge(mesh.coordinates, edges)),
                             law, mesh.boundary, mesh.tributary, edges});
}

inline dynamics::Model cornering_model(const mesh::Mesh& mesh, const Cornering& c) {
  dynamics::Model m = solid_model(mesh, box_rubber());
  m.mass_damping = 200.0;
  m.stiffness_damping = 2e-5;
  m.dt = c.dt;
  m.motion.angular_velocity = dynamics::Table(c.angular_velocity);
  m.motion.speed = dynamics::Table(10.0);
  m.motion.height = dynamics::Table(0.29);
  m.motion.slip_angle = dynamics::Table(c.slip_angle);
  m.motion.camber = c.camber;
  touch_flat_ground(mesh, {.friction = c.friction}, m);
  return m;
}

}  // namespace rondo::test
