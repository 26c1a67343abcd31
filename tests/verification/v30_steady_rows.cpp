// SPDX-License-Identifier: BSD-3-Clause
/// Steady rolling solved directly: speeds, treads, free rolling, what samples and masses do
/// (docs/validation.md, V30).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "rondo/modal/critical_speeds.hpp"
#include "support/steady_body.hpp"

namespace v30_steady_rows {

using namespace rondo;
using namespace rondo::statics;

namespace {

/// At V = ωR.
test::DiskCase rolling_at(double spin) {
  test::DiskCase c = test::rolling_disk(12, 180);
  c.motion.angular_velocity = dynamics::Table(spin);
  return c;
}

RollingDrive freely_at(double spin, double friction) {
  RollingDrive d = test::at_height(friction);
  d.speed = 0.3 * spin;
  return d;
}

/// Force of the ground at each of the P places of a pass.
std::vector<Vec2> over_a_pass(const RollingWindow<2>& w, const RollingSolution& s) {
  const int samples = w.harmonics().body().samples;
  std::vector<Vec2> force(static_cast<std::size_t>(samples));
  for (std::size_t j = 0; j < w.pairs().size(); ++j) {
    const int place = (w.pairs()[j].sample % samples + samples) % samples;
    const auto row = static_cast<Eigen::Index>(2 * j);
    force[static_cast<std::size_t>(place)] += {s.force[row + 1], s.force[row]};
  }
  return force;
}

/// Root mean square about the mean.
Vec2 deviation(const std::vector<Vec2>& values) {
  Vec2 mean, square;
  const auto n = static_cast<double>(values.size());
  for (const Vec2& v : values) mean += v / n;
  for (const Vec2& v : values)
    square += Vec2{std::pow(v.x - mean.x, 2), std::pow(v.y - mean.y, 2)} / n;
  return {std::sqrt(square.x), std::sqrt(square.y)};
}

}  // namespace

TEST(SteadyRollingRows, LoadGrowsWithSpeed) {
  for (const auto& [speed, load] :
       {std::pair{30.0, 206585.0}, {40.0, 220940.0}, {50.0, 239321.0}}) {
    const test::SteadyBody b(rolling_at(speed / 0.3), 4, true);
    RollingWindow<2> w = b.window(SlipDifference::upwind);
    const RollingSolution s = test::solved(w, freely_at(speed / 0.3, 0.4));
    EXPECT_NEAR(s.forces.normal, load, 0.6) << speed;
  }
}

/// The forces that V18 tends to when its mesh is refined.
TEST(SteadyRollingRows, FineMesh) {
  test::DiskCase c = test::rolling_disk(48, 5760);
  c.disk.grading = 2.0;
  const test::SteadyBody b(c, 1, true);
  struct Row {
    double friction, x, y;
  };
  for (const Row& row : {Row{0.0, 0.0, 189819.0}, Row{0.2, -21276.0, 189959.0},
                         Row{0.4, -24898.0, 190093.0}, Row{0.6, -26056.0, 190187.0}}) {
    RollingWindow<2> w = b.window(SlipDifference::upwind);
    const RollingSolution s = test::solved(w, test::at_height(row.friction));
    EXPECT_NEAR(s.forces.heading, row.x, 0.6) << row.friction;
    EXPECT_NEAR(s.forces.normal, row.y, 0.6) << row.friction;
  }
}

TEST(SteadyRollingRows, Tread) {
  test::DiskCase c = test::rolling_disk(9, 0);
  c.disk.tread = mesh::Tread{60, 0.02, 3, 1, 2};
  const test::SteadyBody b(c, 24, true);
  struct Row {
    double friction, x, y;
  };
  for (const Row& row :
       {Row{0.0, 0.0, 170467.0}, Row{0.3, -19750.0, 172272.0}, Row{0.6, -20871.0, 173815.0}}) {
    RollingWindow<2> w = b.window(SlipDifference::bdf2);
    const RollingSolution s = test::solved(w, test::at_height(row.friction));
    EXPECT_NEAR(s.forces.heading, row.x, 0.6) << row.friction;
    EXPECT_NEAR(s.forces.normal, row.y, 0.6) << row.friction;
    const Vec2 d = deviation(over_a_pass(w, s));
    if (row.friction == 0.3) {
      EXPECT_NEAR(d.x, 467.0, 0.6);
      EXPECT_NEAR(d.y, 1120.0, 0.6);
    }
  }
}

TEST(SteadyRollingRows, RollingResistanceWithoutTorque) {
  const test::SteadyBody b(rolling_at(33.333333), 1, false);
  for (const auto& [friction, traction] : {std::pair{0.2, -298.0}, {0.4, -296.0}}) {
    RollingWindow<2> w = b.window(SlipDifference::upwind);
    RollingDrive d = test::at_height(friction);
    d.load = 1.9e5;
    d.torque = 0.0;
    const RollingSolution s = test::solved(w, d);
    EXPECT_NEAR(s.forces.heading, traction, 0.6) << friction;
    EXPECT_NEAR(s.forces.normal, 1.9e5, 1e-10 * 1.9e5);
    EXPECT_NEAR(s.forces.torque, 0.0, 1e-10 * 0.3 * 1.9e5);
  }
}

namespace {

/// Change of the forces, over the load, when the mesh is turned by half a sample.
Vec2 moved_by_half_a_sample(int samples, bool massless, SlipDifference slip, double friction) {
  RollingForces force[2];
  for (const int turned : {0, 1}) {
    const double angle = turned * std::numbers::pi / (180.0 * samples);
    const test::SteadyBody b(rolling_at(33.333333), samples, massless, angle);
    RollingWindow<2> w = b.window(slip);
    force[turned] = test::solved(w, test::at_height(friction)).forces;
  }
  return {(force[1].heading - force[0].heading) / force[0].normal,
          force[1].normal / force[0].normal - 1.0};
}

}  // namespace

/// Of one sample a pass the traction moves by 3.5 % of itself.
TEST(SteadyRollingRows, WhereTheSamplesSitDoesNotMatterWithEight) {
  const Vec2 one = moved_by_half_a_sample(1, false, SlipDifference::upwind, 0.2);
  EXPECT_NEAR(one.x, -0.00313, 1e-4);
  EXPECT_NEAR(one.y, -0.00264, 1e-4);
  for (const double friction : {0.2, 0.4, 0.6}) {
    const Vec2 eight = moved_by_half_a_sample(8, true, SlipDifference::bdf2, friction);
    EXPECT_LT(std::abs(eight.x), 0.001) << friction;
    EXPECT_LT(std::abs(eight.y), 1e-4) << friction;
  }
}

/// Contact nodes with mass chatter: what is found does not meet the law, and is not called solved.
TEST(SteadyRollingRows, MassOnContactNodesFailsAndSaysSo) {
  for (const bool massless : {false, true}) {
    const test::SteadyBody b(rolling_at(100.0), 4, massless);
    RollingWindow<2> w = b.window(SlipDifference::upwind);
    const RollingSolution s = solve_rolling(w, freely_at(100.0, 0.6));
    EXPECT_EQ(s.end == RollingEnd::solved, massless);
    EXPECT_EQ(rolling_residual(w, s, 0.6) < 1e-9, massless);
  }
}

TEST(SteadyRollingRows, CriticalSpinOfTheMesh) {
  const test::SteadyBody b(rolling_at(33.333333), 1, false);
  const modal::CyclicBody<2> body{b.sector, b.mass, b.mesh.coordinates};
  EXPECT_TRUE(modal::critical_speeds_up_to(body, 181.77).empty());
  const auto found = modal::critical_speeds_up_to(body, 181.79);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].diameters, 90);
  EXPECT_NEAR(found[0].spin, 181.780, 5e-4);
}

}  // namespace v30_steady_rows
