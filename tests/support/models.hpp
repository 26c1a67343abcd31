// SPDX-License-Identifier: BSD-3-Clause
/// @file  Small models that several tests share.
#pragma once
#include <utility>

#include "rondo/fem/contact_mass.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/mesh/disk.hpp"
#include "rondo/model/stability/critical_step.hpp"

namespace rondo::test {

/// The smooth disk of cases/ledge-smooth.toml, with its damping.
struct DiskCase {
  mesh::Disk disk;
  fem::Material material{2.0e7, 0.3, 1100.0, fem::Plane::strain};
  double alpha = 200.0;
  double beta = 2.0e-5;
  dynamics::Motion motion;
  dynamics::Scheme scheme = dynamics::Scheme::symplectic;
  double safety = 0.8;
};

/// The disk of the validation against closed forms: annulus of soft rubber, rim fixed.
inline DiskCase rubber_annulus(int radial, int circumferential) {
  DiskCase c;
  c.disk = {.outer_radius = 0.3,
            .inner_radius = 0.2,
            .radial = radial,
            .circumferential = circumferential,
            .grading = 1.0,
            .tread = {}};
  c.material = {5.0e6, 0.45, 1100.0, fem::Plane::strain};
  c.alpha = c.beta = 0.0;
  c.motion.angular_velocity = dynamics::Table(50.0);
  return c;
}

/// Rolling at 10 m/s, the center 0.29 m above y = 0.
inline DiskCase rolling_disk(int radial, int circumferential) {
  DiskCase c;
  c.disk.radial = radial;
  c.disk.circumferential = circumferential;
  c.motion.angular_velocity = dynamics::Table(33.333333);
  c.motion.speed = dynamics::Table(10.0);
  c.motion.height = dynamics::Table(0.29);
  c.motion.start_x = -0.35;
  return c;
}

inline contact::GroundShape ledge() {
  return {.profile = {{-10, -0.1}, {0, -0.1}, {0, 0}, {10, 0}}, .fillet = 0.02};
}

/// The scheme as printed takes the mass damping at the old half step.
inline double lagged_mass(const DiskCase& c) {
  return c.scheme == dynamics::Scheme::as_printed ? c.alpha : 0.0;
}

struct Built {
  mesh::Mesh mesh;
  std::vector<fem::Material> materials;  ///< one for each region of the mesh
  dynamics::Model model;
  dynamics::CriticalStep critical;
  std::vector<Vec2> prestress;  ///< (n) displacement whose stress stiffens the body; empty: none
};

/// Stiffness, critical step, step.
inline void set_stiffness(Built& b, const DiskCase& c) {
  b.model.stiffness = fem::assemble_stiffness(b.mesh, b.materials, b.prestress);
  b.critical = dynamics::critical_step(
      b.model.stiffness, b.model.mass, b.model.free, {c.beta, lagged_mass(c)},
      fem::element_eigenvalue_bound(b.mesh, b.materials, b.prestress));
  b.model.dt = c.safety * b.critical.step;
}

/// The case on another mesh than its own.
inline Built build(const DiskCase& c, mesh::Mesh mesh) {
  Built b;
  b.mesh = std::move(mesh);
  b.materials = {c.material};
  b.model.reference = b.mesh.coordinates;
  b.model.mass = fem::lumped_mass(b.mesh, b.materials);
  b.model.free = fem::free_nodes(b.mesh);
  b.model.mass_damping = c.alpha;
  b.model.stiffness_damping = c.beta;
  b.model.motion = c.motion;
  b.model.scheme = c.scheme;
  set_stiffness(b, c);
  return b;
}

inline Built build(const DiskCase& c) {
  return build(c, mesh::make_disk(c.disk));
}

/// @param spacing of the candidates, which says what arcs are corners; 0: none is [m]
inline void add_ground(Built& b, const contact::GroundShape& shape, contact::Law law,
                       double spacing = 0.0) {
  b.model.contact.emplace(dynamics::ContactModel{contact::Ground(shape, spacing), law,
                                                 b.mesh.boundary, b.mesh.tributary});
}

/// The candidates lose their mass to the nodes below (docs/theory.md, 3.10); the step stays.
/// @pre the ground is there
inline void make_contact_massless(Built& b) {
  b.model.lumped_mass = b.model.mass;
  b.model.mass = fem::move_contact_mass(b.mesh, b.model.mass, b.model.contact->nodes).mass;
}

/// @param rim without the bonded nodes, which are added
inline void set_rim(Built& b, dynamics::RimBody rim) {
  for (const int node : b.mesh.clamped) {
    const auto k = static_cast<std::size_t>(node);
    rim.mass += b.model.mass[k];
    rim.inertia += b.model.mass[k] * dot(b.model.reference[k], b.model.reference[k]);
  }
  b.model.rim = rim;
}

inline dynamics::State start_at_rest(const dynamics::Model& model) {
  const Field zero(model.n_nodes(), model.components());
  return dynamics::start(model, zero, zero);
}

}  // namespace rondo::test
