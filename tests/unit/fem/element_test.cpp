// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/element.hpp"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <random>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/mesh/disk.hpp"

namespace element_test {

using namespace rondo;
using namespace rondo::fem;

namespace {

const Material rubber{2.0e7, 0.3, 1100.0, Plane::strain};
const std::vector<Vec2> quad{{0.1, 0.0}, {1.3, -0.2}, {1.1, 0.9}, {-0.1, 0.7}};
const std::vector<Vec2> triangle{{0.1, 0.0}, {1.3, -0.2}, {0.4, 0.9}};

}  // namespace

TEST(Hooke, PlaneStrainAndPlaneStress) {
  const Hooke strain = hooke(rubber);
  const double lambda = 2e7 * 0.3 / (1.3 * 0.4), mu = 2e7 / 2.6;
  EXPECT_NEAR(strain.d11, lambda + 2 * mu, 1e-7);
  EXPECT_NEAR(strain.d12, lambda, 1e-7);
  EXPECT_NEAR(strain.d33, mu, 1e-7);
  Material thin = rubber;
  thin.plane = Plane::stress;
  const Hooke stress = hooke(thin);
  // Uniaxial tension: ε_xx = 1, ε_yy = -ν gives σ_xx = E and no other stress.
  EXPECT_NEAR(stress.d11 - 0.3 * stress.d12, 2e7, 1e-7);
  EXPECT_NEAR(stress.d12 - 0.3 * stress.d11, 0.0, 1e-7);
  EXPECT_EQ(stress.zz, 0.0);
  EXPECT_NEAR(wave_speeds(rubber).pressure, std::sqrt((lambda + 2 * mu) / 1100), 1e-12);
}

TEST(Element, StiffnessIsSymmetricWithThreeRigidMotions) {
  for (const auto& x : {quad, triangle}) {
    const ElementMatrix k = element_stiffness(x, element_law(rubber));
    EXPECT_LT((k - k.transpose()).norm(), 1e-15 * k.norm());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(k)};
    const Eigen::VectorXd values = solver.eigenvalues();
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(values[i], 0.0, 1e-14 * k.norm());
    EXPECT_GT(values[3], 1e-3 * k.norm());
  }
}

TEST(Element, MassesSumToTheArea) {
  for (const auto& x : {quad, triangle}) {
    const auto m = element_masses(x, 2.0);
    double polygon = 0.0;
    for (std::size_t a = 0; a < x.size(); ++a) polygon += 0.5 * cross(x[a], x[(a + 1) % x.size()]);
    EXPECT_NEAR(m[0] + m[1] + m[2] + m[3], 2.0 * polygon, 1e-15);
  }
  // Quadrature at the corners: a corner's mass is ρ/4 of the parallelogram of its two edges.
  const double corner = cross(quad[1] - quad[0], quad[3] - quad[0]);
  EXPECT_NEAR(element_masses(quad, 2.0)[0], 2.0 * 0.25 * corner, 1e-15);
}

TEST(Element, InvertedElementsAreSeen) {
  std::vector<Vec2> turned(quad.rbegin(), quad.rend());
  EXPECT_LT(smallest_jacobian(turned), 0.0);
  EXPECT_GT(smallest_jacobian(quad), 0.0);
  const std::vector<Vec2> dart{{0, 0}, {1, 0}, {0.2, 0.2}, {0, 1}};  // concave at its third corner
  EXPECT_LT(smallest_jacobian(dart), 0.0);
}

TEST(Element, StressOfALinearFieldIsExact) {
  const Hooke d = hooke(rubber);
  for (const auto& x : {quad, triangle}) {
    std::vector<Vec2> u;
    for (const Vec2 p : x) u.push_back({1e-3 * p.x + 2e-3 * p.y, -3e-3 * p.x + 4e-3 * p.y});
    const auto s = element_stress(x, u, element_law(rubber));
    for (std::size_t a = 0; a < x.size(); ++a) {
      EXPECT_NEAR(s[a][0], d.d11 * 1e-3 + d.d12 * 4e-3, 1e-9 * d.d11);
      EXPECT_NEAR(s[a][1], d.d12 * 1e-3 + d.d11 * 4e-3, 1e-9 * d.d11);
      EXPECT_NEAR(s[a][2], 0.3 * (s[a][0] + s[a][1]), 1e-9 * d.d11);
      EXPECT_NEAR(s[a][3], d.d33 * -1e-3, 1e-9 * d.d11);
    }
  }
}

