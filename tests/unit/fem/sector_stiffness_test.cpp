// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/sector_stiffness.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

#include "rondo/fem/assembly.hpp"
#include "rondo/mesh/disk.hpp"

namespace sector_stiffness_test {

using namespace rondo;

namespace {

const fem::Material material{2.0e7, 0.3, 1100.0, fem::Plane::strain};

std::vector<mesh::Disk> disks() {
  mesh::Disk smooth, graded, treaded, three;
  smooth.radial = 5, smooth.circumferential = 33;
  graded.radial = 7, graded.circumferential = 24, graded.grading = 1.8;
  treaded.radial = 4, treaded.tread = mesh::Tread{.pitches = 11, .layers = 3};
  three.radial = 3, three.tread = mesh::Tread{.pitches = 3, .land_columns = 5, .groove_columns = 4};
  return {smooth, graded, treaded, three};
}

}  // namespace

/// Any field, smooth or not over the sectors: the assembled stiffness is the independent one.
TEST(SectorStiffness, ProductIsThatOfTheAssembledStiffness) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-1.0, 1.0);
  for (const mesh::Disk& disk : disks()) {
    const mesh::Mesh mesh = mesh::make_disk(disk);
    const fem::BlockCsr k = fem::assemble_stiffness(mesh, {&material, 1});
    const fem::SectorStiffness sector = fem::assemble_sector(mesh, {&material, 1});
    std::vector<Vec2> u(mesh.n_nodes()), out(mesh.n_nodes(), Vec2{7.0, 7.0});
    for (Vec2& v : u) v = {x(random), x(random)};
    fem::apply(sector, u, out);
    double largest = 0.0, error = 0.0;
    for (std::size_t row = 0; row < mesh.n_nodes(); ++row) {
      Vec2 sum;
      for (auto at = k.row_start[row]; at < k.row_start[row + 1]; ++at) {
        const auto& b = k.values[static_cast<std::size_t>(at)];
        const Vec2 c = u[static_cast<std::size_t>(k.column[static_cast<std::size_t>(at)])];
        sum += {b[0] * c.x + b[2] * c.y, b[1] * c.x + b[3] * c.y};
      }
      largest = std::max(largest, norm(sum));
      error = std::max(error, norm(sum - out[row]));
    }
    EXPECT_GT(largest, 1e6);
    // The edges of an element are differences of coordinates thirty times as long: 3e-15 of each.
    EXPECT_LT(error, 5e-14 * largest);
  }
}

TEST(SectorStiffness, IsSymmetricToTheLastBit) {
  for (const mesh::Disk& disk : disks()) {
    const fem::SectorStiffness k = fem::assemble_sector(mesh::make_disk(disk), {&material, 1});
    std::map<std::tuple<std::size_t, std::size_t, int>, std::array<double, 4>> blocks;
    for (std::size_t a = 0; a < k.n_local(); ++a)
      for (const auto& e : k.row(a))
        blocks[{a, static_cast<std::size_t>(e.column), e.shift}] = e.block;
    EXPECT_EQ(blocks.size(), k.entries.size());
    for (const auto& [key, b] : blocks) {
      const auto& [row, column, shift] = key;
      const std::array<double, 4> t{b[0], b[2], b[1], b[3]};
      EXPECT_EQ((blocks.at({column, row, -shift})), t);
    }
  }
}

/// A row couples only with the layers beside it: with what is at most two layers of nodes away.
TEST(SectorStiffness, RowsGoOutwardsLayerByLayer) {
  for (const mesh::Disk& disk : disks()) {
    const mesh::Mesh mesh = mesh::make_disk(disk);
    const fem::SectorStiffness k = fem::assemble_sector(mesh, {&material, 1});
    double radius = disk.inner_radius;
    for (std::size_t a = 0; a < k.n_local(); ++a) {
      const double r = norm(mesh.coordinates[k.node(a, 0)]);
      EXPECT_GT(r, radius - 1e-12);
      radius = r;
    }
  }
}

}  // namespace sector_stiffness_test
