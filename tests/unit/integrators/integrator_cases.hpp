// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rolling disks with every option of a run on, and with one or the other off; what is seen
/// of their steps.
#pragma once
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "rondo/contact/friction_table.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "support/models.hpp"

namespace rondo::test {

struct RollingCase {
  std::string name;
  DiskCase disk;
  contact::Law law{0.4, 0.0};
  std::optional<contact::GroundShape> ground;
  double spacing = 0.0;                    ///< that the ground is told of its nodes
  bool stiffened = false;                  ///< by the stress of the initial spin
  bool pressed = false;                    ///< by pressures on its boundary
  std::optional<dynamics::RimBody> rim{};  ///< without the bonded nodes
  bool massless = false;                   ///< contact nodes have no mass
};

/// For the names that the tests print.
inline void PrintTo(const RollingCase& c, std::ostream* out) {
  *out << c.name;
}

/// Smooth disk that rolls up a ledge and over the valleys behind it (pairs of facets), with both
/// dampings, gravity, and tables that change within the steps and stand still for some of them.
inline RollingCase everything(const std::string& name, int radial, int columns) {
  RollingCase c{name, rolling_disk(radial, columns), {0.4, 0.0}, {}};
  using dynamics::Table;
  dynamics::Motion& m = c.disk.motion;
  m.angular_velocity = Table({{0.0, 30.0}, {0.01, 30.0}, {0.02, 45.0}, {0.03, 35.0}});
  m.speed = Table({{0.004, 12.0}, {0.012, 9.0}});
  m.height = Table({{0.0, 0.291}, {0.015, 0.286}, {0.035, 0.290}});
  m.start_x = -0.05;
  m.gravity = dynamics::Table(9.81);
  c.ground = {
      .profile =
          {{-10, -0.1}, {0, -0.1}, {0, 0}, {0.04, -0.006}, {0.10, 0.002}, {0.14, -0.004}, {10, 0}},
      .fillet = 0.02};
  return c;
}

/// The same on a treaded disk.
inline RollingCase everything(const std::string& name, int radial, mesh::Tread tread) {
  RollingCase c = everything(name, radial, 0);
  c.disk.disk.tread = tread;
  return c;
}

/// The same with pressures on the boundary, and with corners of the ground that are sharp.
inline RollingCase pressed(RollingCase c) {
  c.name += "_pressed";
  c.pressed = true;
  return c;
}
inline RollingCase sharp(RollingCase c) {
  c.name += "_sharp";
  c.ground->fillet = 0.0;
  return c;
}
/// The same with friction over slip speed, pressure and place: in and beyond the bounds of each. It
/// grows with the slip: friction that falls makes round-off grow, too. No two facets hold a node at
/// once: round-off says how much of the pressure each of them then has.
inline RollingCase rubbing(RollingCase c) {
  c.name += "_rubbing";
  c.ground = ledge();
  c.law.friction = contact::friction_of(
      {.coefficient = 0.5,
       .slip = {{0.0, 0.8}, {0.4, 1.0}, {3.0, 1.2}},
       .pressure_exponent = -0.2,
       .pressure_reference = 2.0e5,
       .patches = {{-0.03, 0.06, contact::Side::both, 0.5}, {0.1, 9.0, contact::Side::both, 1.4}}});
  return c;
}
/// With arcs that are smaller than the nodes are apart.
inline RollingCase small_arcs(RollingCase c) {
  c.name += "_small_arcs";
  c.ground->fillet = 0.008;
  c.spacing = 0.02;
  return c;
}

/// The same with contact nodes that have no mass, where no two facets hold a node at once.
inline RollingCase massless(RollingCase c) {
  c.name += "_massless";
  c.massless = true;
  c.ground = ledge();
  c.law.restitution = 0.0;
  return c;
}

/// The same on a loaded rim: what is free of it has tables of loads and a support.
inline RollingCase on_rim(RollingCase c, bool x, bool y, bool spin) {
  using dynamics::Table;
  c.name += std::string("_rim") + (x ? "_x" : "") + (y ? "_y" : "") + (spin ? "_spin" : "");
  c.disk.motion.slope = 0.05;
  dynamics::RimBody& rim = c.rim.emplace();
  rim.free_x = x;
  rim.free_y = y;
  rim.free_spin = spin;
  rim.mass = 100.0;
  rim.inertia = 1.0;
  if (x) rim.force_x = Table({{0.0, 0.0}, {0.01, 3.0e4}});
  if (x) rim.support_x = {.stiffness = 1.0e5, .damping = 2.0e3, .at = 0.02};
  if (y) rim.force_y = Table({{0.0, -5.0e4}, {0.01, -1.5e5}});
  if (y) rim.support_y = {.stiffness = 2.0e5, .damping = 6.0e4, .at = 0.3};
  if (spin) rim.torque = Table({{0.0, 0.0}, {0.01, 8.0e3}, {0.02, -2.0e3}});
  if (spin) rim.brake = Table({{0.0, 0.0}, {0.02, 0.0}, {0.03, 3.0e4}});
  return c;
}

/// On a loaded rim: what differs between the operators, and each degree of freedom free or held.
inline std::vector<RollingCase> wheel_cases() {
  const mesh::Tread tread{20, 0.02, 3, 1, 2};
  std::vector<RollingCase> all;
  const RollingCase smooth = everything("smooth", 6, 90);
  for (const unsigned free : {0U, 1U, 2U, 4U, 6U, 7U})
    all.push_back(on_rim(smooth, (free & 1U) != 0, (free & 2U) != 0, (free & 4U) != 0));
  RollingCase undamped = everything("undamped", 6, 90);
  undamped.disk.alpha = undamped.disk.beta = 0.0;
  RollingCase flying = everything("flying", 4, 61);
  flying.ground.reset();
  RollingCase weightless = everything("weightless", 4, 61);
  weightless.disk.motion.gravity = dynamics::Table(0.0);
  for (const RollingCase& c : {undamped, flying, weightless, everything("treaded", 3, tread),
                               everything("columns_100", 1, 100)})
    all.push_back(on_rim(c, true, true, true));
  all.push_back(on_rim(rubbing(smooth), true, true, true));
  all.push_back(on_rim(rubbing(everything("treaded", 3, tread)), false, true, true));
  return all;
}

/// Contact nodes without mass: what the sparse operator and the general step do.
inline std::vector<RollingCase> massless_cases() {
  const RollingCase smooth = everything("smooth", 6, 90);
  RollingCase undamped = everything("undamped", 6, 90), frictionless = everything("slides", 6, 90);
  undamped.disk.beta = 0.0;
  frictionless.law = {};
  return {massless(smooth),
          massless(undamped),
          massless(frictionless),
          massless(everything("34_sectors", 6, 34)),
          massless(everything("36_sectors", 6, 36)),
          massless(everything("treaded", 3, mesh::Tread{20, 0.02, 3, 1, 2}))};
}

/// Each difference between the operators that a step could depend on, and numbers of sectors that
/// are no multiple of what a vector register or a thread takes.
inline std::vector<RollingCase> rolling_cases() {
  const mesh::Tread tread{20, 0.02, 3, 1, 2};
  std::vector<RollingCase> all;
  const auto smooth = [&](const char* name) -> RollingCase& {
    return all.emplace_back(everything(name, 6, 90));
  };
  smooth("smooth");
  smooth("smooth_graded").disk.disk.grading = 1.8;
  smooth("smooth_frictionless").law = {};
  smooth("smooth_without_contact").ground.reset();
  smooth("smooth_without_mass_damping").disk.alpha = 0.0;
  smooth("smooth_without_stiffness_damping").disk.beta = 0.0;
  RollingCase& restitution = smooth("smooth_restitution");
  restitution.law = {0.3, 0.5};
  restitution.ground = ledge();  // a corner with restitution and friction may have no solution
  RollingCase& safe = smooth("smooth_energy_safe");
  safe.law = {0.3, 0.5, contact::Impact::energy_safe};
  safe.ground = ledge();
  RollingCase& steady = smooth("smooth_steady_undamped");
  steady.disk.alpha = steady.disk.beta = 0.0;
  steady.disk.motion = rolling_disk(6, 90).motion;
  steady.disk.motion.start_x = -0.05;
  RollingCase& still = smooth("smooth_not_turning");
  still.disk.motion = {};
  still.disk.motion.height = dynamics::Table(0.2999);
  still.ground.emplace();
  const auto rubber = [](RollingCase& of) {
    of.disk.material.poissons_ratio = 0.49;
    of.disk.material.integration = fem::Integration::b_bar;
  };
  rubber(smooth("smooth_b_bar"));
  smooth("smooth_stiffened").stiffened = true;
  RollingCase& both = smooth("smooth_b_bar_stiffened");
  rubber(both);
  both.stiffened = true;
  const auto treaded = [&](const std::string& name, mesh::Tread of) -> RollingCase& {
    return all.emplace_back(everything(name, 3, of));
  };
  treaded("treaded", tread);
  RollingCase& all_of_it = treaded("treaded_b_bar_stiffened", tread);
  rubber(all_of_it);
  all_of_it.stiffened = true;
  RollingCase& undamped = treaded("treaded_undamped", tread);
  undamped.disk.alpha = undamped.disk.beta = 0.0;
  for (const auto& [n, land, groove] : {std::tuple{3, 9, 5}, {5, 6, 4}, {9, 4, 2}})
    treaded("pitches_" + std::to_string(n), {n, 0.02, land, groove, 2});
  for (const int n : {61, 64, 100})
    all.push_back(everything("columns_" + std::to_string(n), n == 100 ? 1 : 4, n));
  for (const int n : {3, 9})  // polygons: not to be rolled over the ground
    all.emplace_back(everything("columns_" + std::to_string(n), 3, n)).ground.reset();
  all.push_back(rubbing(everything("smooth", 6, 90)));
  all.push_back(rubbing(everything("treaded", 3, tread)));
  all.push_back(rubbing(everything("columns_61_undamped", 4, 61)));
  all.back().disk.alpha = all.back().disk.beta = 0.0;
  all.push_back(rubbing(everything("bouncing", 6, 90)));  // nodes leave and come back
  all.back().law.restitution = 0.5;
  return all;
}

/// On the whole of the boundary, and on a part of it, where both act.
inline void add_pressures(Built& b) {
  const std::vector<mesh::Edge>& edges = b.mesh.contact_edges;
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  b.model.pressures.push_back({edges, dynamics::Table({{0.0, -2.0e4}, {0.01, 5.0e4}})});
  b.model.pressures.push_back({{edges.begin(), middle}, dynamics::Table(8.0e4)});
}

inline Built build(const RollingCase& c) {
  Built b = build(c.disk);
  if (c.stiffened) {
    const double spin = c.disk.motion.angular_velocity.at(0.0);
    const auto found = statics::centrifugal_prestress(b.model.stiffness, b.model.mass,
                                                      b.model.reference, b.model.free, spin);
    b.prestress = to_vector(found.u.plane());
    set_stiffness(b, c.disk);
  }
  if (c.ground) {
    add_ground(b, *c.ground, c.law, c.spacing);
    b.model.contact->edges = b.mesh.contact_edges;
  }
  if (c.massless) make_contact_massless(b);
  if (c.pressed) add_pressures(b);
  if (c.rim) set_rim(b, *c.rim);
  return b;
}

/// No two nodes alike, so that the symmetry of the disk hides no mistake of place.
inline std::vector<Vec2> random_field(std::size_t n, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(-size, size);
  std::vector<Vec2> field(n);
  for (Vec2& v : field) v = {x(random), x(random)};
  return field;
}
inline std::vector<Vec2> some_displacement(const Built& b) {
  return random_field(b.model.n_nodes(), 2e-5, 1);  // m
}
inline std::vector<Vec2> some_velocity(const Built& b) {
  return random_field(b.model.n_nodes(), 0.2, 2);  // m/s
}

}  // namespace rondo::test
