// SPDX-License-Identifier: BSD-3-Clause
/// Friction of reduced wheels that depends on slip, pressure and place.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <span>

#include "rolling_wheel.hpp"
#include "rondo/contact/friction_table.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace wheel_friction_test {
using namespace rolling_wheel;
namespace {

using contact::FrictionTable;
using contact::Status;

const double length = 2.0 * pi * 0.3 / 180.0;  // of the boundary of a node [m]

/// Rises with the slip, and falls with the pressure, which is about 2 MPa.
FrictionTable rubber() {
  return {.coefficient = 0.4,
          .slip = {{0.0, 0.8}, {0.4, 1.0}, {3.0, 1.2}},
          .pressure_exponent = -0.15,
          .pressure_reference = 1e6,
          .patches = {}};
}

Rolling run_of(const FrictionTable& table) {
  return {.friction = contact::friction_of(table), .lengths = {length}};
}

/// The most by which shears miss the friction of the table at their own slip and pressure, over
/// the largest force; of a step without patches.
double missed(const WheelReport& report, const FrictionTable& table, double dt) {
  double worst = 0.0, largest = 1e-300;
  for (const WheelContact& c : report.contacts) {
    const double normal = dot(c.normal, c.force);
    const double slip = c.status == Status::slip ? std::abs(c.slip) / dt : 0.0;
    const double most =
        normal * contact::friction_at(table, {{}, slip, normal / length}).coefficient;
    const double shear = std::abs(dot(tangent_of(c.normal), c.force));
    worst = std::max(worst, c.status == Status::slip ? std::abs(shear - most) : shear - most);
    largest = std::max(largest, normal);
  }
  return worst / largest;
}

TEST(GapLaw, FollowsTheTangentOfTheFriction) {
  constexpr double compliance = 2e-8, by_slip = 50.0, at = 1e-3, mu = 0.3;
  GapLaw law(1);
  std::vector<GapContact> contacts(1);
  GapContact& c = contacts[0];
  c.free_gap = -2e-4;
  c.free_slip = 3e-3;
  c.friction = mu;
  c.by_slip = by_slip;
  c.slip_at = at;
  c.normal_at = 1e4;
  law.compliance(1) = compliance * Eigen::Matrix2d::Identity();
  EXPECT_LE(law.solve(contacts).residual, 1e-12);
  EXPECT_NEAR(c.normal, 1e4, 1e-8);
  EXPECT_EQ(c.status, Status::slip);
  EXPECT_NEAR(-c.shear, 1e4 * (mu + by_slip * (c.slip - at)), 1e-8);
  EXPECT_NEAR(c.slip, 3e-3 + compliance * c.shear, 1e-15);
}

/// Dense compliances that are not symmetric, and coefficients far from each other.
TEST(GapLaw, EachContactHasItsOwnCoefficientThroughPivotingToo) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  constexpr int m = 6;
  GapLaw law(m);
  int pivoted = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<GapContact> contacts(m);
    Eigen::MatrixXd g = Eigen::MatrixXd::NullaryExpr(2 * m, 2 * m, [&] { return spread(random); });
    const Eigen::MatrixXd w = g * g.transpose() / m + 0.1 * Eigen::MatrixXd::Identity(2 * m, 2 * m);
    law.compliance(m) = w;
    for (int i = 0; i < m; ++i) {
      GapContact& c = contacts[static_cast<std::size_t>(i)];
      c.free_gap = spread(random);
      c.free_slip = spread(random);
      c.friction = 0.3 * i;
    }
    const GapLaw::Report report = law.solve(contacts);
    if (report.residual > 1e-9) continue;  // a law without a solution
    pivoted += report.pivoted ? 1 : 0;
    for (const GapContact& c : contacts) {
      EXPECT_LE(std::abs(c.shear), c.friction * c.normal + 1e-9) << trial;
      if (c.status == Status::slip && c.friction > 0.0) {
        EXPECT_NEAR(std::abs(c.shear), c.friction * c.normal, 1e-9) << trial;
      }
    }
  }
  EXPECT_GT(pivoted, 0);
}

/// A law whose coefficient is the same everywhere makes the steps of the number.
TEST(WheelFriction, ALawOfOneNumberHasItsBits) {
  Rolling run{.friction = contact::Friction([](const contact::SlidingState&) { return 0.4; }),
              .end = 0.05,
              .lengths = {length}};
  const Outcome law = outcome(run), number = outcome({.end = 0.05});
  EXPECT_EQ(law.forces, number.forces);
}

TEST(WheelFriction, IsThatOfTheSlipAndThePressureOfTheStep) {
  const OneBlasThread one;
  const FrictionTable table = rubber();
  Wheel w(disk(), run_of(table));
  double energy = 0.0, unbalanced = 0.0, largest = 0.0;
  int slipping = 0;
  for (int i = 0; i < 300; ++i) {
    const WheelReport r = w.wheel.step(w.motion.at(i));
    ASSERT_FALSE(r.late) << i;
    ASSERT_LE(r.law_residual, 1e-9) << i;
    ASSERT_LE(missed(r, table, w.dt), 2e-9) << i;
    for (const WheelContact& c : r.contacts) slipping += c.status == Status::slip ? 1 : 0;
    const double now = total(r.energy);
    if (i > 0) unbalanced = std::max(unbalanced, std::abs(now - energy - change(r.energy)));
    largest = std::max(largest, std::abs(now));
    energy = now;
  }
  EXPECT_GT(slipping, 300);
  EXPECT_LE(unbalanced, 1e-11 * largest);
}

