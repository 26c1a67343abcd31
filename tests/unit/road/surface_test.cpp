// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/crg_files.hpp"

namespace surface_test {

using namespace rondo;
using namespace rondo::road;
using test::road_by;

const std::vector<double> even_v{-0.5, -0.25, 0.0, 0.25, 0.5};
const std::vector<double> uneven_v{-1.5, -1.25, -1.2, -0.3, 0.0, 0.01, 0.9, 1.5};

double waves(double u, double v) {
  return 0.05 * std::sin(3.0 * u) * std::cos(2.0 * v) + 0.02 * u * v;
}

/// Rough heights without a pattern.
Road rough_road(const std::vector<double>& v, std::uint32_t seed, std::size_t n_u = 12) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(-0.1, 0.1);
  return road_by([&](double, double) { return height(random); }, 3.0, 0.2, n_u, v);
}

/// The bilinear rule by its definition, the cell by trying all.
double bilinear_oracle(const Road& road, double u, double v) {
  const std::size_t n_v = road.n_v();
  std::size_t i = 0, j = 0;
  while (i + 2 < road.n_u() && road.u_first + static_cast<double>(i + 1) * road.u_step <= u) ++i;
  while (j + 2 < n_v && road.v[j + 1] <= v) ++j;
  const double s = (u - road.u_first) / road.u_step - static_cast<double>(i);
  const double t = (v - road.v[j]) / (road.v[j + 1] - road.v[j]);
  const double* const z = road.heights.data() + i * n_v + j;
  return (1 - s) * (1 - t) * z[0] + (1 - s) * t * z[1] + s * (1 - t) * z[n_v] + s * t * z[n_v + 1];
}

/// Points within the grid.
std::vector<std::pair<double, double>> places_on(const Road& road, int n) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(road.u_first, road.u_last()),
      v(road.v.front(), road.v.back());
  std::vector<std::pair<double, double>> places;
  for (int k = 0; k < n; ++k) places.emplace_back(u(random), v(random));
  return places;
}

TEST(RoadSurface, BilinearAsOpenCrgDefinesIt) {
  for (const auto& v : {even_v, uneven_v}) {
    const Road road = rough_road(v, 3);
    const Surface surface(road);
    EXPECT_EQ(surface.v_axis().even(), v.size() == even_v.size());
    for (const auto& [u, across] : places_on(road, 2000))
      EXPECT_NEAR(surface.bilinear(u, across), bilinear_oracle(road, u, across), 1e-12);
  }
}

TEST(RoadSurface, BothSurfacesMeetTheGrid) {
  const Road road = rough_road(uneven_v, 4);
  const Surface surface(road);
  for (std::size_t i = 0; i < road.n_u(); ++i)
    for (std::size_t j = 0; j < road.n_v(); ++j) {
      const double u = surface.u_axis().position(i), v = road.v[j];
      EXPECT_NEAR(surface.bilinear(u, v), road.heights[i * road.n_v() + j], 1e-14);
      EXPECT_NEAR(surface.at(u, v).height, road.heights[i * road.n_v() + j], 1e-14);
    }
}

/// Slopes are the same from both sides of each line of the grid. Two points at the distance 2e-10 m
/// differ by less than 2e-10 times the largest bend: 12 height differences over the square of the
/// narrowest cell, 12 x 0.2 / 0.01² 1/m.
TEST(RoadSurface, SlopesAreContinuous) {
  const double near = 1e-10;
  for (const auto& v : {even_v, uneven_v}) {
    const Road road = rough_road(v, 5);
    const Surface surface(road);
    const auto expect_same = [&](double u0, double v0, double u1, double v1) {
      const SurfacePoint a = surface.at(u0, v0), b = surface.at(u1, v1);
      EXPECT_NEAR(a.height, b.height, 1e-7);
      EXPECT_NEAR(a.slope_u, b.slope_u, 1e-5) << u0 << " " << v0;
      EXPECT_NEAR(a.slope_v, b.slope_v, 1e-5) << u0 << " " << v0;
    };
    for (const auto& [u, across] : places_on(road, 300)) {
      for (std::size_t i = 1; i + 1 < road.n_u(); ++i) {
        const double line = surface.u_axis().position(i);
        expect_same(line - near, across, line + near, across);
      }
      for (std::size_t j = 1; j + 1 < road.n_v(); ++j)
        expect_same(u, road.v[j] - near, u, road.v[j] + near);
    }
  }
}

