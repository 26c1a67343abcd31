// SPDX-License-Identifier: BSD-3-Clause
/// Quadrilaterals whose volumetric strain is the mean of the element.
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/element.hpp"

namespace b_bar_test {

using namespace rondo;
using namespace rondo::fem;

namespace {

const Material rubber{5.0e6, 0.4999, 1100.0, Plane::strain, Integration::b_bar};
const std::vector<Vec2> square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
const std::vector<Vec2> quad{{0.1, 0.0}, {1.3, -0.2}, {1.1, 0.9}, {-0.1, 0.7}};
const std::vector<Vec2> triangle{{0.1, 0.0}, {1.3, -0.2}, {0.4, 0.9}};

Material full(Material m) {
  m.integration = Integration::full;
  return m;
}

Eigen::VectorXd eigenvalues(const ElementMatrix& k) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(k)};
  return solver.eigenvalues();
}

}  // namespace

/// A rule of one point for everything would have two more.
TEST(BBar, OnlyRigidMotionsAreFree) {
  for (const auto& x : {square, quad}) {
    const ElementMatrix k = element_stiffness(x, element_law(rubber));
    EXPECT_LT((k - k.transpose()).norm(), 1e-15 * k.norm());
    const Eigen::VectorXd values = eigenvalues(k);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(values[i], 0.0, 1e-14 * k.norm());
    // Shear modulus over bulk modulus is 2e-4.
    EXPECT_GT(values[3], 0.1 * hooke(rubber).d33);
  }
}

/// Of what four corners can do, full integration makes three ways stiff with the bulk modulus: the
/// volume and its gradient in x and y. Only the volume should be.
TEST(BBar, OneWayIsIncompressible) {
  for (const auto& x : {square, quad}) {
    const double stiff = 30.0 * hooke(rubber).d33;
    const auto count = [&](const Material& m) {
      return (eigenvalues(element_stiffness(x, element_law(m))).array() > stiff).count();
    };
    EXPECT_EQ(count(rubber), 1);
    EXPECT_EQ(count(full(rubber)), 3);
  }
}

/// u = (xy, 0) on |x|, |y| <= 1: ε_xx = y, whose mean is none, and γ_xy = x. The deviator is left.
TEST(BBar, BendingHasNoPressure) {
  const double shear = hooke(rubber).d33;
  std::vector<Vec2> u;
  Eigen::VectorXd v(8);
  for (std::size_t a = 0; a < 4; ++a) {
    u.push_back({square[a].x * square[a].y, 0.0});
    v.segment<2>(static_cast<Eigen::Index>(2 * a)) = Eigen::Vector2d(u[a].x, 0.0);
  }
  const double energy = v.dot(element_stiffness(square, element_law(rubber)) * v);
  const double expected = 4.0 / 3.0 * (4.0 / 3.0 + 1.0) * shear;  // ∫ 4/3 μ y² + μ x²
  EXPECT_NEAR(energy, expected, 1e-15 * hooke(rubber).d11);       // the size of the entries
  const auto s = element_stress(square, u, element_law(rubber));
  for (std::size_t a = 0; a < 4; ++a) {
    EXPECT_NEAR(s[a][0], 4.0 / 3.0 * shear * square[a].y, 1e-12 * shear);
    EXPECT_NEAR(s[a][1], -2.0 / 3.0 * shear * square[a].y, 1e-12 * shear);
    EXPECT_NEAR(s[a][2], -2.0 / 3.0 * shear * square[a].y, 1e-12 * shear);
    EXPECT_NEAR(s[a][3], shear * square[a].x, 1e-12 * shear);
  }
}

TEST(BBar, StressOfALinearFieldIsExact) {
  const Hooke d = hooke(rubber);
  for (const auto& x : {quad, triangle}) {
    std::vector<Vec2> u;
    for (const Vec2 p : x) u.push_back({1e-3 * p.x + 2e-3 * p.y, -3e-3 * p.x + 4e-3 * p.y});
    const auto s = element_stress(x, u, element_law(rubber));
    for (std::size_t a = 0; a < x.size(); ++a) {
      EXPECT_NEAR(s[a][0], d.d11 * 1e-3 + d.d12 * 4e-3, 1e-16 * d.d11);
      EXPECT_NEAR(s[a][1], d.d12 * 1e-3 + d.d11 * 4e-3, 1e-16 * d.d11);
      EXPECT_NEAR(s[a][2], 0.4999 * (s[a][0] + s[a][1]), 1e-16 * d.d11);
      EXPECT_NEAR(s[a][3], d.d33 * -1e-3, 1e-16 * d.d11);
    }
  }
}

/// A triangle by itself has no mean but its own: what is better than that is NodalDilatation.
TEST(BBar, IsFullIntegrationOnOneTriangleAndInPlaneStress) {
  const ElementMatrix k = element_stiffness(triangle, element_law(rubber));
  EXPECT_LT((k - element_stiffness(triangle, element_law(full(rubber)))).norm(), 1e-15 * k.norm());
  Material thin = rubber;
  thin.plane = Plane::stress;
  EXPECT_EQ(element_stiffness(quad, element_law(thin)),
            element_stiffness(quad, element_law(full(thin))));
  EXPECT_NE(element_stiffness(quad, element_law(rubber)),
            element_stiffness(quad, element_law(full(rubber))));
}

}  // namespace b_bar_test