/// Steady rolling of the same mesh with this table (`cases/steady-rolling.toml`, eight samples per
/// sector, massless contact): -21,772 and 190,089 N/m. The constant 0.4 is 0.4 % of F_y away.
TEST(WheelFriction, HasTheForcesOfSteadyRolling) {
  const Outcome o = outcome(run_of(rubber()));
  EXPECT_NEAR(o.x, -21772.0, 0.0016 * o.y);
  EXPECT_NEAR(o.y, 190089.0, 0.001 * o.y);
  EXPECT_GT(std::abs(outcome({}).x - -21772.0), 0.002 * o.y);
}

/// From x = 1 m on there is a tenth of the friction.
TEST(WheelFriction, IsThatOfThePlace) {
  const OneBlasThread one;
  Wheel w(disk(), run_of({.coefficient = 0.4,
                          .slip = {},
                          .patches = {{.from = 1.0, .to = 9.0, .factor = 0.1}}}));
  int before = 0, behind = 0;
  for (int i = 0; (i + 1) * w.dt < 0.12; ++i) {
    const double ahead = w.motion.at(i).center.x - 1.0;  // contact is 0.15 m long
    const WheelReport r = w.wheel.step(w.motion.at(i));
    if (r.force.y < 1e5) continue;
    if (ahead < -0.1 && ahead > -0.3) {
      ++before;
      EXPECT_GT(std::abs(r.force.x), 0.06 * r.force.y) << i;
    }
    if (ahead > 0.1) {
      ++behind;
      EXPECT_LE(std::abs(r.force.x), 0.04 * r.force.y * (1.0 + 1e-9)) << i;
    }
  }
  EXPECT_GT(before, 20);
  EXPECT_GT(behind, 20);
}

TEST(WheelFriction, ResumesToTheSameBits) {
  const OneBlasThread one;
  const Rolling run = run_of(rubber());
  Wheel whole(disk(), run), second(disk(), run);
  for (int i = 0; i < 200; ++i) static_cast<void>(whole.wheel.step(whole.motion.at(i)));
  const std::vector<double> numbers = whole.wheel.save();
  EXPECT_EQ(numbers.size(), RingWheel::n_numbers(whole.ring, whole.model, run.friction));
  EXPECT_TRUE(RingWheel::is_saved(whole.ring, whole.model, run.friction, numbers));
  EXPECT_FALSE(RingWheel::is_saved(whole.ring, whole.model, 0.4, numbers));
  second.wheel.restore(numbers);
  for (int i = 200; i < 300; ++i) {
    const WheelReport a = whole.wheel.step(whole.motion.at(i)),
                      b = second.wheel.step(second.motion.at(i));
    ASSERT_EQ(a.force, b.force) << i;
    ASSERT_EQ(a.iterations, b.iterations) << i;
  }
}

/// Where nodes stick and slip in turn, there is no coefficient of the step itself.
TEST(WheelFriction, TakesThatOfTheStepBeforeWhereItFallsSteeply) {
  const OneBlasThread one;
  const FrictionTable table{.coefficient = 0.4, .slip = {{0.0, 1.0}, {0.2, 0.5}}, .patches = {}};
  Wheel w(disk(), run_of(table));
  std::map<int, double> slips, known;  // of the step before; of nodes that touched before it too
  int late = 0, compared = 0;
  for (int i = 0; i < 300; ++i) {
    const WheelReport r = w.wheel.step(w.motion.at(i));
    late += r.late ? 1 : 0;
    ASSERT_LE(r.law_residual, 1e-9) << i;
    std::map<int, double> now;
    for (const WheelContact& c : r.contacts) {
      now[c.node] = std::abs(c.slip) / w.dt;
      if (!r.late || !known.contains(c.node)) continue;
      const double mu = contact::friction_at(table, {{}, known[c.node], 0.0}).coefficient;
      const double most = mu * dot(c.normal, c.force),
                   shear = std::abs(dot(tangent_of(c.normal), c.force));
      ASSERT_LE(shear, most + 1e-9 * r.force.y) << i;
      if (c.status != Status::slip) continue;
      ++compared;
      ASSERT_NEAR(shear, most, 1e-9 * r.force.y) << i;
    }
    known.clear();
    for (const auto& [node, slip] : now)
      if (slips.contains(node)) known[node] = slip;
    slips = now;
  }
  EXPECT_GT(late, 10);
  EXPECT_LT(late, 290);
  EXPECT_GT(compared, 10);
}

}  // namespace
}  // namespace wheel_friction_test
}  // namespace rondo::rom