TEST(RoadSurface, DerivativesAreThoseOfTheHeights) {
  const Road road = rough_road(uneven_v, 6);
  const Surface surface(road);
  const double h = 1e-5;
  int compared = 0;
  for (const auto& [u, v] : places_on(road, 500)) {
    // Within one cell, where third derivatives exist.
    const AxisPlace along = surface.u_axis().locate(u), across = surface.v_axis().locate(v);
    if (std::min(along.fraction, 1 - along.fraction) * along.width < 2 * h ||
        std::min(across.fraction, 1 - across.fraction) * across.width < 2 * h)
      continue;
    ++compared;
    const SurfacePoint p = surface.at(u, v);
    const SurfacePoint east = surface.at(u + h, v), west = surface.at(u - h, v);
    const SurfacePoint left = surface.at(u, v + h), right = surface.at(u, v - h);
    // The error of central differences is h² / 6 of the third derivative, some 1e7 in the cell of 1
    // cm.
    EXPECT_NEAR(p.slope_u, (east.height - west.height) / (2 * h), 1e-6);
    EXPECT_NEAR(p.slope_v, (left.height - right.height) / (2 * h), 1e-4);
    EXPECT_NEAR(p.bend_uu, (east.slope_u - west.slope_u) / (2 * h), 1e-4);
    EXPECT_NEAR(p.bend_vv, (left.slope_v - right.slope_v) / (2 * h), 1e-2);
    EXPECT_NEAR(p.bend_uv, (east.slope_v - west.slope_v) / (2 * h), 1e-4);
    EXPECT_NEAR(p.bend_uv, (left.slope_u - right.slope_u) / (2 * h), 1e-4);
  }
  EXPECT_GT(compared, 450);
}

/// A patch stays between its four corners: rough heights, steps, and a single spike.
TEST(RoadSurface, NoPatchOvershootsItsCorners) {
  std::vector<Road> roads;
  for (std::uint32_t seed = 10; seed < 20; ++seed) roads.push_back(rough_road(uneven_v, seed, 20));
  roads.push_back(
      road_by([](double u, double v) { return u + v > 4.0 ? 1.0 : 0.0; }, 3.0, 0.2, 12, even_v));
  roads.push_back(road_by([](double u, double v) { return std::exp(4.0 * (u - 3.0) + 2.0 * v); },
                          3.0, 0.2, 12, even_v));
  for (const Road& road : roads) {
    const Surface surface(road);
    for (const auto& [u, v] : places_on(road, 4000)) {
      const std::size_t i = surface.u_axis().locate(u).cell, j = surface.v_axis().locate(v).cell;
      const auto corners = {surface.height_at(i, j), surface.height_at(i + 1, j),
                            surface.height_at(i, j + 1), surface.height_at(i + 1, j + 1)};
      const double z = surface.at(u, v).height, round_off = 1e-15 * std::max(corners);
      EXPECT_GE(z, std::min(corners) - round_off - 1e-16);
      EXPECT_LE(z, std::max(corners) + round_off + 1e-16);
    }
  }
}

/// A plane in the grid is a plane, also over uneven cells: within the precision of the slopes.
TEST(RoadSurface, APlaneInTheGridIsMet) {
  for (const auto& v : {even_v, uneven_v}) {
    const Road road =
        road_by([](double u, double y) { return 1.0 + 0.3 * u - 0.2 * y; }, 3.0, 0.2, 12, v);
    const Surface surface(road);
    for (const auto& [u, y] : places_on(road, 200)) {
      const SurfacePoint p = surface.at(u, y);
      EXPECT_NEAR(p.height, 1.0 + 0.3 * u - 0.2 * y, 1e-8);
      EXPECT_NEAR(p.slope_u, 0.3, 1e-7);
      EXPECT_NEAR(p.slope_v, -0.2, 1e-7);
    }
  }
}

/// Of a twisted road, whose patches are bilinear, the smooth surface leaves less than 1 % of the
/// twist.
TEST(RoadSurface, ATwistIsMetWithinOnePercent) {
  const Road road = road_by([](double u, double v) { return u * v; }, 3.0, 0.2, 12, even_v);
  const Surface surface(road);
  double largest = 0.0;
  for (const auto& [u, v] : places_on(road, 3000))
    largest = std::max(largest, std::abs(surface.at(u, v).height - u * v));
  EXPECT_LT(largest, 0.0093 * 0.2 * 0.25);
  EXPECT_GT(largest, 0.0080 * 0.2 * 0.25);  // the bound of the theory is sharp
}

