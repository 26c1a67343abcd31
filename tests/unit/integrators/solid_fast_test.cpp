// SPDX-License-Identifier: BSD-3-Clause
/// The fast step of a wheel in three dimensions against the readable one, and against itself:
/// however it is cut, on however many threads, with each instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "rondo/contact/friction_table.hpp"
#include "rondo/contact/space/obstacle_ground.hpp"
#include "rondo/contact/space/road_ground.hpp"
#include "rondo/fem/finite/sector_energy.hpp"
#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/integrators/fused/solid/solid_cyclic_integrator.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/solid/solid_integrator.hpp"
#include "rondo/integrators/solid/solid_wheel_integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/mesh/edges.hpp"
#include "support/solid_wheel.hpp"

namespace solid_fast_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

struct Case {
  std::string name;
  mesh::Wheel wheel = test::box_wheel();
  double beta = 2e-5;
  double friction = 0.3;
  double restitution = 0.0;
  double slip_angle = 0.05;
  double camber = 0.03;
  double pressure = 0.0;  ///< on the tread                                              [Pa]
  bool unsteady = true;   ///< spin, slip angle, height and pressure change; gravity
  bool rim = false;       ///< free along t1 and n and about the axle, with loads
  bool cords = false;     ///< cords and air are not linear
  double window = 0.0;    ///< nor is rubber so far to each side of the lowest point; 0: it is
  fem::RubberLaw law = fem::RubberLaw::neo_hooke;
  bool rest = false;      ///< the state at rest has forces of its own
  bool obstacle = false;  ///< a ramp with rounded edges, and a concave corner
  bool sharp = false;     ///< a cleat, or angles, with sharp edges, shorter than an element
  bool road = false;      ///< waves and noise that are not the same across
  bool angles = false;    ///< obstacles of several angles, on that or on level ground
  bool rubs = false;      ///< friction over slip speed, pressure and place
  double turned = 0.0;    ///< the edges of the ground, out of t2                     [rad]
};

/// A displacement and a velocity that are the same for no two nodes.
std::vector<double> some(std::size_t n, double size, double phase) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = size * std::sin(phase + 1.7 * static_cast<double>(i * i % 1009));
  return x;
}

Field some_vectors(std::size_t n, double size, double phase, double axial_phase) {
  const std::vector<double> x = some(n, size, phase), y = some(n, size, phase + 1.0),
                            z = some(n, size, axial_phase);
  Field field(n, 3);
  for (std::size_t k = 0; k < n; ++k) field.space()[k] = {x[k], y[k], z[k]};
  return field;
}

struct Built {
  Model model;
  State start;
};

std::vector<mesh::Face> faces_of_tread(const mesh::Mesh& mesh) {
  for (const mesh::Surface& surface : mesh.surfaces)
    if (surface.name == "tread") return surface.faces;
  return {};
}

RimBody some_rim() {
  RimBody rim;
  rim.free_x = rim.free_y = rim.free_spin = true;
  rim.mass = 9.0;
  rim.inertia = 0.2;
  rim.force_x = Table(300.0);
  rim.force_y = Table(-6000.0);
  rim.torque = Table(40.0);
  rim.support_y = {2e5, 900.0, 0.3};
  return rim;
}

/// Lines from node to node of the section, one of which is held; any two are as good as neighbours.
void add_cords(Model& m, const mesh::Mesh& mesh) {
  const fem::SolidSector& k = m.solid->sector;
  std::vector<int> nodes = k.nodes;
  for (int a = 0; a < k.nodes_per_sector && nodes.size() == k.nodes.size(); ++a)
    if (std::find(nodes.begin(), nodes.end(), a) == nodes.end()) nodes.push_back(a);
  ASSERT_EQ(nodes.size(), k.nodes.size() + 1);
  fem::finite::SweptFaces faces;
  faces.pressure = 2e4;
  fem::finite::SweptCords cords{{200.0, 0.01, 0.5}, {}, {}};
  for (std::size_t i = 0; i + 2 < nodes.size(); i += 2)
    cords.lines.push_back({nodes[i], nodes[i + 1]});
  cords.lines.push_back({nodes[0], nodes.back()});
  for (const auto& [a, b] : cords.lines) {
    fem::finite::FaceCorners x;
    const std::array<int, 4> node{a, b, b + k.nodes_per_sector, a + k.nodes_per_sector};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto n = static_cast<std::size_t>(node[i]);
      x[i] = {mesh.coordinates[n], mesh.axial[n]};
    }
    cords.points.push_back(
        fem::finite::cord_points(x, {0.4, 0.4, 0.4, 0.4}, {2e-3, 2e-3, 3e-3, 3e-3}));
  }
  faces.liner = {cords.lines.begin(), cords.lines.begin() + 2};
  faces.cords.push_back(cords);
  m.solid->swept = SweptPart{faces, k};
}

