// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/road_section.hpp"

#include <gtest/gtest.h>

#include "support/crg_files.hpp"

namespace rondo::road::road_section_test {
namespace {

using test::missing_height;
using test::road_by;

/// Neither flat nor symmetric in any direction.
double hills(double u, double v) {
  return 1.0 + 0.3 * u * u - 0.2 * v * u + 0.05 * v;
}

TEST(RoadSection, IsTheBilinearHeightBetweenItsPointsToo) {
  const Surface surface(road_by(hills, 2.0, 0.25, 9, {-1.0, -0.25, 0.5, 1.0}));
  for (const double v : {-1.0, -0.8, -0.25, 0.1, 0.5, 0.9, 1.0}) {
    const std::vector<Vec2> section = section_of(surface, v);
    ASSERT_EQ(section.size(), 9U);
    EXPECT_EQ(section.front().x, 2.0);
    EXPECT_EQ(section.back().x, 4.0);
    for (double u = 2.0; u <= 4.0; u += 1.0 / 64.0)
      EXPECT_NEAR(height_in(section, u), surface.bilinear(u, v), 4e-16 * 6.0) << u << ' ' << v;
  }
}

TEST(RoadSection, OnALineOfTheGridItIsThatLineBesideMissingHeights) {
  Road road = road_by(hills, 0.0, 0.5, 3, {0.0, 1.0});
  road.missing = Missing::keep;
  road.edges.v = Border::none;
  road.heights[3] = missing_height;  // row 1, v = 1
  const Surface surface(road);
  const std::vector<Vec2> right = section_of(surface, 0.0);
  EXPECT_EQ(right[1].y, hills(0.5, 0.0));
  const std::vector<Vec2> middle = section_of(surface, 0.5);
  EXPECT_TRUE(std::isnan(middle[1].y));
  EXPECT_FALSE(std::isnan(middle[0].y));
}

TEST(RoadSection, LevelEndsAreTheBorder) {
  Road road = road_by(hills, 2.0, 0.5, 3, {0.0, 1.0});
  const auto ends = [&](Border border, double offset) {
    const Surface surface(road, {border, Border::keep, offset, 0.0});
    return with_level_ends(section_of(surface, 0.5), surface, 0.5);
  };
  const double first = 0.5 * (hills(2.0, 0.0) + hills(2.0, 1.0)),
               last = 0.5 * (hills(3.0, 0.0) + hills(3.0, 1.0));
  const std::vector<Vec2> kept = ends(Border::keep, 0.0);
  ASSERT_EQ(kept.size(), 5U);
  EXPECT_EQ(kept[0], (Vec2{1.0, first}));
  EXPECT_EQ(kept[1], (Vec2{2.0, first}));
  EXPECT_EQ(kept[4], (Vec2{4.0, last}));
  const std::vector<Vec2> zero = ends(Border::zero, 0.25);
  ASSERT_EQ(zero.size(), 7U);
  EXPECT_EQ(zero[0], (Vec2{1.0, 0.25}));
  EXPECT_EQ(zero[1], (Vec2{2.0, 0.25}));
  EXPECT_EQ(zero[2], (Vec2{2.0, first}));
  EXPECT_EQ(zero[5], (Vec2{3.0, 0.25}));
  EXPECT_EQ(zero[6], (Vec2{4.0, 0.25}));
  const std::vector<Vec2> lifted = ends(Border::keep, 0.125);
  ASSERT_EQ(lifted.size(), 7U);
  EXPECT_EQ(lifted[0].y, first + 0.125);
  EXPECT_EQ(lifted[6].y, last + 0.125);
}

/// Slopes 0, 0.1, 0.3, 0, 0 over stretches of 0.5 m.
TEST(RoadSection, BendsWithinALength) {
  const std::vector<Vec2> section{{0.0, 0.0}, {0.5, 0.0}, {1.0, 0.05},
                                  {1.5, 0.2}, {2.0, 0.2}, {2.5, 0.2}};
  EXPECT_EQ(largest_bend(section, 0.49).value, 0.0) << "neighbours are farther apart";
  const RoadPlace next = largest_bend(section, 0.5);
  EXPECT_NEAR(next.value, 0.3, 1e-15);
  EXPECT_EQ(next.u, 1.5);
  const RoadPlace two = largest_bend(section, 1.0, {.u_from = 0.0, .u_to = 1.5});
  EXPECT_NEAR(two.value, 0.3, 1e-15);
  EXPECT_EQ(two.u, 0.5) << "from the first stretch to the third";
  EXPECT_NEAR(largest_bend(section, 0.5, {.u_from = 0.0, .u_to = 1.5}).value, 0.2, 1e-15);
}

}  // namespace
}  // namespace rondo::road::road_section_test
