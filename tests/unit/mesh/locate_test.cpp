// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/locate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "rondo/mesh/disk.hpp"

namespace rondo::mesh::locate_test {
namespace {

Vec2 point(std::span<const Vec2> x, const std::array<double, 4>& n) {
  Vec2 p;
  for (std::size_t a = 0; a < x.size(); ++a) p += n[a] * x[a];
  return p;
}

TEST(ShapeFunctions, InvertTheMapOfADistortedQuadrilateral) {
  const std::array<Vec2, 4> x{{{0, 0}, {2, 0.3}, {1.6, 1.7}, {-0.4, 1.1}}};
  for (const double xi : {-1.0, -0.7, 0.0, 0.31, 1.0})
    for (const double eta : {-1.0, 0.2, 0.99, 1.0}) {
      const std::array<double, 4> n{0.25 * (1 - xi) * (1 - eta), 0.25 * (1 + xi) * (1 - eta),
                                    0.25 * (1 + xi) * (1 + eta), 0.25 * (1 - xi) * (1 + eta)};
      const auto found = shape_functions(x, point(x, n));
      ASSERT_TRUE(found);
      for (std::size_t a = 0; a < 4; ++a) EXPECT_NEAR((*found)[a], n[a], 1e-14);  // round-off
    }
  EXPECT_FALSE(shape_functions(x, {1.0, 0.149}));  // just below the lower edge
  EXPECT_TRUE(shape_functions(x, {1.0, 0.151}));
  EXPECT_FALSE(shape_functions(x, {100.0, -50.0}));
}

TEST(ShapeFunctions, OfATriangle) {
  const std::array<Vec2, 3> x{{{1, 1}, {3, 1}, {1, 4}}};
  const auto found = shape_functions(x, {1.5, 2.0});
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found)[1], 0.25, 1e-15);
  EXPECT_NEAR((*found)[2], 1.0 / 3.0, 1e-15);
  EXPECT_EQ((*found)[3], 0.0);
  EXPECT_TRUE(shape_functions(x, {2.0, 1.0}));  // on an edge
  EXPECT_FALSE(shape_functions(x, {2.0, 0.999}));
}

/// Every point that a cell makes is found in that cell or one beside it.
TEST(CellGrid, FindsEveryPointOfADisk) {
  const Mesh m = make_disk({.radial = 5, .circumferential = 40, .tread = {}});
  const CellGrid grid(m.coordinates, m.cells);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t e = 0; e < m.cells.size(); ++e) {
    std::array<Vec2, 4> x;
    for (std::size_t a = 0; a < 4; ++a)
      x[a] = m.coordinates[static_cast<std::size_t>(m.cells[e][a])];
    const double s = unit(random), t = unit(random);
    const Vec2 p = point(x, {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t});
    const auto near = grid.near(p);
    EXPECT_TRUE(std::ranges::find(near, static_cast<int>(e)) != near.end()) << e;
    const auto n = grid.within(static_cast<int>(e), p);
    ASSERT_TRUE(n) << e;
    EXPECT_LT(norm(point(x, *n) - p), 1e-15);  // round-off of lengths of 0.3
    EXPECT_LT(near.size(), 40U);
  }
}

TEST(CellGrid, OutsideThereIsADistance) {
  const Mesh m = make_disk(
      {.outer_radius = 2.0, .inner_radius = 1.0, .radial = 2, .circumferential = 4, .tread = {}});
  const CellGrid grid(m.coordinates, m.cells);
  for (const int e : grid.near({0.0, -2.5})) EXPECT_FALSE(grid.within(e, {0.0, -2.5}));
  EXPECT_NEAR(grid.distance({0.0, -2.5}), 0.5, 1e-15);
  EXPECT_NEAR(grid.distance({0.0, 0.0}), std::sqrt(0.5), 1e-15);  // to the middle of a chord
}

TEST(CellGrid, OfABarOneCellThick) {
  Mesh m;
  for (int i = 0; i <= 50; ++i)
    for (const double y : {0.0, 1e-6}) m.coordinates.push_back({0.1 * i, y});
  for (int i = 0; i < 50; ++i) m.cells.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  const CellGrid grid(m.coordinates, m.cells);
  const auto near = grid.near({3.33, 5e-7});
  const auto holds = [&](int e) { return grid.within(e, {3.33, 5e-7}).has_value(); };
  const auto found = std::ranges::find_if(near, holds);
  ASSERT_NE(found, near.end());
  EXPECT_EQ(*found, 33);
}

}  // namespace
}  // namespace rondo::mesh::locate_test