fem::Rubber rubber_of(fem::RubberLaw law) {
  fem::Rubber rubber;
  rubber.law = law;
  rubber.c10 = 3.8e6;
  if (law == fem::RubberLaw::mooney_rivlin) rubber.c10 = 2.8e6, rubber.c01 = 1e6;
  if (law == fem::RubberLaw::yeoh) rubber.c20 = -4e5, rubber.c30 = 1e5;
  if (law == fem::RubberLaw::ogden) rubber.terms = {{6e6, 2.0}};
  rubber.bulk_modulus = 1.7e7;
  return rubber;
}

/// The section of a wheel without pitches, whose state is away from it.
void add_rubber(const Case& c, const mesh::Mesh& mesh, Model& m) {
  const auto n = static_cast<std::size_t>(m.solid->sector.nodes_per_sector);
  fem::finite::SweptSection section;
  section.n_sectors = m.solid->sector.n_sectors;
  std::vector<Vec3> u;
  for (std::size_t a = 0; a < n; ++a) {
    const double r = norm(mesh.coordinates[a]), z = mesh.axial[a];
    u.emplace_back(4e-3 * (r - 0.15) * (1.0 + 50.0 * z), 0.0, -0.03 * z * (r - 0.1));
    section.place.push_back({r - u[a].x, z - u[a].z});
  }
  section.held.assign(3 * n, 0);
  for (const mesh::Hexahedron& h : mesh.hexahedra) {
    std::vector<int> corner;
    std::ranges::copy_if(h, std::back_inserter(corner),
                         [&](int node) { return static_cast<std::size_t>(node) < n; });
    if (corner.size() != 4 ||
        std::ranges::any_of(h, [&](int node) { return static_cast<std::size_t>(node) >= 2 * n; }))
      continue;
    const auto place = [&](int node) { return section.place[static_cast<std::size_t>(node)]; };
    const Vec2 middle =
        0.25 * (place(corner[0]) + place(corner[1]) + place(corner[2]) + place(corner[3]));
    std::ranges::sort(corner, {}, [&](int node) {
      const Vec2 arm = place(node) - middle;
      return std::atan2(arm.y, arm.x);
    });
    section.quads.push_back({{corner[0], corner[1], corner[2], corner[3]}, 0});
  }
  section.rubbers = {rubber_of(c.law)};
  section.densities = {1100.0};
  m.solid->swept->rubber = fem::finite::SectorEnergy(section).rubber(u);
  m.solid->swept->window.half = c.window;
}

/// 12 mm between heights that are the same for no two points, of some millimetres around 100 m.
road::Road some_road() {
  road::Road road;
  road.u_first = -0.6;
  road.u_step = 0.012;
  for (int j = 0; j < 25; ++j) road.v.push_back(-0.15 + 0.0125 * j);
  const std::size_t n_u = 101;
  road.heights = some(n_u * road.v.size(), 2e-4, 0.2);
  for (std::size_t i = 0; i < n_u; ++i)
    for (std::size_t j = 0; j < road.v.size(); ++j)
      road.heights[i * road.v.size() + j] +=
          100.0 + 0.002 * std::sin(0.9 * static_cast<double>(i) + 0.7 * static_cast<double>(j));
  road.line_height.assign(n_u, 0.0);
  road.slope = road.banking = road.heading = {0.0};
  return road;
}

/// It grows with the slip: friction that falls makes round-off grow, too.
contact::Friction friction_of_case(const Case& c) {
  if (!c.rubs) return c.friction;
  return contact::friction_of(
      {.coefficient = c.friction,
       .slip = {{0.0, 0.8}, {0.4, 1.0}, {3.0, 1.2}},
       .pressure_exponent = -0.2,
       .pressure_reference = 1.0e5,
       .patches = {{-1.0, 0.01, contact::Side::left, 0.5}, {0.0, 9.0, contact::Side::right, 1.4}}});
}