/// Of a smooth function, the difference falls with the square of the steps where it is monotone.
TEST(RoadSurface, SmoothHeightsAreMetBetterThanByBilinear) {
  const auto error_with = [](double h, bool smooth) {
    std::vector<double> v;
    for (double y = -0.5; y < 0.5 + 0.5 * h; y += h) v.push_back(y);
    const auto ramp = [](double u, double y) {
      return 0.1 * std::exp(u - 3.0) + 0.1 * std::exp(y);
    };
    const Road road = road_by(ramp, 3.0, h, static_cast<std::size_t>(2.0 / h) + 1, v);
    const Surface surface(road);
    double largest = 0.0;
    for (const auto& [u, y] : places_on(road, 2000))
      largest = std::max(
          largest,
          std::abs((smooth ? surface.at(u, y).height : surface.bilinear(u, y)) - ramp(u, y)));
    return largest;
  };
  EXPECT_LT(error_with(0.1, true), 0.1 * error_with(0.1, false));
  EXPECT_GT(error_with(0.1, true), 6.0 * error_with(0.05, true));  // third order
}

TEST(RoadSurface, KeptBordersHoldTheHeightAndHaveNoSlopeAcross) {
  const Road road = rough_road(even_v, 21);
  const Surface surface(road, {.offset_u = 0.25, .offset_v = 0.5});
  EXPECT_EQ(surface.bilinear(2.0, 0.1), surface.bilinear(3.0, 0.1) + 0.25);
  EXPECT_EQ(surface.bilinear(3.3, 9.0), surface.bilinear(3.3, 0.5) + 0.5);
  EXPECT_EQ(surface.bilinear(99.0, -9.0), surface.bilinear(road.u_last(), -0.5) + 0.75);
  const SurfacePoint beyond = surface.at(99.0, 0.1), end = surface.at(road.u_last(), 0.1);
  EXPECT_EQ(beyond.height, end.height + 0.25);
  EXPECT_EQ(beyond.slope_v, end.slope_v);
  EXPECT_EQ(beyond.slope_u, 0.0);
  EXPECT_EQ(beyond.bend_uu, 0.0);
  EXPECT_EQ(surface.at(3.3, 9.0).slope_u, surface.at(3.3, 0.5).slope_u);
}

/// Both heights and slopes, for which a shift by a period and a mirror image say what they are.
TEST(RoadSurface, RepeatedAndMirroredBorders) {
  for (const auto& v : {even_v, uneven_v}) {
    const Road road = rough_road(v, 22);
    const double length = road.u_last() - road.u_first, width = v.back() - v.front();
    const Surface repeated(road, {.u = Border::repeat, .v = Border::repeat});
    const Surface mirrored(road, {.u = Border::reflect, .v = Border::reflect});
    for (const auto& [u, y] : places_on(road, 200))
      for (const int k : {-3, -1, 1, 2}) {
        const SurfacePoint p = repeated.at(u, y), q = repeated.at(u + k * length, y - k * width);
        EXPECT_NEAR(q.height, p.height, 1e-12);
        EXPECT_NEAR(q.slope_u, p.slope_u, 1e-10);
        EXPECT_NEAR(q.slope_v, p.slope_v, 1e-9);
        const SurfacePoint a = mirrored.at(u, y),
                           b = mirrored.at(2 * road.u_last() - u, 2 * v.front() - y);
        EXPECT_NEAR(b.height, a.height, 1e-12);
        EXPECT_NEAR(b.slope_u, -a.slope_u, 1e-10);
        EXPECT_NEAR(b.slope_v, -a.slope_v, 1e-9);
        EXPECT_NEAR(b.bend_uv, a.bend_uv, 1e-7);
        EXPECT_NEAR(mirrored.bilinear(u + 2 * k * length, y), mirrored.bilinear(u, y), 1e-12);
      }
  }
}

/// A mirrored road has no kink at its borders: its slope across them is 0.
TEST(RoadSurface, MirroredBordersAreLevel) {
  const Road road = rough_road(even_v, 25);
  const Surface surface(road, {.u = Border::reflect, .v = Border::reflect});
  for (std::size_t j = 0; j < even_v.size(); ++j)
    for (const double u : {road.u_first, road.u_last()})
      EXPECT_EQ(surface.at(u, even_v[j]).slope_u, 0.0);
  for (std::size_t i = 0; i < road.n_u(); ++i)
    for (const double v : {even_v.front(), even_v.back()})
      EXPECT_EQ(surface.at(surface.u_axis().position(i), v).slope_v, 0.0);
}

