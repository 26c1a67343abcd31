// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/limited_slope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace limited_slope_test {

using namespace rondo::road;

/// x² around 10, with stretches of different lengths: the slope is 20 there, and 2 x at the ends.
TEST(LimitedSlope, ThatOfTheParabola) {
  EXPECT_DOUBLE_EQ(limited_slope(19.0, 1.0, 22.0, 2.0), 20.0);
  EXPECT_DOUBLE_EQ(limited_slope(-22.0, 2.0, -19.0, 1.0), -20.0);
  EXPECT_DOUBLE_EQ(limited_end_slope(19.0, 1.0, 22.0, 2.0), 18.0);  // at 9
  EXPECT_DOUBLE_EQ(limited_end_slope(22.0, 2.0, 19.0, 1.0), 24.0);  // at 12
}

TEST(LimitedSlope, AtMostOnceAndAHalfTheSmallerSecant) {
  EXPECT_EQ(limited_slope(1.0, 1.0, 9.0, 1.0), 1.5);
  EXPECT_EQ(limited_slope(-9.0, 1.0, -1.0, 1.0), -1.5);
  EXPECT_EQ(limited_slope(2.0, 1.0, -1.0, 1.0), 0.0);
  EXPECT_EQ(limited_slope(1.0, 1.0, 0.0, 1.0), 0.0);
  EXPECT_EQ(limited_end_slope(4.0, 1.0, -4.0, 1.0), 6.0);
  EXPECT_EQ(limited_end_slope(1.0, 1.0, 9.0, 1.0), 0.0);  // the parabola turns back
}

/// A line ends beside what is missing.
TEST(LimitedSlope, BesideAMissingHeight) {
  const double nan = std::nan("");
  EXPECT_EQ(limited_slope(nan, 1.0, 3.0, 1.0), 3.0);
  EXPECT_EQ(limited_slope(3.0, 1.0, nan, 1.0), 3.0);
  EXPECT_EQ(limited_end_slope(3.0, 1.0, nan, 1.0), 3.0);
}

TEST(LimitedSlope, SinglePrecisionIsNeverLarger) {
  for (const double x : {0.1, -0.1, 1.0 / 3.0, -2.0 / 3.0, 0.5, 0.0, 1e-300, 16777217.0}) {
    const auto y = static_cast<double>(toward_zero(x));
    EXPECT_LE(std::abs(y), std::abs(x));
    EXPECT_LE(std::abs(x - y), std::abs(x) * std::numeric_limits<float>::epsilon() + 1e-44);
  }
}

}  // namespace limited_slope_test