/// @param spacing of the nodes; 0: nodes alone touch the ground
std::shared_ptr<const contact::SpaceGround> with_angles(const Case& c, double spacing) {
  using contact::ObstacleKind;
  const double fillet = c.sharp ? 0.0 : 0.003;
  const std::vector<contact::Obstacle> obstacles{
      {ObstacleKind::step, -0.3, -0.0005, 0.0, -0.2, 0.1 * fillet},
      {ObstacleKind::cleat, -0.02, 0.004, 0.03, 0.5, fillet},
      {ObstacleKind::pothole, 0.08, 0.004, 0.03, -0.4, fillet}};
  std::shared_ptr<const contact::BaseGround> base =
      std::make_shared<contact::ProfileGround>(contact::Ground(contact::GroundShape{}));
  if (c.road)
    base = std::make_shared<contact::RoadGround>(road::Surface(some_road()),
                                                 contact::RoadPlacing{-0.1, 0.01, 100.002});
  return std::make_shared<contact::ObstacleGround>(base, obstacles, spacing);
}

Model model_of(const Case& c) {
  const mesh::Mesh mesh = mesh::make_wheel(c.wheel);
  test::Cornering rolling;
  rolling.slip_angle = c.slip_angle;
  rolling.camber = c.camber;
  Model m = test::cornering_model(mesh, rolling);
  m.dt = 0.6 * 2.0 / std::sqrt(fem::solid_eigenvalue_bound(mesh, {{test::box_rubber()}}));
  m.stiffness_damping = c.beta;
  contact::GroundShape ground;
  if (c.obstacle) {
    ground.profile = {{-1, 0}, {0.02, 0}, {0.05, 0.006}, {0.1, 0.006}, {0.13, 0}, {9, 0}};
    ground.fillet = 0.002;
  }
  if (c.sharp && !c.angles)
    ground.profile = {{-1, 0}, {0.035, 0}, {0.036, 0.003}, {0.05, 0.003}, {0.05, 0}, {9, 0}};
  if (c.sharp && !c.unsteady)  // its height is .29 m
    for (Vec2& point : ground.profile) point.y -= 0.0098;
  const std::vector<mesh::Edge> edges = mesh::rolling_edges(mesh, "tread");
  const double spacing = c.sharp ? mesh::longest_edge(mesh.coordinates, edges) : 0.0;
  m.contact.emplace(ContactModel{contact::Ground(ground, spacing),
                                 {.friction = friction_of_case(c), .restitution = c.restitution},
                                 mesh.boundary,
                                 mesh.tributary,
                                 edges});
  m.contact->axes = contact::EdgeAxes(c.turned);
  if (c.road)  // below the height of a wheel that is in the ground at the start
    m.contact->space = std::make_shared<contact::RoadGround>(
        road::Surface(some_road()),
        contact::RoadPlacing{-0.1, 0.01, c.unsteady ? 100.002 : 100.0118});
  if (c.angles) m.contact->space = with_angles(c, spacing);
  const double end = 106.0 * m.dt;
  if (c.unsteady) {
    m.motion.angular_velocity = Table({{0.0, 32.0}, {end, 36.0}});
    m.motion.slip_angle = Table({{0.0, 0.0}, {end, c.slip_angle}});
    m.motion.height = Table({{0.0, 0.2995}, {end, 0.288}});
    m.motion.gravity = Table(9.81);
    m.motion.slope = 0.02;
  }
  if (c.pressure != 0.0) {
    const auto force = fem::sector_pressure(mesh, m.solid->sector, faces_of_tread(mesh));
    m.solid->pressures.push_back({force, Table({{0.0, 0.0}, {end, c.pressure}})});
    m.solid->pressures.push_back({force, Table(0.1 * c.pressure)});
  }
  if (c.rest) {
    std::vector<Vec3> outwards;
    for (std::size_t a = 0; a < m.solid->sector.n_local(); ++a)
      outwards.push_back({30.0, 0.0, 0.0});
    m.solid->pressures.push_back({outwards, Table(1.0), true});
  }
  if (c.cords) add_cords(m, mesh);
  if (c.window > 0.0) add_rubber(c, mesh, m);
  if (c.rim) m.rim = some_rim();
  return m;
}

State start_of(const Model& m) {
  const std::size_t n = m.n_nodes();
  return start(m, some_vectors(n, 1e-5, 0.3, 2.0), some_vectors(n, 0.01, 0.7, 2.5));
}

constexpr int steps = 107;  // a last pass that is not full

struct Outcome {
  State state;
  std::vector<StepReport> reports;
};

