// SPDX-License-Identifier: BSD-3-Clause
/// Triangles whose volumetric strain is a mean at the nodes.
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/nodal_dilatation.hpp"
#include "rondo/fem/stress.hpp"

namespace nodal_dilatation_test {

using namespace rondo;
using namespace rondo::fem;

namespace {

const Material rubber{5.0e6, 0.4999, 1100.0, Plane::strain, Integration::b_bar};

Material full(Material m) {
  m.integration = Integration::full;
  return m;
}

/// n × n squares on the unit square, each but those of `quadrilateral` in two triangles.
mesh::Mesh grid(int n, int quadrilateral = -1) {
  mesh::Mesh m;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      m.coordinates.push_back(
          {1.0 * i / n + 0.1 * std::sin(2.0 * j) / n, 1.0 * j / n + 0.1 * std::cos(3.0 * i) / n});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = c - 1;
      if (j * n + i == quadrilateral)
        m.cells.push_back({a, b, c, d});
      else
        m.cells.insert(m.cells.end(), {{a, b, c, -1}, {a, c, d, -1}});
    }
  return m;
}

Eigen::MatrixXd stiffness(const mesh::Mesh& m, const std::vector<Material>& materials,
                          std::span<const Vec2> prestress = {}) {
  return free_matrix(assemble_stiffness(m, materials, prestress), free_nodes(m));
}

/// Some smooth displacement.
std::vector<Vec2> field(const mesh::Mesh& m) {
  std::vector<Vec2> u;
  for (const Vec2 x : m.coordinates)
    u.push_back({1e-3 * std::sin(2.0 * x.x + x.y), 1e-3 * x.x * x.y * x.y});
  return u;
}

Eigen::VectorXd vector(const std::vector<Vec2>& u) {
  Eigen::VectorXd v(2 * static_cast<Eigen::Index>(u.size()));
  for (std::size_t i = 0; i < u.size(); ++i)
    v.segment<2>(static_cast<Eigen::Index>(2 * i)) = Eigen::Vector2d(u[i].x, u[i].y);
  return v;
}

/// ∫ of a strain of a triangle: (ε_xx, ε_yy, γ_xy) and its area.
struct Strain {
  double xx = 0.0, yy = 0.0, xy = 0.0, area = 0.0;
};

Strain strain_of(const mesh::Mesh& m, const mesh::Cell& cell, const std::vector<Vec2>& u) {
  const auto at = [&](int a) {
    return static_cast<std::size_t>(cell[static_cast<std::size_t>(a)]);
  };
  const Vec2 p = m.coordinates[at(1)] - m.coordinates[at(0)],
             q = m.coordinates[at(2)] - m.coordinates[at(0)];
  const Vec2 du = u[at(1)] - u[at(0)], dv = u[at(2)] - u[at(0)];
  const double j = cross(p, q);
  const double xx = (du.x * q.y - dv.x * p.y) / j, yy = (dv.y * p.x - du.y * q.x) / j;
  const double xy = (dv.x * p.x - du.x * q.x) / j + (du.y * q.y - dv.y * p.y) / j;
  return {xx, yy, xy, 0.5 * j};
}

}  // namespace

/// ½ κ Σ V θ² of the nodes and the deviator of each triangle, written out.
TEST(NodalDilatation, TheEnergyIsThatOfTheMeans) {
  const mesh::Mesh m = grid(4);
  const std::vector<Vec2> u = field(m);
  const ElementLaw law = element_law(rubber);
  std::vector<double> volume(m.n_nodes(), 0.0), area(m.n_nodes(), 0.0);
  double twice = 0.0;
  for (const mesh::Cell& cell : m.cells) {
    const Strain e = strain_of(m, cell, u);
    const Hooke& d = law.point;
    twice += e.area * (d.d11 * (e.xx * e.xx + e.yy * e.yy) + 2.0 * d.d12 * e.xx * e.yy +
                       d.d33 * e.xy * e.xy);
    for (std::size_t a = 0; a < 3; ++a) {
      area[static_cast<std::size_t>(cell[a])] += e.area / 3.0;
      volume[static_cast<std::size_t>(cell[a])] += e.area / 3.0 * (e.xx + e.yy);
    }
  }
  for (std::size_t i = 0; i < m.n_nodes(); ++i)
    twice += law.mean_bulk * volume[i] * volume[i] / area[i];
  const Eigen::VectorXd v = vector(u);
  const Eigen::MatrixXd k = stiffness(m, {rubber});
  EXPECT_EQ(k, k.transpose());
  EXPECT_NEAR(v.dot(k * v), twice, 1e-12 * twice);
  EXPECT_LT(v.dot(k * v), 0.9 * v.dot(stiffness(m, {full(rubber)}) * v));
}

/// The deviator of three dimensions alone has no other free motions: nothing else may be soft.
TEST(NodalDilatation, OnlyRigidMotionsAreFree) {
  for (const int quadrilateral : {-1, 5}) {
    const mesh::Mesh m = grid(4, quadrilateral);
    const Eigen::MatrixXd k = stiffness(m, {rubber});
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(values[i], 0.0, 1e-14 * values.maxCoeff());
    EXPECT_GT(values[3], 0.02 * hooke(rubber).d33);  // of a square of 4 × 4 quadrilaterals: 0.03
  }
}

