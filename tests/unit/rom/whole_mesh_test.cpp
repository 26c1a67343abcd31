// SPDX-License-Identifier: BSD-3-Clause
/// A mesh without sectors as a reduced wheel: against dense modes and compliances, against the ring
/// of the same disk, and numbers of an independent implementation of the same method.
#include "rondo/rom/wheel/whole_mesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "rolling_wheel.hpp"
#include "rondo/rom/wheel/left_behind.hpp"

namespace rondo::rom {
namespace whole_mesh_test {
using namespace rolling_wheel;
using Eigen::Index;

const Disk& whole_disk() {
  static const Disk d(12, 180, true);
  return d;
}

TEST(WholeMesh, ModesAndComplianceAreThoseOfTheDenseRing) {
  const OneBlasThread one;
  const Disk d(3, 16, true);
  const Ring ring = d.ring();
  const double square = 900.0;
  const auto dense = ring_modes(ring, {.wanted = 11}),
             sparse = whole_modes(ring, d.whole(), {.wanted = 11});
  ASSERT_EQ(count_modes(sparse), 11);
  for (Index j = 0; j < 11; ++j)
    EXPECT_NEAR(sparse[0].squares[j], dense[0].squares[j], 1e-9 * dense[0].squares[j]);
  // Shapes of double frequencies are free to turn: what they span is compared.
  const RingResidual a = ring_residual(ring, dense, square, ResidualForm::convected),
                     b = whole_residual(ring, d.whole(), sparse, square);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  double largest = 0.0;
  for (const double g : a.blocks) largest = std::max(largest, std::abs(g));
  for (std::size_t e = 0; e < a.blocks.size(); ++e)
    EXPECT_NEAR(b.blocks[e], a.blocks[e], 1e-9 * largest);
  EXPECT_LE((a.centrifugal - b.centrifugal).norm(), 1e-9 * a.centrifugal.norm());
  const Index size = a.size, rows = ring.n_rows();
  const Eigen::VectorXd force = Eigen::VectorXd::LinSpaced(size, -1.0, 2.0);
  const Eigen::VectorXd field =
      Eigen::Map<const Eigen::MatrixXd>(a.fields.data(), rows, size) * force;
  EXPECT_LE((b.by_contact(force) - field).norm(), 1e-9 * field.norm());
}

TEST(WholeMesh, TheStaticComplianceIsThatOfTheSectors) {
  const OneBlasThread one;
  const Disk cyclic(4, 24), d(4, 24, true);
  const double square = 1000.0;
  const RingResidual a = ring_residual(cyclic.ring(), {}, square, ResidualForm::still),
                     b = whole_residual(d.ring(), d.whole(), {}, square);
  const Eigen::Map<const Eigen::MatrixXd> g = b.block(0);
  const double scale = a.block(0).cwiseAbs().maxCoeff();
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j) {
      const Complex to = cyclic.sector.turn[static_cast<std::size_t>(i)],
                    from = cyclic.sector.turn[static_cast<std::size_t>(j)];
      Eigen::Matrix2d r, s;
      r << to.re, -to.im, to.im, to.re;
      s << from.re, -from.im, from.im, from.re;
      EXPECT_LE((g.block<2, 2>(2 * i, 2 * j) - r * a.block(i - j) * s.transpose()).norm(),
                1e-11 * scale);
    }
}

TEST(WholeMesh, ASpinAboveTheLowestFrequencyHasNoCompliance) {
  const OneBlasThread one;
  const Disk d(3, 16, true);
  const double lowest = whole_modes(d.ring(), d.whole(), {.wanted = 1})[0].squares[0];
  EXPECT_TRUE(whole_residual(d.ring(), d.whole(), {}, 0.99 * lowest).made_static.empty());
  EXPECT_FALSE(whole_residual(d.ring(), d.whole(), {}, 1.01 * lowest).made_static.empty());
}

struct Row {
  int modes;
  double passes, theta, x, y;
};

class WholeRows : public testing::TestWithParam<Row> {};

/// The disk is that of ring_wheel_test.cpp. As a ring with the same 41 modes and the static
/// residual it has forces of -22,014 and 190,144 N/m.
TEST_P(WholeRows, AreMet) {
  const Row row = GetParam();
  const Outcome o =
      outcome({.modes = row.modes, .passes = row.passes, .theta = row.theta}, whole_disk());
  EXPECT_NEAR(o.x, row.x, 2.0);
  EXPECT_NEAR(o.y, row.y, 2.0);
  EXPECT_LE(o.unbalanced, 1e-11 * o.energy);
  EXPECT_LE(o.residual, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, WholeRows,
                         testing::Values(Row{41, 2.618033989, 0.6, -22025.0, 190110.0},
                                         Row{41, 2.618033989, 0.5, -21997.0, 190145.0},
                                         Row{41, 8.0, 0.6, -21999.0, 190118.0},
                                         Row{20, 2.618033989, 0.6, -22248.0, 190271.0}));

TEST(WholeMesh, FrictionIsThatOfItsCoefficient) {
  const Outcome little = outcome({.friction = 0.05, .end = 0.1}, whole_disk()),
                much = outcome({.friction = 0.4, .end = 0.1}, whole_disk());
  EXPECT_LT(std::abs(little.x), 0.5 * std::abs(much.x));
  EXPECT_EQ(outcome({.friction = 0.0, .end = 0.1}, whole_disk()).x, 0.0);
}

/// Against the ring, which the ring's own tests hold against full runs.
TEST(WholeMesh, FollowsTheRingWhileTheSpinChanges) {
  const Rolling run{.modes = 41,
                    .form = ResidualForm::still,
                    .end = 0.1,
                    .spins = dynamics::Table({{0.0, 100.0 / 3.0}, {0.1, 10.0}})};
  const Outcome ring = outcome(run), mesh = outcome(run, whole_disk());
  EXPECT_LE(mesh.unbalanced, 1e-11 * mesh.energy);
  double of_x = 0.0, of_y = 0.0;
  for (std::size_t n = 80; n < ring.forces.size(); ++n) {
    of_x = std::max(of_x, std::abs(mesh.forces[n].x - ring.forces[n].x));
    of_y = std::max(of_y, std::abs(mesh.forces[n].y - ring.forces[n].y));
  }
  EXPECT_LE(of_x, 0.01 * ring.y);
  EXPECT_LE(of_y, 0.01 * ring.y);
}

TEST(WholeMesh, TheLedgerClosesFromForwardsToBackwards) {
  const Outcome o =
      outcome({.speed = 0.0, .spins = dynamics::Table({{0.0, 20.0}, {0.1, -20.0}})}, whole_disk());
  EXPECT_LE(o.unbalanced, 1e-11 * o.energy);
}

/// Some thousand N/m are left; with a force in the middle of the step there are 57,882.
TEST(WholeMesh, WithoutDampingAForceWeightedToTheEndRingsLess) {
  Rolling run{.modes = 41, .friction = 0.3, .end = 1.5, .damped = false};
  const double later = outcome(run, whole_disk()).deviation;
  run.theta = 0.5;
  EXPECT_LE(later, 0.1 * outcome(run, whole_disk()).deviation);
}

TEST(WholeMesh, ResumesToTheSameBits) {
  const OneBlasThread one;
  const Rolling run{};
  Wheel whole(whole_disk(), run), first(whole_disk(), run), second(whole_disk(), run);
  for (int i = 0; i < 120; ++i) {
    static_cast<void>(whole.wheel.step(whole.motion.at(i)));
    static_cast<void>(first.wheel.step(first.motion.at(i)));
  }
  second.wheel.restore(first.wheel.save());
  for (int i = 120; i < 160; ++i) {
    const WheelReport a = whole.wheel.step(whole.motion.at(i)),
                      b = second.wheel.step(second.motion.at(i));
    ASSERT_EQ(a.force, b.force) << i;
    ASSERT_EQ(a.energy.scheme, b.energy.scheme) << i;
  }
}

/// Four nodes a quarter of a turn apart, a force on the lowest.
TEST(LeftBehind, AForceStaysInSpaceBetweenTheNodesThatComeThere) {
  const std::array<Vec2, 4> place{{{0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}}};
  LeftBehind left(place);
  left.add(0, {2.0, 4.0}, 0.0);
  ASSERT_EQ(left.shares().size(), 1U);
  EXPECT_EQ(left.shares()[0].node, 0);
  EXPECT_EQ(left.shares()[0].force, (Vec2{2.0, 4.0}));
  const auto shares_after = [&](double turn) {
    left.clear();
    left.add(0, {0.0, 4.0}, turn);
    return left.shares();
  };
  // Counter-clockwise: the lowest node leaves to the right, and the node from the left comes.
  const auto small = shares_after(0.25 * pi / 2.0);
  ASSERT_EQ(small.size(), 2U);
  EXPECT_EQ(small[0].node, 0);
  EXPECT_EQ(small[1].node, 3);
  EXPECT_NEAR(norm(small[0].force), 3.0, 1e-14);
  EXPECT_NEAR(norm(small[1].force), 1.0, 1e-14);
  EXPECT_NEAR(small[1].force.x / small[1].force.y, std::tan(0.25 * pi / 2.0), 1e-14);
  const auto back = shares_after(-1.5 * pi / 2.0);  // past a node
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].node, 1);
  EXPECT_EQ(back[1].node, 2);
  EXPECT_NEAR(norm(back[0].force), 2.0, 1e-14);
}

/// Nodes farther in, at the same angles, get nothing.
TEST(LeftBehind, NodesOfAnotherRadiusArePassed) {
  const std::array<Vec2, 4> place{{{0.0, -1.0}, {0.0, -0.5}, {-0.1, -0.5}, {-1.0, 0.0}}};
  LeftBehind left(place);
  left.add(0, {0.0, 4.0}, 0.25 * pi / 2.0);
  ASSERT_EQ(left.shares().size(), 2U);
  EXPECT_EQ(left.shares()[0].node, 0);
  EXPECT_EQ(left.shares()[1].node, 3);
  EXPECT_NEAR(norm(left.shares()[1].force), 1.0, 1e-14);
}

}  // namespace whole_mesh_test
}  // namespace rondo::rom