Outcome after(const Model& model, Integrator& integrator) {
  Outcome out{State(model), std::vector<StepReport>(steps)};
  const std::span reports(out.reports);
  integrator.advance(reports.first(7), nullptr);
  integrator.advance(reports.subspan(7, 64), nullptr);
  integrator.advance(reports.subspan(71), &out.state);
  return out;
}

Outcome fast(const Model& model, const SolidTuning& tuning = {},
             const kernels::Table& table = kernel_table()) {
  SolidCyclicIntegrator integrator(model, start_of(model), table, tuning);
  return after(model, integrator);
}

/// The largest difference of two things of a kind, and their largest size.
struct Difference {
  double error = 0.0, size = 0.0;
  void see(double a, double b) {
    size = std::max(size, std::abs(a));
    if (!(std::abs(a - b) <= error)) error = std::abs(a - b);  // NaN comes through
  }
  void see(Vec3 a, Vec3 b) {
    see(a.x, b.x);
    see(a.y, b.y);
    see(a.z, b.z);
  }
  void see(const Field& a, const Field& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) see(a.space()[i], b.space()[i]);
  }
  void expect_within(double bound, const char* kind) const {
    EXPECT_GT(size, 0.0) << kind;
    EXPECT_LE(error, bound * size) << kind;
  }
};

/// What each candidate feels in all, along t1, n and t2.
std::map<std::size_t, Vec3> on_nodes(const Outcome& o) {
  std::map<std::size_t, Vec3> felt;
  for (const ActiveContact& c : o.state.active) felt[c.candidate] += c.space.from(c.impulse);
  return felt;
}

void expect_near(const Outcome& a, const Outcome& b, double bound) {
  Difference u, v, energy, impulse, moment, residual;
  u.see(a.state.u, b.state.u);
  v.see(a.state.v, b.state.v);
  v.see(a.state.v_next, b.state.v_next);
  // How contacts that share nodes share what a node feels is not unique.
  const bool shared = a.reports.back().contact.clusters > 0;
  if (shared) {
    ASSERT_EQ(on_nodes(a).size(), on_nodes(b).size());
    for (const auto& [candidate, felt] : on_nodes(a)) impulse.see(felt, on_nodes(b)[candidate]);
  }
  ASSERT_EQ(a.state.active.size(), b.state.active.size());
  for (std::size_t i = 0; i < a.state.active.size() && !shared; ++i) {
    const ActiveContact &c = a.state.active[i], &d = b.state.active[i];
    ASSERT_EQ(c.candidate, d.candidate);
    // Where a node sticks to two facets at once, round-off says which one of them holds it.
    if (a.reports.back().contact.pairs == 0) {
      ASSERT_EQ(c.status, d.status);
    }
    impulse.see(c.impulse, d.impulse);
    v.see(c.before, d.before);
    v.see(c.after.z, d.after.z);
  }
  for (std::size_t i = 0; i < a.reports.size(); ++i) {
    const ContactReport &c = a.reports[i].contact, &d = b.reports[i].contact;
    ASSERT_EQ(a.reports[i].step, b.reports[i].step);
    if (c.clusters == 0) {
      ASSERT_EQ(c.nodes, d.nodes) << i;
    }
    if (c.pairs == 0 && c.clusters == 0) {
      ASSERT_EQ(c.sticking, d.sticking) << i;
    }
    ASSERT_EQ(c.pairs, d.pairs) << i;
    ASSERT_EQ(c.clusters, d.clusters) << i;
    ASSERT_EQ(c.late > 0.0, d.late > 0.0) << i;
    ASSERT_EQ(c.cluster_largest, d.cluster_largest) << i;
    impulse.see(c.impulse, d.impulse);
    moment.see(c.moment_aligning, d.moment_aligning);
    moment.see(c.moment_overturning, d.moment_overturning);
    moment.see(c.angular_impulse, d.angular_impulse);
    const Balance &e = a.reports[i].balance, &f = b.reports[i].balance;
    const Works &w = e.works, &x = f.works;
    for (const auto& [of_a, of_b] : {std::pair{e.kinetic, f.kinetic},
                                     {e.strain, f.strain},
                                     {w.frame, x.frame},
                                     {w.gravity, x.gravity},
                                     {w.held, x.held},
                                     {w.scheme, x.scheme},
                                     {w.torque, x.torque},
                                     {e.kinetic_rim, f.kinetic_rim},
                                     {e.support, f.support},
                                     {w.contact, x.contact},
                                     {w.dissipation_friction, x.dissipation_friction},
                                     {w.loss_impact, x.loss_impact},
                                     {w.load, x.load},
                                     {w.rim, x.rim},
                                     {w.dissipation_mass, x.dissipation_mass},
                                     {w.dissipation_stiffness, x.dissipation_stiffness},
                                     {e.exchanged, f.exchanged}})
      energy.see(of_a, of_b);
    const MaterialReport &m = a.reports[i].material, &n = b.reports[i].material;
    energy.see(m.internal_work, n.internal_work);
    energy.see(m.stored_energy, n.stored_energy);
    energy.see(m.window_work, n.window_work);
    ASSERT_EQ(m.least_volume, n.least_volume);
    residual.see(e.residual, f.residual);
  }
  residual.size = energy.size;
  u.expect_within(bound, "displacement");
  v.expect_within(bound, "velocity");
  impulse.expect_within(bound, "impulse");
  moment.expect_within(bound, "moment");
  energy.expect_within(bound, "energy");
  residual.expect_within(bound, "residual");
  EXPECT_LT(a.reports.back().balance.relative, 1e-13);
}

