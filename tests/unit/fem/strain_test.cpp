// SPDX-License-Identifier: BSD-3-Clause
/// Strain and volume of cells, against linear fields whose gradient is known.
#include "rondo/fem/strain.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rondo::fem::strain_test {
namespace {

/// A skew quadrilateral and a triangle on its right.
mesh::Mesh two_cells() {
  mesh::Mesh m;
  m.coordinates = {{0.0, 0.0}, {2.0, 0.3}, {2.4, 1.7}, {-0.2, 1.1}, {4.0, 0.5}};
  m.cells = {{0, 1, 2, 3}, {1, 4, 2, -1}};
  return m;
}

std::vector<Vec2> linear(const mesh::Mesh& m, double xx, double xy, double yx, double yy) {
  std::vector<Vec2> u;
  for (const Vec2 x : m.coordinates) u.push_back({xx * x.x + xy * x.y, yx * x.x + yy * x.y});
  return u;
}

TEST(Strain, OfALinearField) {
  const mesh::Mesh m = two_cells();
  const Deformation d = deformation(m, linear(m, 0.04, 0.05, -0.01, -0.06));
  // Principal strains: -0.01 ± sqrt(0.05² + 0.02²).
  EXPECT_NEAR(d.strain, 0.01 + std::hypot(0.05, 0.02), 1e-15);
  EXPECT_NEAR(d.jacobian, 1.04 * 0.94 + 0.05 * 0.01, 1e-15);
}

TEST(Strain, NamesTheCell) {
  const mesh::Mesh m = two_cells();
  std::vector<Vec2> u(m.n_nodes());
  EXPECT_EQ(deformation(m, u).strain, 0.0);
  EXPECT_EQ(deformation(m, u).jacobian, 1.0);
  u[4] = {-0.5, 0.0};  // of the triangle alone
  EXPECT_EQ(deformation(m, u).strain_cell, 1U);
  EXPECT_EQ(deformation(m, u).jacobian_cell, 1U);
  u[4] = {-3.0, 0.0};  // through its other side
  EXPECT_LT(deformation(m, u).jacobian, 0.0);
}

TEST(Strain, OfLinearCellsStandsApart) {
  const mesh::Mesh m = two_cells();
  std::vector<Vec2> u(m.n_nodes());
  u[4] = {-0.5, 0.0};  // of the triangle alone
  const std::vector<char> first_is_rubber{1, 0}, second_is_rubber{0, 1}, all{1, 1};
  for (const Deformation& d : {deformation(m, u), deformation(m, u, first_is_rubber)}) {
    EXPECT_GT(d.strain, 0.1);
    EXPECT_EQ(d.linear_strain, d.strain);
    EXPECT_EQ(d.linear_cell, 1U);
  }
  EXPECT_EQ(deformation(m, u, second_is_rubber).linear_strain, 0.0);
  u[3] = {0.01, 0.0};
  const Deformation d = deformation(m, u, second_is_rubber);
  EXPECT_EQ(d.strain_cell, 1U);
  EXPECT_EQ(d.linear_cell, 0U);
  EXPECT_GT(d.linear_strain, 0.0);
  EXPECT_LT(d.linear_strain, d.strain);
  EXPECT_EQ(deformation(m, u, all).linear_strain, 0.0);
}

/// Where the map is not linear: the areas at the corners are not that of the center.
TEST(Strain, JacobianIsTheLeastOfTheCorners) {
  mesh::Mesh m;
  m.coordinates = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  m.cells = {{0, 1, 2, 3}};
  EXPECT_EQ(deformation(m, std::vector<Vec2>{{}, {}, {0.5, 0.25}, {}}).jacobian, 1.0);  // corner 0
  // Pushed through the diagonal: area 0.3 of 1, and that corner is inverted.
  EXPECT_NEAR(deformation(m, std::vector<Vec2>{{}, {}, {-0.7, -0.7}, {}}).jacobian, -0.4, 1e-15);
  // Over that undeformed at the same corner: 0.25 over 0.5 of a trapezium.
  m.coordinates[2] = {0.5, 1.0};
  EXPECT_NEAR(deformation(m, std::vector<Vec2>{{}, {}, {-0.25, 0.0}, {}}).jacobian, 0.5, 1e-15);
}

TEST(Strain, EveryCornerIsLookedAt) {
  mesh::Mesh m;
  m.coordinates = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  m.cells = {{0, 1, 2, 3}};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    std::vector<Vec2> u(4);
    u[corner] = 1.4 * (Vec2{0.5, 0.5} - m.coordinates[corner]);
    EXPECT_NEAR(deformation(m, u).jacobian, -0.4, 1e-15) << corner;
  }
}

TEST(Strain, TheLargestStays) {
  LargestDeformation all;
  all.add({0.2, 3, 0.9, 4, 0.02, 9}, 1.0);
  all.add({0.1, 5, 0.8, 6, 0.03, 10}, 2.0);
  all.add({0.2, 7, 0.8, 8, 0.03, 11}, 3.0);
  EXPECT_EQ(all.found.strain_cell, 3U);
  EXPECT_EQ(all.strain_time, 1.0);
  EXPECT_EQ(all.found.jacobian_cell, 6U);
  EXPECT_EQ(all.jacobian_time, 2.0);
  EXPECT_EQ(all.found.linear_cell, 10U);
  EXPECT_EQ(all.linear_time, 2.0);
}

}  // namespace
}  // namespace rondo::fem::strain_test
