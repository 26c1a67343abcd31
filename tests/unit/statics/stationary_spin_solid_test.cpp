// SPDX-License-Identifier: BSD-3-Clause
/// Stationary spin of wheels in three dimensions, against their whole stiffness.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/mesh/solid/wheel.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "support/rings.hpp"

namespace stationary_spin_solid_test {

using namespace rondo;
using namespace rondo::statics;

namespace {

const fem::Material soft{5e6, 0.45, 1100.0, fem::Plane::strain, fem::Integration::b_bar};

struct Body {
  mesh::Mesh mesh;
  fem::SolidSector k;
  std::vector<double> mass;
};

Body body(const mesh::Wheel& wheel) {
  Body b{mesh::make_wheel(wheel), {}, {}};
  b.k = fem::assemble_solid_sector(b.mesh, {&soft, 1});
  b.mass = fem::solid_mass(b.mesh, {&soft, 1});
  return b;
}

std::vector<mesh::Wheel> wheels() {
  mesh::Wheel smooth;
  smooth.width = 0.1;
  smooth.axial = 2;
  smooth.disk.radial = 3;
  smooth.disk.circumferential = 12;
  mesh::Wheel treaded = smooth;
  treaded.axial = 3;
  treaded.disk.radial = 2;
  treaded.disk.tread = mesh::Tread{.pitches = 5, .depth = 0.03, .land_columns = 2, .layers = 1};
  mesh::Wheel thin = smooth;
  thin.axial = 1;
  thin.width = 0.01;
  return {smooth, treaded, thin};
}

/// K of the free nodes, three numbers a node, from its products with unit vectors.
Eigen::MatrixXd whole_stiffness(const Body& b) {
  const std::size_t n = b.mesh.n_nodes();
  const auto size = static_cast<Eigen::Index>(3 * n);
  Eigen::MatrixXd k(size, size);
  std::vector<Vec3> u(n), force(n);
  for (Eigen::Index c = 0; c < size; ++c) {
    const auto node = static_cast<std::size_t>(c / 3);
    u.assign(n, {});
    (c % 3 == 0 ? u[node].x : c % 3 == 1 ? u[node].y : u[node].z) = 1.0;
    fem::apply(b.k, u, force);
    for (std::size_t i = 0; i < n; ++i)
      k.col(c).segment<3>(static_cast<Eigen::Index>(3 * i)) << force[i].x, force[i].y, force[i].z;
  }
  for (const int node : b.mesh.clamped) k.block<3, 3>(3 * node, 3 * node).setIdentity();
  return k;
}

/// Whether K - s² M P is positive definite, clamped nodes left out.
bool positive(const Body& b, Eigen::MatrixXd k, double spin) {
  const std::vector<char> clamped = mesh::clamped_flags(b.mesh);
  for (std::size_t i = 0; i < b.mesh.n_nodes(); ++i)
    if (!clamped[i])
      for (std::size_t c = 0; c < 2; ++c)
        k(static_cast<Eigen::Index>(3 * i + c), static_cast<Eigen::Index>(3 * i + c)) -=
            spin * spin * b.mass[i];
  return Eigen::LLT<Eigen::MatrixXd>(k).info() == Eigen::Success;
}

/// A ring whose nodes are held along the axle, softly: that does not soften.
fem::SolidSector ring(int n, int p) {
  const fem::SectorStiffness plane = test::ring(n, p);
  fem::SolidSector k{n, 1, plane.nodes, plane.row_start, {}, plane.turn};
  for (const auto& [column, shift, b] : plane.entries)
    k.entries.push_back(
        {column, shift, {b[0], b[1], 0, b[2], b[3], 0, 0, 0, shift == 0 ? 1e5 : 0.0}});
  return k;
}

}  // namespace

TEST(StationarySpinSolid, SolvesTheEquationOfTheBody) {
  const double s = -50.0;
  for (const mesh::Wheel& wheel : wheels()) {
    const Body b = body(wheel);
    const auto found = stationary_spin(b.k, b.mass, b.mesh.coordinates, s);
    ASSERT_EQ(found.status, SpinStatus::solved);
    EXPECT_LT(found.residual, 1e-12);
    std::vector<Vec3> force(b.mesh.n_nodes());
    const std::span<const Vec3> u = found.u.space();
    fem::apply(b.k, u, force);
    const std::vector<char> clamped = mesh::clamped_flags(b.mesh);
    double rest = 0.0, load = 0.0, contracted = 0.0;
    for (std::size_t i = 0; i < b.mesh.n_nodes(); ++i) {
      if (clamped[i]) {
        EXPECT_EQ(u[i], Vec3{});
        continue;
      }
      const Vec2 pull = (s * s * b.mass[i]) * (b.mesh.coordinates[i] + u[i].plane());
      const Vec3 r = force[i] - pull;
      rest += dot(r, r);
      load += dot(pull, pull);
      contracted -= u[i].z * b.mesh.axial[i];
    }
    EXPECT_LT(std::sqrt(rest / load), 1e-11);
    EXPECT_GT(contracted, 0.0);  // what is drawn outwards gets narrower
  }
}

/// Both sides of the softening limit, as the whole stiffness sees it.
TEST(StationarySpinSolid, BeyondTheSofteningLimitItSaysSo) {
  for (const mesh::Wheel& wheel : wheels()) {
    const Body b = body(wheel);
    const Eigen::MatrixXd k = whole_stiffness(b);
    double below = 10.0, above = 5000.0;
    while (above - below > 1.0) {
      const double middle = 0.5 * (below + above);
      (positive(b, k, middle) ? below : above) = middle;
    }
    EXPECT_TRUE(eigenvalues_above(b.k, b.mass, below * below));
    EXPECT_FALSE(eigenvalues_above(b.k, b.mass, above * above));
    EXPECT_EQ(stationary_spin(b.k, b.mass, b.mesh.coordinates, below).status, SpinStatus::solved);
    const auto none = stationary_spin(b.k, b.mass, b.mesh.coordinates, above);
    EXPECT_EQ(none.status, SpinStatus::unstable);
    EXPECT_EQ(none.u, Field(b.mesh.n_nodes(), 3));
  }
}

/// The lowest eigenvalue, 3e6, in one harmonic after another: none is left out.
TEST(StationarySpinSolid, SeesAnyHarmonicThatGivesWay) {
  for (const int n : {4, 12, 30}) {
    const std::vector<double> mass(static_cast<std::size_t>(n), 1.0);
    const std::vector<Vec2> x(static_cast<std::size_t>(n), Vec2{0.0, -1.0});
    for (int p = 0; p <= n / 2; ++p) {
      const fem::SolidSector k = ring(n, p);
      EXPECT_TRUE(eigenvalues_above(k, mass, 2.9999e6));
      EXPECT_FALSE(eigenvalues_above(k, mass, 3.0001e6)) << n << " " << p;
      EXPECT_EQ(stationary_spin(k, mass, x, std::sqrt(2.9999e6)).status, SpinStatus::solved);
      EXPECT_EQ(stationary_spin(k, mass, x, std::sqrt(3.0001e6)).status, SpinStatus::unstable);
    }
  }
}

}  // namespace stationary_spin_solid_test