void expect_same(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.state.u, b.state.u);
  EXPECT_EQ(a.state.v, b.state.v);
  EXPECT_EQ(a.state.v_next, b.state.v_next);
  ASSERT_EQ(a.state.active.size(), b.state.active.size());
  for (std::size_t i = 0; i < a.state.active.size(); ++i) {
    EXPECT_EQ(a.state.active[i].candidate, b.state.active[i].candidate);
    EXPECT_EQ(a.state.active[i].impulse, b.state.active[i].impulse);
  }
  for (std::size_t i = 0; i < a.reports.size(); ++i) {
    const ContactReport &c = a.reports[i].contact, &d = b.reports[i].contact;
    ASSERT_EQ(c.impulse, d.impulse) << i;
    ASSERT_EQ(c.moment_aligning, d.moment_aligning) << i;
    ASSERT_EQ(c.nodes, d.nodes) << i;
    const Balance &e = a.reports[i].balance, &f = b.reports[i].balance;
    ASSERT_EQ(e.kinetic, f.kinetic) << i;
    ASSERT_EQ(e.strain, f.strain) << i;
    ASSERT_EQ(e.works.frame, f.works.frame) << i;
    ASSERT_EQ(e.works.load, f.works.load) << i;
    ASSERT_EQ(a.reports[i].material.stored_energy, b.reports[i].material.stored_energy) << i;
    ASSERT_EQ(a.reports[i].material.window_work, b.reports[i].material.window_work) << i;
    ASSERT_EQ(e.works.dissipation_stiffness, f.works.dissipation_stiffness) << i;
    ASSERT_EQ(e.works.dissipation_friction, f.works.dissipation_friction) << i;
  }
}

