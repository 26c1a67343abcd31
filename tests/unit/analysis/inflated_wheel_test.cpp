// SPDX-License-Identifier: BSD-3-Clause
/// Wheels about an equilibrium at finite strain: curves of cords, and what is built on the state.
#include <gtest/gtest.h>

#include <cmath>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/tyre/curves.hpp"
#include "rondo/analysis/build/tyre/wheel_at_rest.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/solid/solid_integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::inflated_wheel_test {
namespace {

/// Two plies of stretched cords in a solid wheel twist it and press it together.
const std::string wheel = R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.20
width = 0.1
[disk.mesh]
radial = 3
circumferential = 24
axial = 2
[material]
model = "neo-hooke"
shear_modulus = 1.0e6
poissons_ratio = 0.45
density = 1000.0
[[cords]]
curve = "layer-1"
angle = -0.4
stiffness = 1.0e4
spacing = 2.0e-3
prestrain = 0.02
excess_mass = 1.0e-3
[[cords]]
curve = "layer-2"
angle = 0.4
stiffness = 1.0e4
spacing = 2.0e-3
prestrain = 0.02
[inflation]
[damping]
mass = 20.0
stiffness = 2.0e-6
[motion]
angular_velocity = 30.0
speed = 9.0
height = [[0.0, 0.30], [0.004, 0.294]]
slip_angle = 0.02
[ground]
profile = "flat"
friction = 0.5
[time]
end = 0.01
)";

Case of(const std::vector<std::string>& settings = {}) {
  return test::read_text(wheel, settings);
}

/// A curve of these edges, over five nodes on a line and one beside it.
mesh::Mesh section(std::vector<mesh::Edge> edges) {
  mesh::Mesh m;
  m.coordinates = {{0.2, 0.0}, {0.2, 0.1}, {0.2, 0.2}, {0.2, 0.3}, {0.2, 0.4}, {0.3, 0.2}};
  m.curves = {{"ply", std::move(edges)}};
  return m;
}