/// A mean has no more energy than what it is the mean of: the bound by elements holds.
TEST(NodalDilatation, TheElementBoundHolds) {
  const mesh::Mesh m = grid(4);
  const std::vector<Material> soft{rubber}, stiff{full(rubber)};
  const Eigen::MatrixXd difference = stiffness(m, stiff) - stiffness(m, soft);
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(difference).eigenvalues();
  EXPECT_GT(values.minCoeff(), -1e-13 * values.maxCoeff());
  EXPECT_NEAR(element_eigenvalue_bound(m, soft), element_eigenvalue_bound(m, stiff),
              1e-12 * element_eigenvalue_bound(m, stiff));
}

/// Two rubbers, the one ten times as stiff, and an upper half in regions of one rubber.
TEST(NodalDilatation, MaterialsAreNotMixed) {
  mesh::Mesh m = grid(4);
  m.region_names = {"soft", "stiff"};
  for (std::size_t e = 0; e < m.cells.size(); ++e) m.region.push_back(e < 16 ? 0 : 1);
  Material stiff = rubber;
  stiff.youngs_modulus *= 10.0;
  Eigen::MatrixXd k = stiffness(m, {rubber, stiff});
  const double size = k.norm();
  for (int r = 0; r < 2; ++r) {
    mesh::Mesh part = m;
    part.region.clear();
    part.cells.assign(m.cells.begin() + (r == 0 ? 0 : 16), m.cells.begin() + (r == 0 ? 16 : 32));
    k -= stiffness(part, {r == 0 ? rubber : stiff});
  }
  EXPECT_LT(k.norm(), 1e-14 * size);
  Material denser = rubber;
  denser.density *= 2.0;
  const Eigen::MatrixXd one = stiffness(grid(4), {rubber});
  EXPECT_EQ(stiffness(m, {rubber, denser}), one);  // regions of the same elasticity are one
}

TEST(NodalDilatation, NothingElseHasIt) {
  EXPECT_TRUE(NodalDilatation(grid(4), std::vector{full(rubber)}).empty());
  Material thin = rubber;
  thin.plane = Plane::stress;
  EXPECT_TRUE(NodalDilatation(grid(4), std::vector{thin}).empty());
  const NodalDilatation mixed(grid(4, 5), std::vector{rubber});
  EXPECT_FALSE(mixed.holds(10));  // the quadrilateral
  EXPECT_TRUE(mixed.holds(9));
  EXPECT_EQ(stiffness(grid(4), {thin}), stiffness(grid(4), {full(thin)}));
}

/// A stress from the means: what it does on the nodes is the force of the stiffness.
TEST(NodalDilatation, TheStressIsThatOfTheStiffness) {
  const mesh::Mesh m = grid(4, 5);
  const std::vector<Vec2> u = field(m);
  const NodalDilatation dilatation(m, std::vector{rubber});
  const auto displacement = [&](int node) { return u[static_cast<std::size_t>(node)]; };
  // In the way of a field w, ∫ σ : ∇w; of a triangle the mean of its corners is its stress.
  std::vector<Vec2> w;
  for (const Vec2 x : m.coordinates) w.push_back({x.y * x.y, x.x - x.x * x.y});
  mesh::Mesh triangles = m;
  triangles.cells.clear();
  double work = 0.0;
  for (std::size_t e = 0; e < m.cells.size(); ++e) {
    if (m.cells[e][3] >= 0) continue;
    triangles.cells.push_back(m.cells[e]);
    const auto corners = cell_stress(m, e, stress_law(rubber), dilatation, displacement);
    Stress mean{};
    for (std::size_t k = 0; k < 4; ++k)
      mean[k] = (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0;
    const Strain s = strain_of(m, m.cells[e], w);
    work += s.area * (mean[0] * s.xx + mean[1] * s.yy + mean[3] * s.xy);
  }
  const double expected = vector(w).dot(stiffness(triangles, {rubber}) * vector(u));
  EXPECT_NEAR(work, expected, 1e-11 * std::abs(expected));
}

/// Under a uniform pressure in the plane the geometric stiffness is that of full integration.
TEST(NodalDilatation, StressStiffeningTakesTheMeans) {
  const mesh::Mesh m = grid(4, 5);
  std::vector<Vec2> uniform;
  for (const Vec2 x : m.coordinates) uniform.push_back(1e-3 * x);
  const auto geometric = [&](const Material& of, const std::vector<Vec2>& u) {
    return Eigen::MatrixXd(stiffness(m, {of}, u) - stiffness(m, {of}));
  };
  const Eigen::MatrixXd expected = geometric(full(rubber), uniform);
  EXPECT_LT((geometric(rubber, uniform) - expected).norm(), 1e-9 * expected.norm());
  // Another field has another mean.
  const Eigen::MatrixXd other = geometric(full(rubber), field(m));
  EXPECT_GT((geometric(rubber, field(m)) - other).norm(), 0.01 * other.norm());
}

}  // namespace nodal_dilatation_test