mesh::Wheel treaded(int radial, int axial, mesh::Tread tread) {
  mesh::Wheel w = test::box_wheel(radial, axial);
  w.disk.tread = tread;
  return w;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({.name = "smooth"});
  all.push_back({.name = "smooth_without_beta", .beta = 0.0});
  all.push_back({.name = "steady", .unsteady = false});
  all.push_back({.name = "steady_without_beta", .beta = 0.0, .unsteady = false});
  // Even and odd numbers of nodes a layer, packs that are not full, one layer.
  all.push_back({.name = "four_nodes_a_layer", .wheel = test::box_wheel(4, 3, 77)});
  all.push_back({.name = "two_nodes_a_layer", .wheel = test::box_wheel(5, 1, 64)});
  all.push_back({.name = "one_layer", .wheel = test::box_wheel(1, 5, 70)});
  all.push_back({.name = "pressure", .pressure = 2e4});
  all.push_back({.name = "pressure_without_beta", .beta = 0.0, .pressure = 2e4});
  all.push_back({.name = "restitution", .restitution = 0.5});
  all.push_back({.name = "obstacle", .friction = 0.8, .obstacle = true});
  all.push_back({.name = "sharp", .friction = 0.8, .sharp = true});
  all.push_back({.name = "sharp_without_beta", .beta = 0.0, .friction = 0.0, .sharp = true});
  all.push_back({.name = "sharp_steady",
                 .restitution = 0.3,
                 .camber = 0.0,
                 .unsteady = false,
                 .sharp = true});
  all.push_back({.name = "sharp_pressure", .pressure = 2e4, .sharp = true});
  all.push_back({.name = "sharp_rim", .pressure = 2e4, .rim = true, .rest = true, .sharp = true});
  all.push_back({.name = "sharp_cords", .cords = true, .sharp = true});
  all.push_back({.name = "sharp_window", .rim = true, .cords = true, .window = 0.4, .sharp = true});
  all.push_back(
      {.name = "sharp_pitches", .wheel = treaded(4, 4, {19, 0.02, 3, 1, 2}), .sharp = true});
  all.push_back({.name = "sharp_wide", .wheel = test::box_wheel(3, 12, 330), .sharp = true});
  all.push_back({.name = "sharp_turned", .sharp = true, .turned = 0.5});
  all.push_back({.name = "sharp_turned_rim", .rim = true, .sharp = true, .turned = -0.4});
  all.push_back({.name = "obstacle_turned", .obstacle = true, .turned = -0.3});
  all.push_back({.name = "road", .friction = 0.8, .restitution = 0.3, .road = true});
  all.push_back(
      {.name = "road_steady", .beta = 0.0, .camber = 0.0, .unsteady = false, .road = true});
  all.push_back({.name = "road_rim", .pressure = 2e4, .rim = true, .rest = true, .road = true});
  all.push_back({.name = "road_window", .rim = true, .cords = true, .window = 0.4, .road = true});
  all.push_back({.name = "road_wide", .wheel = test::box_wheel(3, 12, 330), .road = true});
  all.push_back({.name = "angles", .restitution = 0.3, .angles = true});
  all.push_back({.name = "road_angles", .friction = 0.8, .road = true, .angles = true});
  all.push_back({.name = "road_angles_rim", .rim = true, .road = true, .angles = true});
  all.push_back({.name = "sharp_angles", .sharp = true, .angles = true});
  all.push_back({.name = "sharp_angles_rim", .rim = true, .sharp = true, .angles = true});
  all.push_back({.name = "no_friction", .friction = 0.0});
  all.push_back({.name = "rubbing", .friction = 0.5, .rubs = true});
  all.push_back({.name = "rubbing_rim",
                 .beta = 0.0,
                 .friction = 0.5,
                 .restitution = 0.3,
                 .rim = true,
                 .rubs = true});
  all.push_back({.name = "rubbing_wide",
                 .wheel = test::box_wheel(3, 12, 330),
                 .friction = 0.5,
                 .camber = 0.0,
                 .rubs = true});
  all.push_back(
      {.name = "rubbing_window", .friction = 0.5, .cords = true, .window = 0.4, .rubs = true});
  all.push_back({.name = "rim", .rim = true});
  all.push_back({.name = "rim_without_beta", .beta = 0.0, .restitution = 0.3, .rim = true});
  all.push_back({.name = "rim_steady", .camber = 0.0, .unsteady = false, .rim = true});
  all.push_back({.name = "rim_pressure", .pressure = 2e4, .rim = true, .rest = true});
  all.push_back({.name = "rim_odd_rows", .wheel = test::box_wheel(4, 3, 77), .rim = true});
  all.push_back({.name = "rim_pitches",
                 .wheel = treaded(4, 4, {19, 0.02, 3, 1, 2}),
                 .rim = true,
                 .rest = true});
  all.push_back({.name = "cords", .cords = true});
  all.push_back({.name = "cords_steady", .beta = 0.0, .unsteady = false, .cords = true});
  all.push_back({.name = "cords_pressure",
                 .wheel = test::box_wheel(4, 3, 77),
                 .pressure = 2e4,
                 .cords = true});
  all.push_back({.name = "cords_rim", .rim = true, .cords = true, .rest = true});
  all.push_back(
      {.name = "cords_wide", .wheel = test::box_wheel(3, 12, 330), .beta = 0.0, .cords = true});
  all.push_back({.name = "window", .cords = true, .window = 0.4});
  all.push_back({.name = "window_rim", .rim = true, .cords = true, .window = 0.3, .rest = true});
  all.push_back({.name = "window_mooney",
                 .wheel = test::box_wheel(4, 3, 77),
                 .beta = 0.0,
                 .cords = true,
                 .window = 0.5,
                 .law = fem::RubberLaw::mooney_rivlin});
  all.push_back({.name = "window_yeoh",
                 .unsteady = false,
                 .cords = true,
                 .window = 1.0,
                 .law = fem::RubberLaw::yeoh});
  all.push_back(
      {.name = "window_wide", .wheel = test::box_wheel(3, 5, 330), .cords = true, .window = 0.2});
  all.push_back({.name = "all_rubber", .pressure = 2e4, .cords = true, .window = 7.0});
  all.push_back({.name = "all_rubber_rim", .beta = 0.0, .rim = true, .cords = true, .window = 7.0});
  all.push_back({.name = "pitches", .wheel = treaded(4, 4, {19, 0.02, 3, 1, 2})});
  all.push_back(
      {.name = "pitches_pressure", .wheel = treaded(4, 3, {41, 0.02, 1, 1, 1}), .pressure = 2e4});
  all.push_back(
      {.name = "pitches_without_beta", .wheel = treaded(4, 4, {13, 0.02, 5, 3, 2}), .beta = 0.0});
  Case grooves{.name = "grooves"};
  grooves.wheel = treaded(4, 8, {29, 0.02, 2, 1, 2});
  grooves.wheel.grooves = {{0.0, 0.02}};
  all.push_back(grooves);
  // So large that its rows are walked over from side to side.
  all.push_back({.name = "wide", .wheel = test::box_wheel(3, 12, 330), .pressure = 2e4});
  all.push_back({.name = "wide_pitches", .wheel = treaded(3, 12, {60, 0.02, 3, 1, 2})});
  Case crown{.name = "crown"};
  crown.wheel.crown_radius = 0.3;
  all.push_back(crown);
  return all;
}