/// u = (xy, 0) on |x|, |y| <= 1: ε_xx = y and γ_xy = x, which two Gauss points a side integrate
/// exactly and the bilinear field through them carries exactly to the corners.
TEST(Element, BendingEnergyAndStressAreExactOnASquare) {
  const std::vector<Vec2> x{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const Hooke d = hooke(rubber);
  std::vector<Vec2> u;
  Eigen::VectorXd v(8);
  for (std::size_t a = 0; a < 4; ++a) {
    u.push_back({x[a].x * x[a].y, 0.0});
    v.segment<2>(static_cast<Eigen::Index>(2 * a)) = Eigen::Vector2d(u[a].x, 0.0);
  }
  const double expected = 4.0 / 3.0 * (d.d11 + d.d33);  // ∫ d11 y² + d33 x²
  EXPECT_NEAR(v.dot(element_stiffness(x, element_law(rubber)) * v), expected, 1e-14 * expected);
  const auto s = element_stress(x, u, element_law(rubber));
  for (std::size_t a = 0; a < 4; ++a) {
    EXPECT_NEAR(s[a][0], d.d11 * x[a].y, 1e-14 * d.d11);
    EXPECT_NEAR(s[a][1], d.d12 * x[a].y, 1e-14 * d.d11);
    EXPECT_NEAR(s[a][3], d.d33 * x[a].x, 1e-14 * d.d11);
  }
}

TEST(Assembly, StiffnessIsSymmetricToTheBitAndSkipsClampedNodes) {
  mesh::Disk disk;
  disk.radial = 3;
  disk.circumferential = 9;
  const mesh::Mesh m = mesh::make_disk(disk);
  const BlockCsr k = assemble_stiffness(m, {&rubber, 1});
  const std::vector<int> free = free_nodes(m);
  EXPECT_EQ(free.size(), 27U);
  const Eigen::SparseMatrix<double> a = free_matrix(k, free);
  EXPECT_EQ((a - Eigen::SparseMatrix<double>(a.transpose())).norm(), 0.0);
  for (const int node : m.clamped) {
    const auto row = static_cast<std::size_t>(node);
    EXPECT_EQ(k.row_start[row], k.row_start[row + 1]);
    for (const int column : k.column) ASSERT_NE(column, node);
  }
}

TEST(Assembly, ElementBoundIsAboveTheLargestEigenvalue) {
  mesh::Disk disk;
  disk.radial = 3;
  disk.circumferential = 12;
  const mesh::Mesh m = mesh::make_disk(disk);
  const std::vector<int> free = free_nodes(m);
  const std::vector<double> mass = lumped_mass(m, {&rubber, 1});
  Eigen::MatrixXd a = free_matrix(assemble_stiffness(m, {&rubber, 1}), free);
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j)
      a(i, j) /= std::sqrt(mass[static_cast<std::size_t>(free[static_cast<std::size_t>(i / 2)])] *
                           mass[static_cast<std::size_t>(free[static_cast<std::size_t>(j / 2)])]);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  const double bound = element_eigenvalue_bound(m, {&rubber, 1});
  EXPECT_GE(bound, solver.eigenvalues().maxCoeff());
  EXPECT_LT(bound, 2.0 * solver.eigenvalues().maxCoeff());
}

TEST(StressRecovery, LinearFieldOnADisk) {
  const mesh::Mesh m = mesh::make_disk({});
  StressRecovery recovery(m, {&rubber, 1});
  std::vector<Vec2> u;
  for (const Vec2 p : m.coordinates) u.push_back({1e-3 * p.x, 0.0});
  const Hooke d = hooke(rubber);
  for (const Stress& s : recovery(u)) {
    ASSERT_NEAR(s[0], d.d11 * 1e-3, 1e-9 * d.d11);
    ASSERT_NEAR(s[3], 0.0, 1e-9 * d.d11);
  }
  EXPECT_NEAR(von_mises({3.0, 0.0, 0.0, 0.0}), 3.0, 1e-15);
  EXPECT_NEAR(von_mises({0.0, 0.0, 0.0, 2.0}), 2.0 * std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(von_mises({5.0, 5.0, 5.0, 0.0}), 0.0, 1e-15);
}

}  // namespace element_test