std::string refusal_of(const mesh::Mesh& m) {
  try {
    static_cast<void>(directed_curve(of(), m, "cords[0].curve", "ply"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

}  // namespace

TEST(DirectedCurve, GoesFromSmallerZToLarger) {
  using Edges = std::vector<mesh::Edge>;
  const Edges expected{{0, 1}, {1, 2}, {2, 3}};
  EXPECT_EQ(directed_curve(of(), section({{2, 1}, {2, 3}, {1, 0}}), "k", "ply"), expected);
  EXPECT_EQ(directed_curve(of(), section({{3, 2}, {0, 1}, {1, 2}}), "k", "ply"), expected);
  // At equal z outwards, and two lines that do not meet.
  EXPECT_EQ(directed_curve(of(), section({{5, 2}, {4, 3}}), "k", "ply"), (Edges{{2, 5}, {3, 4}}));
}

TEST(DirectedCurve, IsALine) {
  EXPECT_NE(refusal_of(section({{0, 1}, {1, 2}, {2, 0}})).find("closed"), std::string::npos);
  EXPECT_NE(refusal_of(section({{0, 1}, {1, 2}, {1, 5}})).find("branches at r = 0.2, z = 0.1 m"),
            std::string::npos);
}

TEST(InflatedWheel, TheMeshIsMovedAndTheMassStays) {
  const study::Setup s = build(of(), 1);
  ASSERT_TRUE(s.inflation);
  double mass = 0.0, radius = 0.0, twist = 0.0;
  for (std::size_t k = 0; k < s.model.n_nodes(); ++k) {
    mass += s.model.mass[k];
    radius = std::max(radius, norm(s.model.reference[k]));
  }
  for (std::size_t k = 0; k < s.model.n_nodes() / 24; ++k)  // sector 0 begins straight down
    twist = std::max(twist, std::abs(s.model.reference[k].x));
  EXPECT_NEAR(mass, s.inflation->mass, 1e-12 * mass);
  EXPECT_NEAR(radius, s.inflation->outer_radius, 1e-15);
  EXPECT_NEAR(twist, s.inflation->twist, 1e-12);
  EXPECT_GT(twist, 1e-5);
  EXPECT_FALSE(s.materials[0].rubber);
  EXPECT_TRUE(s.critical.proven);
  // Contact nodes have the area of the surface as it is.
  double area = 0.0;
  for (const double part : s.mesh.tributary) area += part;
  EXPECT_NEAR(area, 2.0 * 3.14159 * radius * 0.1, 0.03 * area);
}

/// Turning at the spin of the equilibrium, nothing moves before the ground is there.
TEST(InflatedWheel, TheFastStepIsTheReadableOne) {
  for (const char* rest : {"inflation.spin=30", "inflation.spin=12"}) {
    SCOPED_TRACE(rest);
    const study::Setup s = build(of({rest}), 1);
    const dynamics::State start = dynamics::start(s.model, s.displacement, s.velocity);
    const auto fast = dynamics::make_integrator(s.model, start);
    dynamics::SolidIntegrator readable(s.model, start);
    const auto n = static_cast<std::size_t>(s.n_steps);
    std::vector<dynamics::StepReport> a(n), b(n);
    dynamics::State end(s.model), other(s.model);
    fast->advance(a, &end);
    readable.advance(b, &other);
    double difference = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < s.model.n_nodes(); ++k) {
      difference = std::max(difference, norm(end.u.space()[k] - other.u.space()[k]));
      largest = std::max(largest, norm(end.u.space()[k]));
    }
    EXPECT_GT(largest, 1e-4);
    EXPECT_LT(difference, 1e-11 * largest);
    EXPECT_LT(a.back().balance.relative, 1e-12);
    EXPECT_LT(b.back().balance.relative, 1e-12);
    EXPECT_NEAR(a.back().balance.works.load, b.back().balance.works.load,
                1e-11 * std::abs(b.back().balance.exchanged));
  }
}

/// The state, started where it is, is at rest; without its pull it would not be.
TEST(InflatedWheel, StandsStillInTheFrameOfItsSpin) {
  const study::Setup s = build(of({"motion.height=0.4", "motion.slip_angle=0"}), 1);
  const dynamics::State start = dynamics::start(s.model, s.displacement, s.velocity);
  const auto integrator = dynamics::make_integrator(s.model, start);
  std::vector<dynamics::StepReport> reports(static_cast<std::size_t>(s.n_steps));
  dynamics::State end(s.model);
  integrator->advance(reports, &end);
  for (const Vec3 u : end.u.space()) EXPECT_LT(norm(u), 1e-15);
  EXPECT_FALSE(s.model.solid->pressures.empty());
}

/// Driven by a torque on its rim, it gains the torque's angular momentum: the rim feels also the
/// forces that hold the state at rest.
TEST(InflatedWheel, ATorqueOnItsRimIsItsAngularMomentum) {
  constexpr double torque = 400.0;
  const study::Setup s = build(of({"motion.height=0.4", "motion.slip_angle=0", "damping.mass=0",
                                   "time.step=5e-6", "rim.free=['angular_velocity']",
                                   "rim.inertia=0.05", "rim.torque=" + std::to_string(torque)}),
                               1);
  const dynamics::Model& m = s.model;
  const auto integrator =
      dynamics::make_integrator(m, dynamics::start(m, s.displacement, s.velocity));
  double bonded = 0.0;
  for (const int node : s.mesh.clamped)
    bonded += m.mass[static_cast<std::size_t>(node)] *
              norm_squared(Complex{m.reference[static_cast<std::size_t>(node)].x,
                                   m.reference[static_cast<std::size_t>(node)].y});
  const auto momentum_after = [&](std::size_t steps) {
    std::vector<dynamics::StepReport> reports(steps);
    dynamics::State at(m);
    integrator->advance(reports, &at);
    const double spin = at.frame.spin;  // about the mean of the half steps beside it
    double sum = (0.05 + bonded) * spin;
    for (const int node : m.free) {
      const auto k = static_cast<std::size_t>(node);
      const Vec2 y = m.reference[k] + at.u.space()[k].plane();
      const Vec2 v = 0.5 * (at.v.space()[k] + at.v_next.space()[k]).plane();
      sum += m.mass[k] * (cross(y, v) + spin * dot(y, y));
    }
    return std::pair{sum, at.frame.time};
  };
  const auto [before, from] = momentum_after(3);
  const auto [after, to] = momentum_after(1000);
  EXPECT_NEAR((after - before) / (-torque * (to - from)), 1.0, 1e-4);
}

TEST(InflatedWheel, ARunOfTheSameSpinSharesItsBody) {
  EXPECT_EQ(body_key(of({"motion.speed=8"})), body_key(of()));
  EXPECT_NE(body_key(of({"motion.angular_velocity=20"})), body_key(of()));
  EXPECT_EQ(body_key(of({"motion.angular_velocity=20", "inflation.spin=30"})),
            body_key(of({"motion.angular_velocity=31", "inflation.spin=30"})));
}

}  // namespace rondo::study::inflated_wheel_test
