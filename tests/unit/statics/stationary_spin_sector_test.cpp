// SPDX-License-Identifier: BSD-3-Clause
/// Stationary spin by harmonics, against the assembled stiffness.
#include <gtest/gtest.h>

#include <cmath>

#include "rondo/statics/stationary_spin.hpp"
#include "support/rings.hpp"

namespace stationary_spin_sector_test {

using namespace rondo;
using namespace rondo::statics;

namespace {

const fem::Material soft{5e6, 0.45, 1100.0, fem::Plane::strain};

struct Body {
  mesh::Mesh mesh;
  fem::BlockCsr k;
  fem::SectorStiffness sector;
  std::vector<double> mass;
  std::vector<int> free;
};

Body body(const mesh::Disk& disk) {
  Body b{mesh::make_disk(disk), {}, {}, {}, {}};
  b.k = fem::assemble_stiffness(b.mesh, {&soft, 1});
  b.sector = fem::assemble_sector(b.mesh, {&soft, 1});
  b.mass = fem::lumped_mass(b.mesh, {&soft, 1});
  b.free = fem::free_nodes(b.mesh);
  return b;
}

bool stable(const Body& b, double spin) {
  return stationary_spin(b.sector, b.mass, b.mesh.coordinates, spin).status == SpinStatus::solved;
}

}  // namespace

TEST(StationarySpinBySectors, IsThatOfTheAssembledStiffness) {
  for (const mesh::Disk& disk : test::cyclic_disks()) {
    const Body b = body(disk);
    const auto found = stationary_spin(b.sector, b.mass, b.mesh.coordinates, -50.0);
    const auto expected = stationary_spin(b.k, b.mass, b.mesh.coordinates, b.free, -50.0);
    ASSERT_EQ(found.status, SpinStatus::solved);
    ASSERT_EQ(expected.status, SpinStatus::solved);
    EXPECT_LT(found.residual, 1e-12);
    double largest = 0.0, error = 0.0;
    for (std::size_t i = 0; i < found.u.size(); ++i) {
      largest = std::max(largest, norm(expected.u.plane()[i]));
      error = std::max(error, norm(found.u.plane()[i] - expected.u.plane()[i]));
    }
    EXPECT_GT(largest, 1e-5);
    EXPECT_LT(error, 1e-12 * largest);
    for (const int node : b.mesh.clamped)
      EXPECT_EQ(found.u.plane()[static_cast<std::size_t>(node)], Vec2{});
  }
}

/// K u = s²M (X + u) on the whole mesh, by the assembled stiffness.
TEST(StationarySpinBySectors, SolvesTheEquationOfTheBody) {
  const Body b = body(test::cyclic_disks()[3]);
  const double s = 50.0;
  const auto found = stationary_spin(b.sector, b.mass, b.mesh.coordinates, s);
  double rest = 0.0, load = 0.0;
  for (const int node : b.free) {
    const auto i = static_cast<std::size_t>(node);
    const Vec2 x = b.mesh.coordinates[i];
    Vec2 r = -(s * s * b.mass[i]) * (x + found.u.plane()[i]);
    for (auto at = b.k.row_start[i]; at < b.k.row_start[i + 1]; ++at) {
      const auto& block = b.k.values[static_cast<std::size_t>(at)];
      const Vec2 u =
          found.u.plane()[static_cast<std::size_t>(b.k.column[static_cast<std::size_t>(at)])];
      r += {block[0] * u.x + block[2] * u.y, block[1] * u.x + block[3] * u.y};
    }
    rest += dot(r, r);
    load += dot(x, x) * std::pow(s * s * b.mass[i], 2);
  }
  EXPECT_LT(std::sqrt(rest / load), 1e-12);
  EXPECT_GT(found.residual, 0.0);
}

TEST(StationarySpinBySectors, NoSpinNoDisplacement) {
  const Body b = body(test::cyclic_disks()[0]);
  const auto found = stationary_spin(b.sector, b.mass, b.mesh.coordinates, 0.0);
  EXPECT_EQ(found.status, SpinStatus::solved);
  EXPECT_EQ(found.residual, 0.0);
  EXPECT_EQ(found.u, Field(b.mesh.n_nodes(), 2));
}

/// Both sides of the softening limit, as the assembled stiffness sees it; on the last disk another
/// harmonic than 0 gives way first.
TEST(StationarySpinBySectors, BeyondTheSofteningLimitItSaysSo) {
  for (const mesh::Disk& disk : test::cyclic_disks()) {
    const Body b = body(disk);
    double below = 10.0, above = 5000.0;
    while (above - below > 1e-3) {
      const double middle = 0.5 * (below + above);
      (eigenvalues_above(b.k, b.mass, b.free, middle * middle) ? below : above) = middle;
    }
    below *= 1.0 - 1e-9, above *= 1.0 + 1e-9;
    EXPECT_TRUE(eigenvalues_above(b.sector, b.mass, below * below));
    EXPECT_FALSE(eigenvalues_above(b.sector, b.mass, above * above));
    EXPECT_TRUE(stable(b, below));
    EXPECT_FALSE(stable(b, above));
  }
}

/// The lowest eigenvalue, 3e6, in one harmonic after another: none is left out.
TEST(StationarySpinBySectors, SeesAnyHarmonicThatGivesWay) {
  for (const int n : {4, 12, 30}) {
    const std::vector<double> mass(static_cast<std::size_t>(n), 1.0);
    const std::vector<Vec2> x(static_cast<std::size_t>(n), Vec2{0.0, -1.0});
    for (int p = 0; p <= n / 2; ++p) {
      const fem::SectorStiffness ring = test::ring(n, p);
      EXPECT_TRUE(eigenvalues_above(ring, mass, 2.9999e6));
      EXPECT_FALSE(eigenvalues_above(ring, mass, 3.0001e6)) << n << " " << p;
      EXPECT_EQ(stationary_spin(ring, mass, x, std::sqrt(2.9999e6)).status, SpinStatus::solved);
      EXPECT_EQ(stationary_spin(ring, mass, x, std::sqrt(3.0001e6)).status, SpinStatus::unstable);
    }
  }
}

}  // namespace stationary_spin_sector_test
