// SPDX-License-Identifier: BSD-3-Clause
/// Reduced wheels with exact contact: numbers of an independent implementation of the same method,
/// and what must hold whatever the numbers.
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "rolling_wheel.hpp"

namespace rondo::rom {
namespace ring_wheel_test {
using namespace rolling_wheel;
TEST(RingHarmonics, FrequenciesAreThoseOfARingWithoutMassAtItsContact) {
  const Ring ring = disk().ring();
  const auto expect = [&](int k, double a, double b, double c) {
    const Eigen::VectorXd f = frequencies_of(ring, k);
    EXPECT_NEAR(f[0], a, 1e-6) << k;
    EXPECT_NEAR(f[1], b, 1e-6) << k;
    EXPECT_NEAR(f[2], c, 1e-6) << k;
  };
  expect(0, 552.073678, 1699.881599, 2556.560515);
  expect(1, 735.354940, 1673.900434, 2690.485774);
  expect(2, 1068.058165, 1695.088023, 3015.429895);
  expect(5, 1710.994441, 2678.304613, 4221.232858);
  expect(10, 2962.073193, 4465.820969, 5355.153536);
}

TEST(RingHarmonics, TheLowestModesAreTakenAndThoseOfTwoRealNumbersCountTwice) {
  const Ring ring = disk().ring();
  const auto modes = ring_modes(ring, {.wanted = 40});
  EXPECT_EQ(count_modes(modes), 41);
  std::vector<Eigen::Index> sizes;
  for (const RingHarmonic& h : modes) {
    sizes.push_back(h.squares.size());
    const Eigen::MatrixXcd j = h.coriolis;
    EXPECT_EQ((j + j.adjoint()).norm(), 0.0);
  }
  EXPECT_EQ(sizes, (std::vector<Eigen::Index>{3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 1}));
  EXPECT_EQ(count_modes(ring_modes(ring, {.wanted = 20})), 20);
  EXPECT_EQ(count_modes(ring_modes(ring, {.wanted = 40, .highest = 1000.0, .fewest = 10})), 11);
}

/// The sector of these disks has its first axis along the tangent, its second along the radius.
TEST(RingHarmonics, TheResidualIsTheComplianceThatTheModesLeave) {
  const Ring ring = disk().ring();
  const double square = std::pow(100.0 / 3.0, 2);
  const auto expect = [&](const RingResidual& g, int lag, double rr, double rt, double tt) {
    EXPECT_NEAR(1e8 * g.block(lag)(1, 1), rr, 6e-9) << lag;
    EXPECT_NEAR(1e8 * g.block(lag)(1, 0), -rt, 6e-9) << lag;
    EXPECT_NEAR(1e8 * g.block(lag)(0, 1), rt, 6e-9) << lag;
    EXPECT_NEAR(1e8 * g.block(lag)(0, 0), tt, 6e-9) << lag;
  };
  const RingResidual all = ring_residual(ring, {}, square, ResidualForm::convected);
  expect(all, 0, 12.45549444, 0.0, 17.56140959);
  expect(all, 1, 6.41340481, -0.551936031, 13.752330335);
  expect(all, 5, 2.204972561, -0.065861575, 8.917220456);
  expect(ring_residual(ring, {}, square, ResidualForm::still), 0, 12.40101696, 0.0, 17.53264242);
  const auto modes = ring_modes(ring, {.wanted = 20});
  const RingResidual rest = ring_residual(ring, modes, square, ResidualForm::convected);
  expect(rest, 0, 9.241287529, 0.0, 9.600339950);
  expect(rest, 1, 3.222878153, -0.562581345, 5.800770005);
  EXPECT_TRUE(rest.made_static.empty());
}

/// With a step of 0.4 ms.
TEST(RingWheel, TheComplianceOfAStepHasTheModesAnswer) {
  const auto expect = [](int modes, double rr, double rt, double tt) {
    const Rolling run{.modes = modes, .passes = 2.0 * pi / 180.0 / (100.0 / 3.0) / 4e-4};
    Wheel w(disk(), run);
    const auto block = w.wheel.compliance(0);
    EXPECT_NEAR(1e8 * block(1, 1), rr, 6e-9) << modes;
    EXPECT_NEAR(1e8 * block(0, 0), tt, 6e-9) << modes;
    EXPECT_NEAR(1e8 * block(1, 0), -rt, 6e-9) << modes;
    EXPECT_NEAR(1e8 * block(0, 1), rt, 6e-9) << modes;
  };
  expect(0, 11.86237566, 0.0, 16.72515199);  // G[0]/(1 + β/Δt)
  expect(20, 9.115880366, -0.003820086, 9.456234894);
  expect(40, 8.302183331, -0.012059623, 8.5272255);
}

/// Beyond the critical spin of a harmonic that no mode has, 154.8 rad/s of k = 89.
TEST(RingHarmonics, AHarmonicBeyondItsCriticalSpinIsMadeStatic) {
  const Ring ring = disk().ring();
  const auto modes = ring_modes(ring, {.wanted = 20});
  EXPECT_TRUE(
      ring_residual(ring, modes, 153.0 * 153.0, ResidualForm::convected).made_static.empty());
  const auto beyond = ring_residual(ring, modes, 156.0 * 156.0, ResidualForm::convected);
  ASSERT_FALSE(beyond.made_static.empty());
  EXPECT_EQ(beyond.made_static.back(), 89);
}

struct Row {
  Rolling run;
  double x, y, deviation;
};

class WheelRows : public testing::TestWithParam<Row> {};

/// Forces of an independent implementation, to what it printed.
TEST_P(WheelRows, AreMetToTheDigit) {
  const Row& row = GetParam();
  const Outcome o = outcome(row.run);
  EXPECT_NEAR(o.x, row.x, 0.1);
  EXPECT_NEAR(o.y, row.y, 0.06);
  EXPECT_NEAR(o.deviation, row.deviation, 0.6);
  EXPECT_LE(o.residual, 1e-9);
  EXPECT_LE(o.unbalanced, 1e-11 * o.energy);
}

INSTANTIATE_TEST_SUITE_P(
    All, WheelRows,
    testing::Values(Row{{.friction = 0.0}, 0.0, 189685.7, 862},
                    Row{{.friction = 0.2}, -18427.7, 189936.8, 808},
                    Row{{.friction = 0.4}, -22239.8, 190121.7, 724},
                    Row{{.friction = 0.6}, -23493.2, 190255.6, 687},
                    Row{{.modes = 40, .friction = 0.2}, -18203.0, 189932.8, 863},
                    Row{{.modes = 40}, -21945.1, 190116.3, 757},
                    Row{{.modes = 0}, -22026.1, 190199.5, 311},
                    Row{{.modes = 40, .form = ResidualForm::still}, -22014.0, 190144.2, 740},
                    Row{{.modes = 40, .slip = SlipRule::bdf2}, -21848.9, 190119.2, 756},
                    Row{{.passes = 1.618033989}, -22013.8, 190121.8, 755},
                    Row{{.modes = 40, .passes = 4.0}, -21935.5, 190103.8, 795},
                    Row{{.modes = 40, .passes = 8.0}, -21921.6, 190105.0, 841}));

/// Works of the same run by two implementations [J/m].
TEST(RingWheel, TheLedgerHasTheWorksOfAnother) {
  const Outcome o = outcome({.modes = 40, .friction = 0.3});
  EXPECT_NEAR(o.sums.by_mass, 351.9, 0.5);
  EXPECT_NEAR(o.sums.by_stiffness, 110.3, 0.2);
  EXPECT_NEAR(o.sums.by_residual, 146.0, 0.6);
  // Friction by the mean of the forces at both ends of a step, where they stood: near that of small
  // steps, and none of it without a coefficient.
  const Outcome fine = outcome({.modes = 40, .passes = 20.618, .friction = 0.3});
  EXPECT_NEAR(o.sums.friction, fine.sums.friction, 0.005 * fine.sums.friction);
  const Outcome none = outcome({.modes = 40, .friction = 0.0});
  EXPECT_NEAR(none.sums.friction, 0.0, 1e-9 * fine.sums.friction);
  EXPECT_NEAR(o.sums.arrival, 68.4, 0.3);
}

TEST(RingWheel, BackwardsIsTheMirror) {
  const Outcome forwards = outcome({}), backwards = outcome({.spin = -100.0 / 3.0, .speed = -10.0});
  EXPECT_NEAR(backwards.x, -forwards.x, 0.5);
  EXPECT_NEAR(backwards.y, forwards.y, 0.5);
}

/// The wheel rolls on the same nodes, wherever they are at the start.
TEST(RingWheel, TheAngleAtTheStartChangesNothing) {
  const Outcome here = outcome({});
  for (const double part : {0.25, 0.5, 0.8}) {
    const Outcome there = outcome({.angle = part * 2.0 * pi / 180.0});
    EXPECT_NEAR(there.x, here.x, 2e-4 * here.y) << part;
    EXPECT_NEAR(there.y, here.y, 2e-4 * here.y) << part;
  }
}

TEST(RingWheel, FiveSecondsDoNotDrift) {
  const Outcome shorter = outcome({.friction = 0.3, .end = 0.4}),
                longer = outcome({.friction = 0.3, .end = 5.0});
  EXPECT_NEAR(longer.x, shorter.x, 5.0);
  EXPECT_NEAR(longer.y, shorter.y, 5.0);
  EXPECT_NEAR(longer.deviation, shorter.deviation, 9.0);
  EXPECT_LE(longer.unbalanced, 1e-11 * longer.energy);
}

/// Contact at the mean of both ends of a step rings where nothing damps.
TEST(RingWheel, WithoutDampingAForceWeightedToTheEndDoesNotRing) {
  EXPECT_LT(outcome({.modes = 40, .friction = 0.3, .end = 1.5, .damped = false}).deviation, 2500.0);
  EXPECT_GT(
      outcome({.modes = 40, .friction = 0.3, .theta = 0.5, .end = 1.5, .damped = false}).deviation,
      2e4);
}

/// Without the inertia that the modes left out have, the force grows with the speed.
TEST(RingWheel, TheConvectedResidualHasTheInertiaThatTheStaticOneLacks) {
  const Rolling fast{.modes = 0, .spin = 100.0, .speed = 30.0};
  Rolling still = fast, many = fast;
  still.form = ResidualForm::still;
  many.modes = 40;
  const double y = outcome(many).y;
  EXPECT_NEAR(outcome(fast).y, y, 2e-3 * y);
  EXPECT_GT(outcome(still).y, 1.02 * y);
}

/// F = 187,953 N/m without friction and 188,214 with μ = 0.6, of the full disk 187,838 and 188,121.
TEST(RingWheel, AWheelThatStandsIsCrushed) {
  const auto standing = [](double friction) {
    return outcome({.modes = 40, .friction = friction, .spin = 0.0, .speed = 0.0, .end = 0.4});
  };
  EXPECT_NEAR(standing(0.0).y, 187953.0, 30.0);
  EXPECT_NEAR(standing(0.6).y, 188214.0, 30.0);
  EXPECT_NEAR(standing(0.6).x, 0.0, 1.0);
}

TEST(RingWheel, ALockedWheelSlides) {
  const Outcome o = outcome({.modes = 40, .friction = 0.3, .spin = 0.0, .speed = 10.0});
  EXPECT_NEAR(o.x, -0.3 * o.y, 1.0);
  EXPECT_NEAR(o.y, 187710.0, 60.0);
}

TEST(RingWheel, ResumesToTheSameBits) {
  const OneBlasThread one;
  const Rolling run{
      .ground = {.profile = {{-10, -0.03}, {1.0, -0.03}, {1.0, 0}, {10, 0}}, .fillet = 0.02}};
  Wheel whole(disk(), run), first(disk(), run), second(disk(), run);
  for (int i = 0; i < 260; ++i) {
    static_cast<void>(whole.wheel.step(whole.motion.at(i)));
    static_cast<void>(first.wheel.step(first.motion.at(i)));
  }
  second.wheel.restore(first.wheel.save());
  for (int i = 260; i < 400; ++i) {
    const WheelReport a = whole.wheel.step(whole.motion.at(i)),
                      b = second.wheel.step(second.motion.at(i));
    ASSERT_EQ(a.force, b.force) << i;
    ASSERT_EQ(total(a.energy), total(b.energy)) << i;
    ASSERT_EQ(a.energy.scheme, b.energy.scheme) << i;
  }
}

TEST(RingWheel, WhatItDidNotSaveIsNotRestored) {
  const Wheel w(disk(), {});
  const std::vector<double> numbers = w.wheel.save();
  const auto fits = [&](std::size_t back, double value) {
    std::vector<double> other = numbers;
    other[other.size() - back] = value;
    return RingWheel::is_saved(w.ring, w.model, 0.0, other);
  };
  EXPECT_TRUE(RingWheel::is_saved(w.ring, w.model, 0.0, numbers));
  EXPECT_FALSE(
      RingWheel::is_saved(w.ring, w.model, 0.0, std::span(numbers).first(numbers.size() - 1)));
  EXPECT_FALSE(fits(1, 0.5));           // side
  EXPECT_FALSE(fits(2, 1e300));         // status
  EXPECT_FALSE(fits(3, 4.0));           // known places
  EXPECT_FALSE(fits(7, std::nan("")));  // a place
}

/// The energy of the start is that of its fields: modes that move, in a body that turns.
TEST(RingWheel, TheLedgerBeginsWithTheFieldsOfTheStart) {
  const OneBlasThread one;
  const Rolling run{};
  Wheel w(disk(), run);
  const std::size_t n = w.of.built.model.n_nodes();
  std::vector<Vec2> u(n), v(n);
  for (const int node : w.of.built.model.free) {
    const auto k = static_cast<std::size_t>(node);
    u[k] = 1e-3 * w.of.built.model.reference[k];
    v[k] = {1.0, 0.5};
  }
  w.wheel.start(w.motion.start(), u, v);
  const WheelEnergy start = w.wheel.energy_at_start(true);
  EXPECT_GT(start.kinetic, 10.0);
  const WheelReport r = w.wheel.step(w.motion.at(0));
  EXPECT_NEAR(total(r.energy) - total(start), change(r.energy), 1e-11 * total(start));
}

/// The ledger of a spin that changes, and forwards to backwards through a wheel that stands.
TEST(RingWheel, TheLedgerClosesWhileTheSpinChanges) {
  const Outcome o = outcome({.speed = 0.0, .spins = dynamics::Table({{0.0, 20.0}, {0.1, -20.0}})});
  EXPECT_LE(o.unbalanced, 1e-11 * o.energy);
  EXPECT_LE(o.residual, 1e-9);
}

/// What changes quickly would seem to come early if the force at the end stood for the whole step.
TEST(RingWheel, TheMeanForceIsThatWhichMovesTheModes) {
  const OneBlasThread one;
  const Rolling run{};
  Wheel w(disk(), run);
  Vec2 before;
  double torque_before = 0.0, changes = 0.0;
  for (int i = 0; i < 60; ++i) {
    const WheelReport r = w.wheel.step(w.motion.at(i));
    const Vec2 mean = run.theta * r.force + (1.0 - run.theta) * before;
    EXPECT_NEAR(r.mean_force.x, mean.x, 1e-9 * (1.0 + norm(r.force))) << i;
    EXPECT_NEAR(r.mean_force.y, mean.y, 1e-9 * (1.0 + norm(r.force))) << i;
    EXPECT_NEAR(r.mean_torque, run.theta * r.torque + (1.0 - run.theta) * torque_before,
                1e-9 * (1.0 + std::abs(r.torque)))
        << i;
    changes = std::max(changes, norm(r.force - before));
    before = r.force;
    torque_before = r.torque;
  }
  EXPECT_GT(changes, 1000.0) << "the wheel lands";
}

/// Both ways to the displacement of a contact node.
TEST(RingWheel, ContactNodesAreWhereTheFieldHasThem) {
  const OneBlasThread one;
  Wheel w(disk(), {});
  for (int i = 0; i < 80; ++i) static_cast<void>(w.wheel.step(w.motion.at(i)));
  const double angle = w.motion.at(79).angle_next;
  std::vector<Vec2> field(disk().built.mesh.n_nodes()), contact(field.size());
  w.wheel.displacement(angle, field);
  w.wheel.contact_displacement(angle, contact);
  double largest = 0.0;
  for (const int node : disk().built.mesh.boundary) {
    const auto k = static_cast<std::size_t>(node);
    EXPECT_LT(norm(field[k] - contact[k]), 1e-12) << node;
    largest = std::max(largest, norm(field[k]));
  }
  EXPECT_GT(largest, 1e-3);
}

}  // namespace ring_wheel_test
}  // namespace rondo::rom