class SolidFast : public testing::TestWithParam<Case> {};

std::unique_ptr<Integrator> readable_step(const Model& model, const State& start) {
  if (model.rim) return std::make_unique<SolidWheelIntegrator>(model, start);
  return std::make_unique<SolidIntegrator>(model, start);
}

long contacts_of(const Outcome& o) {
  long contacts = 0;
  for (const StepReport& report : o.reports) contacts += report.contact.nodes;
  return contacts;
}

/// Contacts at sharp corners that share nodes with others.
long clusters_of(const Outcome& o) {
  long clusters = 0, unsolved = 0;
  for (const StepReport& report : o.reports) {
    clusters += report.contact.clusters;
    unsolved += report.contact.clusters_not_converged;
    EXPECT_EQ(report.contact.unseen, 0.0);
  }
  EXPECT_LE(100 * unsolved, clusters);
  return clusters;
}

}  // namespace

TEST_P(SolidFast, AgreesWithTheReadableStep) {
  const Model model = model_of(GetParam());
  const auto readable = readable_step(model, start_of(model));
  const Outcome expected = after(model, *readable);
  EXPECT_GT(contacts_of(expected), 0);
  EXPECT_EQ(clusters_of(expected) > 0, GetParam().sharp);
  for (const StepReport& report : expected.reports)
    if (GetParam().unsteady) {  // else it starts in the ground
      EXPECT_EQ(report.contact.late, 0.0);
    }
  expect_near(expected, fast(model), 1e-11);
}

TEST_P(SolidFast, GivesTheSameBitsHoweverItIsCutAndThreaded) {
  Model model = model_of(GetParam());
  SolidTuning in_cache;
  in_cache.cache_bytes = std::size_t{1} << 40U;
  const Outcome whole = fast(model, in_cache);
  const SolidTuning ring{0, 0, 1 << 20, 8}, wide{0, 0, 48, 8}, wider{0, 0, 96, 8},
      narrow{0, 0, 48, 1 << 20};
  for (const SolidTuning& tuning : {ring, wide, wider, narrow})
    for (const int threads : {1, 2, 3}) {
      model.threads = threads;
      const SolidPlan plan = make_solid_plan(model, tuning);
      SCOPED_TRACE(std::to_string(plan.cut.chunks.size()) + " chunks, " +
                   std::to_string(plan.cut.depth) + " steps in a pass, " + std::to_string(threads) +
                   " threads");
      expect_same(whole, fast(model, tuning));
    }
}

TEST_P(SolidFast, IsTheSameWithEachInstructionSet) {
  const Model model = model_of(GetParam());
  const Outcome best = fast(model, {}, *kernel_tables().front());
  for (const kernels::Table* table : kernel_tables()) {
    SCOPED_TRACE(table->name);
    const Outcome other = fast(model, {}, *table);
    if (std::string(table->name) == "baseline")
      expect_near(best, other, 1e-11);
    else
      expect_same(best, other);
  }
}

TEST_P(SolidFast, AStateWithoutVelocitiesHasTheBitsOfTheWholeOneAtTheCandidates) {
  const Model model = model_of(GetParam());
  State whole = start_of(model), boundary = boundary_state(model);
  SolidCyclicIntegrator one(model, whole, kernel_table()), other(model, whole, kernel_table());
  std::vector<StepReport> reports(37);
  one.advance(reports, &whole);
  other.advance(reports, &boundary);
  for (const int node : model.contact->nodes) {
    const auto n = static_cast<std::size_t>(node);
    EXPECT_EQ(boundary.u.space()[n], whole.u.space()[n]);
  }
  EXPECT_TRUE(boundary.v.empty());
}

