// SPDX-License-Identifier: BSD-3-Clause
/// V33: the bars of V2 and V3 on a foot without mass (docs/theory.md, 3.10). Expected: an
/// independent program of the same scheme in one dimension.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/bars.hpp"
#include "support/massless_bars.hpp"
#include "support/traps.hpp"

namespace v33_massless_bar {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

struct Row {
  int elements;
  double lost, scatter, rebound;  ///< as MasslessHit has them
  double left;                    ///< of the energy after a period of V3
};

class MasslessBar : public testing::TestWithParam<Row> {};

}  // namespace

TEST_P(MasslessBar, OnAWall) {
  const Row& row = GetParam();
  const test::FloatingPointTraps traps;
  const test::BarHit found = test::hit({.elements = row.elements, .massless = true});
  RecordProperty("lost", fmt::format("{:.8f}", found.lost));
  RecordProperty("scatter", fmt::format("{:.6f}", found.scatter));
  RecordProperty("rebound", fmt::format("{:.6f}", found.rebound));
  // The figures that are given.
  EXPECT_NEAR(found.lost, row.lost, 5e-8);
  EXPECT_NEAR(found.scatter, row.scatter, 1e-5);
  EXPECT_NEAR(found.rebound, row.rebound, 5e-5);
  EXPECT_LT(found.residual, 1e-11);
  EXPECT_LT(found.penetration, 1e-13);  // round-off of displacements by meters
  // The frame is that of the wall, not of the bar: K u of displacements by meters leaves as much
  // with a foot that has mass.
  EXPECT_LT(found.relative, 5e-14 * row.elements);
  const test::BarHit lumped = test::hit({.elements = row.elements, .in_frame = true});
  EXPECT_LT(found.relative, 4.0 * lumped.relative);
  EXPECT_GT(lumped.lost, 2.5 * found.lost);
  EXPECT_GT(lumped.scatter, 10.0 * found.scatter);
}

TEST_P(MasslessBar, Bouncing) {
  const test::FloatingPointTraps traps;
  const test::BarBounce found =
      test::bounce({.elements = GetParam().elements, .massless = true}, test::period);
  RecordProperty("left", fmt::format("{:.7f}", found.left));
  EXPECT_NEAR(found.left, GetParam().left, 5e-6);
  EXPECT_LT(found.relative, 5e-14 * GetParam().elements);
}

INSTANTIATE_TEST_SUITE_P(All, MasslessBar,
                         testing::Values(Row{100, .0016708, .00927, 9.9459, .99688},
                                         Row{200, .00088225, .00290, 9.9624, .99857},
                                         Row{400, .00044125, .00104, 9.9746, .99931}),
                         [](const auto& p) { return fmt::format("N{}", p.param.elements); });

/// The gap, not the velocity, is what the law is on: on velocities .906 would be left at the first.
TEST(MasslessBarGaps, TenPeriods) {
  struct Kept {
    int elements;
    double courant, left, digits;
  };
  for (const Kept& row : {Kept{100, 0.5, .981, 5e-4}, Kept{100, 0.9, .90566, 5e-6},
                          Kept{200, 0.9, .96953, 5e-6}, Kept{400, 0.9, .98358, 5e-6}}) {
    const test::BarBounce found =
        test::bounce({.elements = row.elements, .courant = row.courant, .massless = true}, 53.4);
    RecordProperty(fmt::format("left_{}_{}", row.elements, row.courant),
                   fmt::format("{:.6f}", found.left));
    EXPECT_NEAR(found.left, row.left, row.digits) << row.elements << ' ' << row.courant;
  }
}

}  // namespace v33_massless_bar
