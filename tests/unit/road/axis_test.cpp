// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/axis.hpp"

#include <gtest/gtest.h>

#include <random>

namespace axis_test {

using namespace rondo::road;

/// The cell by trying all of them.
std::size_t cell_oracle(const std::vector<double>& positions, double x) {
  std::size_t cell = 0;
  while (cell + 2 < positions.size() && positions[cell + 1] <= x) ++cell;
  return cell;
}

void expect_places(const std::vector<double>& positions, int n) {
  const Axis axis(positions, Border::keep, 0.0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(positions.front(), positions.back());
  std::vector<double> places = positions;
  for (const double x : positions) places.push_back(std::nextafter(x, positions.front()));
  for (int k = 0; k < n; ++k) places.push_back(anywhere(random));
  for (const double x : places) {
    const AxisPlace place = axis.locate(x);
    ASSERT_FALSE(place.outside);
    ASSERT_GE(place.fraction, 0.0);
    ASSERT_LE(place.fraction, 1.0);
    const double there = axis.position(place.cell) + place.fraction * place.width;
    EXPECT_NEAR(there, x, 1e-13);
    if (!axis.even()) {
      EXPECT_EQ(place.cell, cell_oracle(positions, x)) << x;
    }
  }
}

TEST(RoadAxis, FindsTheCellOfEachPlace) {
  expect_places({0.0, 1.0}, 100);
  expect_places({-1.5, -1.25, -1.0, 0.0, 1.0, 1.25, 1.5}, 1000);
  std::vector<double> even, rough, clustered;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> step(1e-3, 0.2);
  for (int j = 0; j < 341; ++j) even.push_back(-1.7 + 0.01 * j);
  for (double x = -2.0; rough.size() < 300; x += step(random)) rough.push_back(x);
  // Many cells in one step of the table.
  for (int j = 0; j < 200; ++j) clustered.push_back(j < 199 ? 1e-5 * j : 10.0);
  expect_places(even, 1000);
  expect_places(rough, 3000);
  expect_places(clustered, 1000);
}

TEST(RoadAxis, EvenPositionsAreRecognised) {
  std::vector<double> v;
  for (int j = 0; j < 341; ++j) v.push_back(-1.7 + 0.01 * j);
  EXPECT_TRUE(Axis(v, Border::keep, 0.0).even());
  v[100] += 1e-6;
  EXPECT_FALSE(Axis(v, Border::keep, 0.0).even());
}

TEST(RoadAxis, DirectionsBeyondTheEnds) {
  const Axis kept(10.0, 0.5, 5, Border::keep, 0.25);
  EXPECT_EQ(kept.locate(9.0).direction, 0.0);
  EXPECT_EQ(kept.locate(9.0).offset, 0.25);
  EXPECT_EQ(kept.locate(11.0).offset, 0.0);
  EXPECT_EQ(Axis(10.0, 0.5, 5, Border::reflect, 0.0).locate(9.9).direction, -1.0);
  EXPECT_EQ(Axis(10.0, 0.5, 5, Border::reflect, 0.0).locate(7.9).direction, 1.0);
  EXPECT_TRUE(Axis(10.0, 0.5, 5, Border::none, 0.0).locate(9.9).outside);
  const double far = 1e300, infinite = std::numeric_limits<double>::infinity();
  for (const Border border :
       {Border::none, Border::zero, Border::keep, Border::repeat, Border::reflect})
    for (const double x : {far, -far, infinite, -infinite, std::nan("")}) {
      const AxisPlace place = Axis(10.0, 0.5, 5, border, 0.0).locate(x);
      EXPECT_LT(place.cell, 4U);
      EXPECT_TRUE(place.fraction >= 0.0 && place.fraction <= 1.0);
    }
  EXPECT_TRUE(Axis(10.0, 0.5, 5, Border::keep, 0.0).locate(std::nan("")).outside);
}

}  // namespace axis_test
