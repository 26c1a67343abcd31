// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/stationary_spin.hpp"

#include <gtest/gtest.h>

#include "rondo/mesh/disk.hpp"

namespace stationary_spin_test {

using namespace rondo;

namespace {

struct Body {
  mesh::Mesh mesh;
  fem::BlockCsr k;
  std::vector<double> mass;
  std::vector<int> free;
};

Body body() {
  mesh::Disk disk;
  disk.radial = 4;
  disk.circumferential = 24;
  Body b{mesh::make_disk(disk), {}, {}, {}};
  const fem::Material m{5e6, 0.45, 1100.0, fem::Plane::strain};
  b.k = fem::assemble_stiffness(b.mesh, {&m, 1});
  b.mass = fem::lumped_mass(b.mesh, {&m, 1});
  b.free = fem::free_nodes(b.mesh);
  return b;
}

}  // namespace

TEST(StationarySpin, IsAnEquilibriumAndTurnsWithTheDisk) {
  const Body b = body();
  const auto s = statics::stationary_spin(b.k, b.mass, b.mesh.coordinates, b.free, -50.0);
  ASSERT_EQ(s.status, statics::SpinStatus::solved);
  EXPECT_LT(s.residual, 1e-13);
  for (std::size_t i = 0; i < b.mesh.n_nodes(); ++i) {
    const auto first = static_cast<std::size_t>(b.mesh.sector_node[i]);
    EXPECT_NEAR(norm(s.u.plane()[i]), norm(s.u.plane()[first]), 1e-16);  // the same in every sector
    EXPECT_NEAR(cross(b.mesh.coordinates[i], s.u.plane()[i]), 0.0, 1e-16);  // radial
  }
}

TEST(StationarySpin, BeyondTheSofteningLimitItSaysSo) {
  const Body b = body();
  EXPECT_TRUE(statics::eigenvalues_above(b.k, b.mass, b.free, 100.0 * 100.0));
  EXPECT_FALSE(statics::eigenvalues_above(b.k, b.mass, b.free, 2000.0 * 2000.0));
  const auto s = statics::stationary_spin(b.k, b.mass, b.mesh.coordinates, b.free, 2000.0);
  EXPECT_EQ(s.status, statics::SpinStatus::unstable);
}

}  // namespace stationary_spin_test