/// A road that ends as it begins has no kink where it repeats.
TEST(RoadSurface, AClosedRoadRepeatsWithoutAKink) {
  const auto wave = [](double u, double) {
    return 0.1 * std::sin(2.0 * M_PI * (u - 3.0) / 2.0 + 0.4);
  };
  const Road road = road_by(wave, 3.0, 0.1, 21, even_v);
  const Surface surface(road, {.u = Border::repeat});
  const SurfacePoint before = surface.at(5.0 - 1e-9, 0.1), after = surface.at(5.0 + 1e-9, 0.1);
  EXPECT_NEAR(before.height, after.height, 1e-9);
  EXPECT_NEAR(before.slope_u, after.slope_u, 1e-6);
  EXPECT_GT(std::abs(before.slope_u), 0.2);
}

TEST(RoadSurface, ZeroAndNoneBeyondTheGrid) {
  const Road road = rough_road(even_v, 23);
  const Surface zero(road,
                     {.u = Border::zero, .v = Border::zero, .offset_u = 2.0, .offset_v = 3.0});
  EXPECT_EQ(zero.bilinear(2.9, 0.0), 2.0);
  EXPECT_EQ(zero.bilinear(3.5, 0.6), 3.0);
  EXPECT_EQ(zero.bilinear(2.9, 0.6), 3.0);
  EXPECT_EQ(zero.at(2.9, 0.0).height, 2.0);
  EXPECT_EQ(zero.at(2.9, 0.0).slope_v, 0.0);
  const Surface mixed(road,
                      {.u = Border::zero, .v = Border::keep, .offset_u = 2.0, .offset_v = 3.0});
  EXPECT_EQ(mixed.bilinear(2.9, 0.6), 5.0);
  const Surface none(road, {.u = Border::none, .v = Border::keep});
  EXPECT_TRUE(std::isnan(none.bilinear(2.9, 0.0)));
  EXPECT_TRUE(std::isnan(none.at(2.9, 0.0).height));
  EXPECT_FALSE(std::isnan(none.bilinear(3.1, 0.6)));
  // Sums of steps may be beyond the end by round-off.
  EXPECT_FALSE(std::isnan(none.bilinear(3.0 - 4e-16, 0.0)));
  for (const Surface* const surface : {&zero, &none})
    EXPECT_TRUE(std::isnan(surface->bilinear(test::missing_height, 0.0)) ||
                surface->bilinear(test::missing_height, 0.0) == 2.0);
}

/// Outside of the road nothing is told; a corner without weight does not count.
TEST(RoadSurface, MissingHeightsReachAsFarAsTheirCells) {
  Road road = road_by(waves, 3.0, 0.2, 4, even_v);
  road.missing = Missing::keep;
  road.heights[3] = road.heights[4] = test::missing_height;
  const Surface surface(road, {.v = Border::none});
  EXPECT_TRUE(std::isnan(surface.bilinear(3.1, 0.4)));
  EXPECT_TRUE(std::isnan(surface.bilinear(3.1, 0.1)));
  EXPECT_NEAR(surface.bilinear(3.25, 0.5), 0.75 * waves(3.2, 0.5) + 0.25 * waves(3.4, 0.5), 1e-14);
  EXPECT_NEAR(surface.bilinear(3.0, 0.0), waves(3.0, 0.0), 1e-15);
  EXPECT_FALSE(std::isnan(surface.at(3.3, 0.3).height));
}

/// Corners of the patch bound it, at borders too.
TEST(RoadSurface, DoesNotRiseAboveItsBound) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> u(2.0, 6.5), v(-2.5, 2.5);
  for (const Border border :
       {Border::none, Border::zero, Border::keep, Border::repeat, Border::reflect})
    for (const auto& across : {even_v, uneven_v}) {
      const Surface surface(rough_road(across, 5), {border, border, 0.01, -0.02});
      int closest = 0;
      for (int k = 0; k < 4000; ++k) {
        const double at_u = u(random), at_v = v(random), bound = surface.bound(at_u, at_v),
                     height = surface.at(at_u, at_v).height;
        ASSERT_EQ(std::isnan(bound), std::isnan(height)) << at_u << ' ' << at_v;
        EXPECT_FALSE(height > bound + 1e-15) << at_u << ' ' << at_v;
        closest += height > bound - 0.02 ? 1 : 0;
      }
      EXPECT_GT(closest, 50);
    }
}

}  // namespace surface_test
