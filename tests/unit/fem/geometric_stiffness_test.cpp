// SPDX-License-Identifier: BSD-3-Clause
/// Stiffness by the stress of a displacement.
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "support/rings.hpp"

namespace geometric_stiffness_test {

using namespace rondo;
using namespace rondo::fem;

namespace {

const Material rubber{2.0e7, 0.3, 1100.0, Plane::strain};
const Material soft{5.0e6, 0.49, 1100.0, Plane::strain, Integration::b_bar};
const std::vector<Vec2> quad{{0.1, 0.0}, {1.3, -0.2}, {1.1, 0.9}, {-0.1, 0.7}};
const std::vector<Vec2> triangle{{0.1, 0.0}, {1.3, -0.2}, {0.4, 0.9}};

double area(const std::vector<Vec2>& x) {
  double sum = 0.0;
  for (std::size_t a = 0; a < x.size(); ++a) sum += 0.5 * cross(x[a], x[(a + 1) % x.size()]);
  return sum;
}

/// Outwards by some percent, and turned: strains large enough for the stress to count.
std::vector<Vec2> stretched(const mesh::Mesh& mesh) {
  std::vector<Vec2> u;
  for (const Vec2 x : mesh.coordinates) u.push_back((norm(x) - 0.1) * (Complex{0.2, 0.05} * x));
  return u;
}

std::vector<Vec2> random_field(std::size_t n) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-1.0, 1.0);
  std::vector<Vec2> u(n);
  for (Vec2& v : u) v = {x(random), x(random)};
  return u;
}

std::vector<Vec2> product(const BlockCsr& k, const std::vector<Vec2>& u) {
  std::vector<Vec2> out(u.size());
  for (std::size_t row = 0; row < u.size(); ++row)
    for (auto at = k.row_start[row]; at < k.row_start[row + 1]; ++at) {
      const auto& b = k.values[static_cast<std::size_t>(at)];
      const Vec2 c = u[static_cast<std::size_t>(k.column[static_cast<std::size_t>(at)])];
      out[row] += {b[0] * c.x + b[2] * c.y, b[1] * c.x + b[3] * c.y};
    }
  return out;
}

}  // namespace

/// The energy of v = G x under the even stress of u = F x is A Σ_k G_k σ G_kᵀ: a translation has
/// none, a turn by φ has φ² A (σ_xx + σ_yy).
TEST(GeometricStiffness, EnergyOfLinearFieldsIsExact) {
  for (const Material& m : {rubber, soft})
    for (const auto& x : {quad, triangle}) {
      const auto n = static_cast<Eigen::Index>(2 * x.size());
      std::vector<Vec2> u;
      for (const Vec2 p : x) u.push_back({1e-3 * p.x + 2e-3 * p.y, -3e-3 * p.x + 4e-3 * p.y});
      const Stress s = element_stress(x, u, element_law(m))[0];
      const ElementMatrix k = element_geometric_stiffness(x, u, element_law(m));
      EXPECT_EQ(k.rows(), n);
      const std::array<std::array<double, 4>, 3> gradients{
          {{0.0, -1.0, 1.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, {0.3, -0.7, 1.1, 0.4}}};
      for (const auto& g : gradients) {
        Eigen::VectorXd v(n);
        for (std::size_t a = 0; a < x.size(); ++a)
          v.segment<2>(static_cast<Eigen::Index>(2 * a)) = Eigen::Vector2d(
              5.0 + g[0] * x[a].x + g[1] * x[a].y, 7.0 + g[2] * x[a].x + g[3] * x[a].y);
        double expected = 0.0;
        for (std::size_t row = 0; row < 4; row += 2)
          expected += g[row] * g[row] * s[0] + g[row + 1] * g[row + 1] * s[1] +
                      2.0 * g[row] * g[row + 1] * s[3];
        expected *= area(x);
        EXPECT_NEAR(v.dot(k * v), expected, 1e-11 * std::abs(expected));  // v is 5 to 8 long
      }
    }
}

TEST(GeometricStiffness, IsAddedWithinTheSamePattern) {
  for (const mesh::Disk& disk : test::cyclic_disks()) {
    const mesh::Mesh m = mesh::make_disk(disk);
    const BlockCsr elastic = assemble_stiffness(m, {&soft, 1});
    const BlockCsr k = assemble_stiffness(m, {&soft, 1}, stretched(m));
    EXPECT_EQ(k.row_start, elastic.row_start);
    EXPECT_EQ(k.column, elastic.column);
    const std::vector<int> free = free_nodes(m);
    const Eigen::SparseMatrix<double> a = free_matrix(k, free);
    EXPECT_EQ((a - Eigen::SparseMatrix<double>(a.transpose())).norm(), 0.0);
    EXPECT_GT((a - free_matrix(elastic, free)).norm(), 1e-4 * a.norm());
    // The stress of no displacement is none.
    const BlockCsr none = assemble_stiffness(m, {&soft, 1}, std::vector<Vec2>(m.n_nodes()));
    EXPECT_EQ(none.values, elastic.values);
  }
}

TEST(GeometricStiffness, TheSectorHasIt) {
  for (const Material& material : {rubber, soft})
    for (const mesh::Disk& disk : test::cyclic_disks()) {
      const mesh::Mesh m = mesh::make_disk(disk);
      const std::vector<Vec2> prestress = stretched(m), u = random_field(m.n_nodes());
      const auto expected = product(assemble_stiffness(m, {&material, 1}, prestress), u);
      std::vector<Vec2> found(m.n_nodes());
      apply(assemble_sector(m, {&material, 1}, prestress), u, found);
      double largest = 0.0, error = 0.0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (expected[i] == Vec2{}) continue;  // clamped
        largest = std::max(largest, norm(expected[i]));
        error = std::max(error, norm(found[i] - expected[i]));
      }
      EXPECT_GT(largest, 1e6);
      EXPECT_LT(error, 5e-14 * largest);  // as without stress
    }
}

/// Pressed, pulled, and with nothing.
TEST(GeometricStiffness, ElementBoundIsAboveTheLargestEigenvalue) {
  for (const mesh::Disk& disk : test::cyclic_disks()) {
    const mesh::Mesh m = mesh::make_disk(disk);
    const std::vector<int> free = free_nodes(m);
    const std::vector<double> mass = lumped_mass(m, {&soft, 1});
    const double without = element_eigenvalue_bound(m, {&soft, 1});
    for (const double factor : {-1.0, 1.0}) {
      std::vector<Vec2> prestress = stretched(m);
      for (Vec2& u : prestress) u = factor * u;
      Eigen::MatrixXd a = free_matrix(assemble_stiffness(m, {&soft, 1}, prestress), free);
      for (Eigen::Index i = 0; i < a.rows(); ++i)
        for (Eigen::Index j = 0; j < a.cols(); ++j) {
          const auto node = [&](Eigen::Index k) {
            return static_cast<std::size_t>(free[static_cast<std::size_t>(k / 2)]);
          };
          a(i, j) /= std::sqrt(mass[node(i)] * mass[node(j)]);
        }
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, Eigen::EigenvaluesOnly);
      const double largest = solver.eigenvalues().maxCoeff();
      const double bound = element_eigenvalue_bound(m, {&soft, 1}, prestress);
      EXPECT_GE(bound, largest);
      EXPECT_LT(bound, 3.0 * largest);
      EXPECT_NEAR(sector_eigenvalue_bound(m, {&soft, 1}, prestress), bound, 1e-12 * bound);
      EXPECT_GT(factor * (bound - without), 1e-4 * without);
    }
  }
}

}  // namespace geometric_stiffness_test
