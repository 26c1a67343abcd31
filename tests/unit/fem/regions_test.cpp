// SPDX-License-Identifier: BSD-3-Clause
/// Materials by region: what is assembled is the sum of the regions, each with its own material.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/region_sizes.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/mesh/disk.hpp"
#include "rondo/mesh/solid/wheel.hpp"

namespace regions_test {

using namespace rondo;
using namespace rondo::fem;

namespace {

const std::array materials{Material{2.0e7, 0.3, 1100.0}, Material{3.0e9, 0.45, 1500.0}};

/// The layers of cells turn by turn of the one and the other material.
mesh::Mesh layered_disk() {
  mesh::Disk disk;
  disk.radial = 4;
  disk.circumferential = 9;
  mesh::Mesh m = mesh::make_disk(disk);
  m.region_names = {"soft", "stiff"};
  for (std::size_t e = 0; e < m.cells.size(); ++e) m.region.push_back(static_cast<int>(e % 4 % 2));
  return m;
}

/// The cells of one region; all nodes and clamps.
mesh::Mesh only(const mesh::Mesh& m, int region) {
  mesh::Mesh part = m;
  part.cells.clear();
  part.region.clear();
  for (std::size_t e = 0; e < m.cells.size(); ++e)
    if (m.region[e] == region) part.cells.push_back(m.cells[e]);
  return part;
}

}  // namespace

/// Polygons of 9 corners with radii from the rim to the tread.
TEST(Regions, SizesAreThoseOfThePolygons) {
  const mesh::Mesh m = layered_disk();
  const std::vector<double> found = region_sizes(m, 2);
  double expected[2] = {0.0, 0.0};
  const double turn = 2.0 * std::numbers::pi / 9.0;
  for (int layer = 0; layer < 4; ++layer) {
    const double in = 0.15 + 0.0375 * layer, out = in + 0.0375;
    expected[layer % 2] += 4.5 * std::sin(turn) * (out * out - in * in);
  }
  for (std::size_t r = 0; r < 2; ++r) EXPECT_NEAR(found[r], expected[r], 1e-14);
}

TEST(Regions, SizesOfAWheelAreThoseOfThePolygonsTimesItsWidth) {
  mesh::Wheel wheel;
  wheel.width = 0.1;
  wheel.disk.radial = 3;
  wheel.disk.circumferential = 20;
  const mesh::Mesh m = mesh::make_wheel(wheel);
  const double area = 10.0 * std::sin(2.0 * std::numbers::pi / 20.0) * (0.09 - 0.0225);
  EXPECT_NEAR(region_sizes(m, 1).at(0), 0.1 * area, 1e-15);
}

TEST(Regions, StiffnessAndMassAreSumsOverTheRegions) {
  const mesh::Mesh m = layered_disk();
  const std::vector<int> free = free_nodes(m);
  Eigen::MatrixXd k = free_matrix(assemble_stiffness(m, materials), free);
  const double size = k.norm();
  std::vector<double> mass = lumped_mass(m, materials);
  double bound = 0.0;
  for (int r = 0; r < 2; ++r) {
    const mesh::Mesh part = only(m, r);
    const std::span material(&materials[static_cast<std::size_t>(r)], 1);
    k -= free_matrix(assemble_stiffness(part, material), free);
    const std::vector<double> of_part = lumped_mass(part, material);
    for (std::size_t i = 0; i < mass.size(); ++i) mass[i] -= of_part[i];
    bound = std::max(bound, element_eigenvalue_bound(part, material));
  }
  EXPECT_LT(k.norm(), 1e-15 * size);  // the order of up to four summands
  for (const double left : mass) EXPECT_NEAR(left, 0.0, 1e-14);
  EXPECT_EQ(element_eigenvalue_bound(m, materials), bound);
}

TEST(Regions, TheSectorHasThem) {
  const mesh::Mesh m = layered_disk();
  const BlockCsr k = assemble_stiffness(m, materials);
  const SectorStiffness sector = assemble_sector(m, materials);
  std::vector<Vec2> u(m.n_nodes()), found(m.n_nodes());
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = {std::sin(1.0 + 3.0 * static_cast<double>(i)), std::cos(5.0 * static_cast<double>(i))};
  apply(sector, u, found);
  double largest = 0.0, error = 0.0;
  for (std::size_t row = 0; row < m.n_nodes(); ++row) {
    Vec2 sum;
    for (auto at = k.row_start[row]; at < k.row_start[row + 1]; ++at) {
      const auto& b = k.values[static_cast<std::size_t>(at)];
      const Vec2 c = u[static_cast<std::size_t>(k.column[static_cast<std::size_t>(at)])];
      sum += {b[0] * c.x + b[2] * c.y, b[1] * c.x + b[3] * c.y};
    }
    largest = std::max(largest, norm(sum));
    error = std::max(error, norm(sum - found[row]));
  }
  EXPECT_LT(error, 5e-14 * largest);  // as for one material
  EXPECT_NEAR(sector_eigenvalue_bound(m, materials), element_eigenvalue_bound(m, materials),
              1e-12 * element_eigenvalue_bound(m, materials));
}

TEST(Regions, StressIsThatOfTheOwnMaterial) {
  const mesh::Mesh m = layered_disk();
  StressRecovery recovery(m, materials);
  std::vector<Vec2> u;
  for (const Vec2 p : m.coordinates) u.push_back({1e-3 * p.x, 0.0});
  const std::span<const Stress> stress = recovery(u);
  // Nodes of the rim and of the outer surface are corners of one region only.
  const double soft = hooke(materials[0]).d11 * 1e-3, stiff = hooke(materials[1]).d11 * 1e-3;
  EXPECT_NEAR(stress[0][0], soft, 1e-9 * stiff);
  EXPECT_NEAR(stress[4][0], stiff, 1e-9 * stiff);
}

TEST(Regions, AMissingMaterialIsOurFault) {
  const mesh::Mesh m = layered_disk();
  EXPECT_DEATH(lumped_mass(m, {materials.data(), 1}), "place < materials.size()");
}

}  // namespace regions_test
