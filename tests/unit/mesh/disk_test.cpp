// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/disk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "rondo/core/complex.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/fem/element.hpp"

namespace disk_test {

using namespace rondo;
using mesh::Disk;
using mesh::Mesh;

namespace {

Disk treaded() {
  Disk disk;
  disk.radial = 5;
  disk.tread = mesh::Tread{
      .pitches = 12, .depth = 0.02, .land_columns = 3, .groove_columns = 2, .layers = 2};
  return disk;
}

double radius(const Mesh& m, int node) {
  return norm(m.coordinates[static_cast<std::size_t>(node)]);
}

double area(const Mesh& m) {
  double sum = 0.0;
  for (const auto& c : m.cells) {
    const auto at = [&](std::size_t a) { return m.coordinates[static_cast<std::size_t>(c[a])]; };
    sum += 0.5 * cross(at(2) - at(0), at(3) - at(1));
  }
  return sum;
}

/// Area of a ring of n trapezia between two radii.
double ring_area(double ri, double ro, int columns, int n) {
  return 0.5 * columns * std::sin(2.0 * std::numbers::pi / n) * (ro * ro - ri * ri);
}

}  // namespace

TEST(Disk, SmoothCountsAndOrientation) {
  Disk disk;
  disk.radial = 4;
  disk.circumferential = 10;
  const Mesh m = mesh::make_disk(disk);
  EXPECT_EQ(m.n_nodes(), 50U);
  EXPECT_EQ(m.n_nodes(), mesh::n_disk_nodes(disk));
  EXPECT_EQ(m.cells.size(), 40U);
  EXPECT_EQ(m.clamped.size(), 10U);
  EXPECT_EQ(m.n_sectors, 10);
  EXPECT_NEAR(area(m), ring_area(0.15, 0.30, 10, 10), 1e-15);
  for (const auto& c : m.cells) {
    std::vector<Vec2> x;
    for (const int node : c) x.push_back(m.coordinates[static_cast<std::size_t>(node)]);
    EXPECT_GT(fem::smallest_jacobian(x), 0.0);
  }
}

TEST(Disk, ColumnZeroIsStraightDown) {
  const Mesh m = mesh::make_disk({});
  EXPECT_NEAR(m.coordinates[0].x, 0.0, 1e-16);
  EXPECT_NEAR(m.coordinates[0].y, -0.15, 1e-16);
  const Vec2 next = m.coordinates[13];  // column 1, counter-clockwise: to the right
  EXPECT_GT(next.x, 0.0);
  EXPECT_EQ(m.sector[13], 1);
  EXPECT_EQ(m.sector_node[13], 0);
}

TEST(Disk, SectorsRepeatByRotation) {
  for (const Disk& disk : {Disk{}, treaded()}) {
    const Mesh m = mesh::make_disk(disk);
    const auto n = m.n_nodes() / static_cast<std::size_t>(m.n_sectors);
    for (std::size_t i = 0; i < m.n_nodes(); ++i) {
      const auto first = static_cast<std::size_t>(m.sector_node[i]);
      ASSERT_LT(first, n);
      const Vec2 turned =
          rotation(2.0 * std::numbers::pi * m.sector[i] / m.n_sectors) * m.coordinates[first];
      EXPECT_LT(norm(turned - m.coordinates[i]), 1e-15);
    }
  }
}

TEST(Disk, GradingFollowsItsFormula) {
  Disk disk;
  disk.grading = 2.0;
  disk.radial = 4;
  const Mesh m = mesh::make_disk(disk);
  for (int k = 0; k <= 4; ++k) {
    const double expected = 0.15 + 0.15 * (1.0 - std::pow(1.0 - k / 4.0, 2.0));
    EXPECT_NEAR(radius(m, k), expected, 1e-16) << k;
  }
}

TEST(Disk, TreadHasLandsAndGrooves) {
  const Disk disk = treaded();
  const Mesh m = mesh::make_disk(disk);
  EXPECT_EQ(m.n_nodes(), mesh::n_disk_nodes(disk));
  EXPECT_EQ(m.n_nodes(), 12U * (5 * 6 + 4 * 2));
  EXPECT_EQ(m.cells.size(), 12U * (5 * 5 + 3 * 2));
  EXPECT_EQ(m.boundary.size(), 12U * 4);
  for (const int node : m.boundary) EXPECT_NEAR(radius(m, node), 0.30, 1e-15);
  const double expected = ring_area(0.15, 0.28, 60, 60) + ring_area(0.28, 0.30, 36, 60);
  EXPECT_NEAR(area(m), expected, 1e-15);
  // The first land starts straight down.
  const Vec2 corner = m.coordinates[static_cast<std::size_t>(m.boundary[0])];
  EXPECT_NEAR(corner.x, 0.0, 1e-16);
  EXPECT_LT(corner.y, 0.0);
}

TEST(Disk, TributaryLengthsSumToTheContactBoundary) {
  const double chord = 2.0 * 0.30 * std::sin(std::numbers::pi / 180);
  const Mesh smooth = mesh::make_disk({});
  EXPECT_NEAR(std::accumulate(smooth.tributary.begin(), smooth.tributary.end(), 0.0), 180 * chord,
              1e-13);
  const Mesh m = mesh::make_disk(treaded());
  const double land = 2.0 * 0.30 * std::sin(std::numbers::pi / 60);
  EXPECT_NEAR(std::accumulate(m.tributary.begin(), m.tributary.end(), 0.0), 36 * land, 1e-13);
  EXPECT_NEAR(m.tributary[0], 0.5 * land, 1e-15);  // a land's edge stands for half a chord
  EXPECT_NEAR(m.tributary[1], land, 1e-15);
}

TEST(Disk, EveryNodeBelongsToACellOnce) {
  const Mesh m = mesh::make_disk(treaded());
  std::set<int> used;
  for (const auto& c : m.cells) used.insert(c.begin(), c.end());
  EXPECT_EQ(used.size(), m.n_nodes());
  std::set<std::pair<int, int>> places;
  for (std::size_t i = 0; i < m.n_nodes(); ++i) places.insert({m.sector[i], m.sector_node[i]});
  EXPECT_EQ(places.size(), m.n_nodes());
}

}  // namespace disk_test
