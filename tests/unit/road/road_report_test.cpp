// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/road_report.hpp"

#include <gtest/gtest.h>

#include "support/crg_files.hpp"

namespace road_report_test {

using namespace rondo;
using namespace rondo::road;

/// A ramp of slope 0.5 over one cell, flat on both sides: 1 m in steps of 0.25 m, 0.5 m wide.
Road ramp() {
  Road road = test::road_by([](double u, double) { return u < 0.6 ? 0.0 : 0.125; }, 0.0, 0.25, 5,
                            {-0.25, 0.0, 0.25});
  road.file = "ramp.crg";
  road.format = "LRFI";
  return road;
}

/// The slopes at both ends of the ramp are limited to 0, so that it is the cubic t² (3 - 2 t): it
/// is 1.5 times as steep in the middle, and differs from the line by t (1 - t) (1 - 2 t) 0.125 m,
/// most at a quarter of the samples.
TEST(RoadReport, SlopesAndDifferenceOfARamp) {
  const Road road = ramp();
  const RoadReport report = report_of(road, Surface(road));
  EXPECT_EQ(report.lowest, 0.0);
  EXPECT_EQ(report.highest, 0.125);
  EXPECT_EQ(report.missing_share, 0.0);
  EXPECT_NEAR(report.steepest.value, 0.75, 1e-15);
  EXPECT_EQ(report.steepest.u, 0.625);
  EXPECT_NEAR(report.largest_difference.value, 0.09375 * 0.125, 1e-15);
  EXPECT_EQ(report.largest_difference.u, 0.5625);
  EXPECT_EQ(report.samples, 4U * 2U * 16U);
  // A quarter of the cells has two of four samples with the largest difference.
  EXPECT_NEAR(report.rms_difference, 0.09375 * 0.125 * std::sqrt(0.5 / 4.0), 1e-15);
  EXPECT_EQ(report.seam_u, 0.125);
  EXPECT_EQ(report.seam_v, 0.0);
}

TEST(RoadReport, LinesThatCheckPrints) {
  Road road = ramp();
  road.heights[0] = road.heights[2] = test::missing_height;
  road.notes = {"The channel \"D:friction,1\" of ramp.crg is not used."};
  const Edges edges{.u = Border::repeat, .v = Border::keep};
  const auto lines = lines_of(road, report_of(road, Surface(road, edges)), edges);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[0],
            "The road ramp.crg (LRFI) has 5 rows of 3 heights: u from 0 to 1 m in steps of "
            "0.25 m, v from -0.25 to 0.25 m in steps of 0.25 m.");
  EXPECT_EQ(lines[1],
            "Its heights are 0 to 0.125 m, with slope and banking. 13 % of the heights are "
            "missing; the last valid height of the row stands for them.");
  EXPECT_EQ(lines[2],
            "The largest slope of its smooth surface is 0.75, at u = 0.625 m, v = -0.25 m.");
  EXPECT_EQ(
      lines[3],
      "The smooth surface differs from the bilinear one by at most 0.012 m, at u = 0.5625 m, v = "
      "-0.25 m (root mean square 0.0041 m, 128 samples).");
  EXPECT_EQ(lines[4], "Where it repeats along u, the height jumps by at most 0.125 m.");
  EXPECT_EQ(lines[5], road.notes[0]);
}

TEST(RoadReport, UnevenSectionsAndOtherRulesForMissingHeights) {
  Road road = test::road_by([](double, double v) { return v; }, 0.0, 1.0, 2, {-1.0, 0.5, 1.0});
  const auto second_line = [&] { return lines_of(road, report_of(road, Surface(road)), {})[1]; };
  EXPECT_NE(lines_of(road, report_of(road, Surface(road)), {})[0].find("in steps of 0.5 to 1.5 m."),
            std::string::npos);
  EXPECT_NE(second_line().find("No height is missing."), std::string::npos);
  road.heights[0] = test::missing_height;
  road.missing = Missing::keep;
  EXPECT_NE(second_line().find("17 % of the heights are missing; they are outside of the road."),
            std::string::npos);
  road.missing = Missing::zero;
  road.missing_offset = 0.5;
  EXPECT_NE(second_line().find("the height 0 of the grid stands for them, plus 0.5 m."),
            std::string::npos);
}

/// A wheel reaches a part of a road, and only this counts.
TEST(RoadReport, SlopesOfAPart) {
  const Road road = ramp();
  const Surface surface(road);
  EXPECT_EQ(report_of(road, surface, {.u_from = -7.0, .u_to = 0.4}).steepest.value, 0.0);
  EXPECT_EQ(report_of(road, surface, {.u_from = 0.8}).steepest.value, 0.0);
  const RoadReport report = report_of(road, surface, {.u_to = 0.55, .v_from = 0.1, .v_to = 0.2});
  EXPECT_NEAR(report.steepest.value, 0.75, 1e-15);
  EXPECT_EQ(report.steepest.v, 0.0);  // the cell from 0 to 0.25 m
  EXPECT_EQ(report.samples, 3U * 16U);
  EXPECT_EQ(lines_of(road, report, {})[2],
            "The largest slope of its smooth surface, for u up to 0.55 m and v from 0.1 to "
            "0.2 m, is "
            "0.75, at u = 0.625 m, v = 0 m.");
}

/// A parabola: its slope changes by 2 a times the distance, until the limit of the slopes at the
/// ends.
TEST(RoadReport, SlopesThatChangeWithinALength) {
  const Road along =
      test::road_by([](double u, double) { return 0.5 * u * u; }, 1.0, 0.1, 21, {-0.2, 0.0, 0.2});
  const Road across = test::road_by([](double, double v) { return 0.25 * v * v; }, 0.0, 1.0, 3,
                                    {1.0, 1.25, 1.5, 2.0, 2.25});
  EXPECT_NEAR(largest_slope_change(Surface(along), {0.3, 0.3}).value, 0.3, 1e-6);
  EXPECT_NEAR(largest_slope_change(Surface(along), {0.35, 0.35}).value, 0.3, 1e-6);
  EXPECT_EQ(largest_slope_change(Surface(along), {0.05, 0.05}).value, 0.0);
  EXPECT_NEAR(largest_slope_change(Surface(across), {0.5, 0.5}).value, 0.25, 1e-6);
  const RoadPlace part =
      largest_slope_change(Surface(across), {1.0, 1.0}, {.v_from = 1.6, .v_to = 1.7});
  EXPECT_NEAR(part.value, 0.25, 1e-6);
  EXPECT_EQ(part.v, 1.5);
}

/// Outside of the road there is nothing to compare.
TEST(RoadReport, WhereTheRoadHasNoHeight) {
  Road road = ramp();
  road.heights[0] = test::missing_height;
  road.missing = Missing::keep;
  const RoadReport report = report_of(road, Surface(road, {.v = Border::none}));
  EXPECT_LT(report.samples, 128U);
  EXPECT_NEAR(report.steepest.value, 0.75, 1e-15);
  EXPECT_TRUE(std::isfinite(report.rms_difference));
}

}  // namespace road_report_test
