// SPDX-License-Identifier: BSD-3-Clause
/// V8: a free disk is thrown along the ground without spin and ends up rolling
/// (docs/validation.md). Expected: the angular momentum about the line of contact is kept, so it
/// rolls at v0/(1 + k²/b²). And two free disks that collide: they keep their momentum.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/thrown_disk.hpp"
#include "support/traps.hpp"

namespace v08_thrown_disk {

using namespace rondo;
using namespace rondo::dynamics;

/// Masses at the nodes: sums over the layers by the trapezoidal rule, that of r dr exact, that of
/// r³ dr off by h²/4 (b² - a²) of (b⁴ - a⁴)/4.
TEST(ThrownDisk, TheMeshHasTheInertiaOfTheAnnulusToSecondOrder) {
  const double a2 = 0.2 * 0.2, b2 = 0.3 * 0.3;
  for (const int layers : {2, 4, 8}) {
    const mesh::Mesh mesh = test::free_disk({.outer_radius = 0.3,
                                             .inner_radius = 0.2,
                                             .radial = layers,
                                             .circumferential = 60,
                                             .grading = 1.0,
                                             .tread = {}});
    double mass = 0.0, inertia = 0.0;
    const std::vector<double> areas = fem::nodal_areas(mesh);
    for (std::size_t k = 0; k < areas.size(); ++k) {
      mass += areas[k];
      inertia += areas[k] * dot(mesh.coordinates[k], mesh.coordinates[k]);
    }
    const double off = inertia / mass / (0.5 * (a2 + b2)) - 1.0, h = 0.1 / layers;
    EXPECT_NEAR(off, h * h / (a2 + b2), 1e-12) << layers;
  }
}

/// A polygon of N sides that is stiff rolls over its corners, which lift it by b(1 - cos π/N), some
/// 5 b/N²: it bounces and loses a share of its speed of that order.
TEST(ThrownDisk, RollsInTheEnd) {
  const test::FloatingPointTraps traps;
  double before = 0.0;
  for (const int n : {60, 120, 240}) {
    const test::ThrownDisk disk{.columns = n, .layers = 4};
    const test::Rolling rolling = test::roll(disk);
    const double b = disk.outer;
    const double expected = disk.speed / (1.0 + rolling.squared_radius / (b * b));
    const double off = std::abs(rolling.speed / expected - 1.0);
    RecordProperty(fmt::format("N{}", n), fmt::format("{:.6f} {:.2e}", rolling.speed, off));
    EXPECT_LT(off, 20.0 / (n * n)) << n;
    if (before > 0.0) {
      EXPECT_LT(off, 0.35 * before) << n;
    }
    before = off;
    // It rolls: without slip, but for the corners and for the radius, on which it sinks by 1e-3 b.
    EXPECT_NEAR(rolling.rim / rolling.speed, 1.0, 30.0 / (n * n) + 1e-3) << n;
    // Free bodies: second order in the step (docs/theory.md, 9.7).
    EXPECT_LT(rolling.relative, 1e-6) << n;
  }
}

namespace {

/// Off center by the radius, so that friction sets both spinning.
struct TwoDisks {
  mesh::Mesh mesh;
  Model model;
};

TwoDisks two_disks(double friction) {
  TwoDisks two;
  const mesh::Disk disk{.outer_radius = 0.3,
                        .inner_radius = 0.15,
                        .radial = 4,
                        .circumferential = 48,
                        .grading = 1.0,
                        .tread = {}};
  two.mesh = test::free_disk(disk);
  mesh::Mesh other = test::free_disk(disk);
  const auto first = static_cast<int>(two.mesh.n_nodes());
  for (const Vec2 x : other.coordinates) two.mesh.coordinates.push_back(x + Vec2{0.3, 0.53});
  for (mesh::Cell cell : other.cells) {
    for (int& node : cell) node += first;
    two.mesh.cells.push_back(cell);
  }
  for (const int node : other.boundary) two.mesh.boundary.push_back(node + first);
  two.mesh.tributary.insert(two.mesh.tributary.end(), other.tributary.begin(),
                            other.tributary.end());
  for (const mesh::Edge& e : other.contact_edges)
    two.mesh.contact_edges.push_back({e[0] + first, e[1] + first});
  const fem::Material rubber{1.0e6, 0.3, 1000.0, fem::Plane::strain};
  two.model = test::body_model(two.mesh, rubber, 0.0, 0.0, 0.8);
  test::add_surfaces(two.model, two.mesh, {friction, 0.0});
  return two;
}

}  // namespace

TEST(TwoDisks, ACollisionKeepsLinearAndAngularMomentum) {
  double turned = 0.0;
  for (const double friction : {0.0, 0.5}) {
    const TwoDisks two = two_disks(friction);
    const std::vector<Vec2> none(two.model.n_nodes());
    std::vector<Vec2> v(two.model.n_nodes());
    for (std::size_t k = 0; k < v.size(); ++k)
      v[k] = two.model.free_body[k] == 0 ? Vec2{0.0, 1.0} : Vec2{-0.5, -2.0};
    test::Stepping run(two.model, start(two.model, none, v));
    const test::FloatingPointTraps traps;
    run.advance(1);
    const test::Momentum before = test::momentum(two.model, run.state());
    const double mass = two.model.free_bodies[0].mass, scale = mass * 2.0;  // times a velocity
    double linear = 0.0, angular = 0.0;
    int between = 0;
    while (run.report().frame.time < 0.3) {
      between = std::max(between, run.advance().between_bodies);
      const test::Momentum now = test::momentum(two.model, run.state());
      linear = std::max(linear, norm(now.linear - before.linear));
      angular = std::max(angular, std::abs(now.angular - before.angular));
    }
    EXPECT_GE(between, 3);
    EXPECT_EQ(run.report().contact.nodes, 0) << "they have parted";
    // Round-off of thousands of steps.
    EXPECT_LT(linear, 1e-11 * scale) << friction;
    EXPECT_LT(angular, 1e-11 * scale) << friction;
    RecordProperty(fmt::format("mu_{}", friction),
                   fmt::format("{:.1e} {:.1e}", linear / scale, angular / scale));
    // Friction turns them; without it only the corners of the polygons do, a little.
    const double turn = std::abs(run.state().poses[0].angle);
    RecordProperty(fmt::format("turn_{}", friction), fmt::format("{:.4f}", turn));
    if (friction > 0.0) {
      EXPECT_GT(turn, 3.0 * turned);
    }
    turned = turn;
  }
}

}  // namespace v08_thrown_disk