TEST_P(SolidFast, GoesOnFromWhatItSaved) {
  const Model model = model_of(GetParam());
  const State begin = start_of(model);
  SolidCyclicIntegrator one(model, begin, kernel_table()), two(model, begin, kernel_table());
  std::vector<StepReport> reports(37);
  one.advance(reports, nullptr);
  two.restore(one.save());
  expect_same(after(model, one), after(model, two));
  State now(model), saved(model);
  one.fields(now);
  two.fields(saved);
  EXPECT_EQ(now.u, saved.u);
  EXPECT_EQ(now.v_next, saved.v_next);
}

INSTANTIATE_TEST_SUITE_P(All, SolidFast, testing::ValuesIn(cases()),
                         [](const auto& p) { return p.param.name; });

TEST(SolidPlan, SmoothWheelsAreMirrorsAndTreadsAreNot) {
  const SolidPlan smooth = make_solid_plan(model_of({.name = "smooth"}));
  for (const SolidPlanStrip& strip : smooth.strips)
    EXPECT_EQ(strip.kind, kernels::SolidKind::mirrored) << strip.first;
  EXPECT_EQ(smooth.strips.size(), 9U);  // of 3 layers of 5 nodes: two, two and one
  const SolidPlan tread =
      make_solid_plan(model_of({.name = "pitches", .wheel = treaded(4, 4, {19, 0.02, 3, 1, 2})}));
  long general = 0, mirrored = 0;
  for (const kernels::SolidKind kind : tread.stiffness.kind) {
    general += kind == kernels::SolidKind::general ? 1 : 0;
    mirrored += kind == kernels::SolidKind::mirrored ? 1 : 0;
  }
  EXPECT_GT(general, 0);
  EXPECT_GT(mirrored, 0);
}

TEST(SolidPlan, LargeWheelsAreWalkedOverTheShorterWay) {
  const Model wide = model_of({.name = "wide", .wheel = test::box_wheel(3, 12, 330)});
  const OrderedSector ordered = order_sector(wide);
  EXPECT_EQ(ordered.was[0], 0);
  EXPECT_EQ(ordered.was[1], 13);  // the next layer, not the next node of the first
  const SolidPlan plan = make_solid_plan(wide);
  EXPECT_EQ(plan.needs.front(), 3);  // of the next slice: each is a strip of two and one
  const Model high = model_of({.name = "high", .wheel = test::box_wheel(12, 3, 330)});
  EXPECT_EQ(order_sector(high).was[1], 1);
}

/// The cuts of the tests above are those that large wheels take.
TEST(SolidPlan, LargeWheelsTakeSeveralStepsInAPassOverWideChunks) {
  Model model = model_of({.name = "wide", .wheel = test::box_wheel(2, 2, 300)});
  EXPECT_EQ(make_solid_plan(model).cut.halo, Halo::ring);
  EXPECT_EQ(make_solid_plan(model).cut.depth, 1);
  const SolidPlan wide = make_solid_plan(model, {0, 0, 48, 8});
  EXPECT_EQ(wide.cut.halo, Halo::wide);
  EXPECT_EQ(wide.cut.depth, solid_steps_in_a_pass);
  EXPECT_GT(wide.cut.chunks.size(), 4U);
  model.threads = 2;
  EXPECT_EQ(make_solid_plan(model).cut.chunks.size(), 2U);
}

TEST(SolidPlan, BlocksAreSymmetricToTheLastBit) {
  const SolidPlan plan =
      make_solid_plan(model_of({.name = "pitches", .wheel = treaded(4, 4, {19, 0.02, 3, 1, 2})}));
  const auto& blocks = plan.stiffness.blocks;
  for (std::size_t a = 0; a < blocks.size(); ++a)
    for (const SolidBlock& b : blocks[a]) {
      const auto& row = blocks[static_cast<std::size_t>(b.row)];
      const auto back = std::find_if(row.begin(), row.end(), [&](const SolidBlock& other) {
        return other.row == static_cast<int>(a) && other.shift == -b.shift;
      });
      ASSERT_NE(back, row.end());
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t r = 0; r < 3; ++r) ASSERT_EQ(b.k[3 * c + r], back->k[3 * r + c]);
    }
}

}  // namespace solid_fast_test
