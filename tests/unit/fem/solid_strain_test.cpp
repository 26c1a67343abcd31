// SPDX-License-Identifier: BSD-3-Clause
/// Strain and volume of hexahedra, against linear fields whose gradient is known.
#include "rondo/fem/solid/solid_strain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "rondo/mesh/solid/wheel.hpp"

namespace rondo::fem::solid_strain_test {
namespace {

mesh::Mesh wheel() {
  mesh::Wheel w;
  w.disk.outer_radius = 0.3;
  w.disk.inner_radius = 0.15;
  w.disk.radial = 2;
  w.disk.circumferential = 7;
  w.width = 0.1;
  w.axial = 3;
  w.crown_radius = 0.1;
  return mesh::make_wheel(w);
}

using Vectors = std::vector<Vec3>;

Vectors linear(const mesh::Mesh& m, const Eigen::Matrix3d& gradient) {
  Vectors f;
  for (std::size_t i = 0; i < m.n_nodes(); ++i) {
    const Eigen::Vector3d u =
        gradient * Eigen::Vector3d(m.coordinates[i].x, m.coordinates[i].y, m.axial[i]);
    f.push_back({u[0], u[1], u[2]});
  }
  return f;
}

double largest_principal(const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(strain).eigenvalues().cwiseAbs().maxCoeff();
}

TEST(SolidStrain, OfLinearFields) {
  const mesh::Mesh m = wheel();
  Eigen::Matrix3d general, stretch = Eigen::Matrix3d::Zero();
  general << 0.04, 0.05, -0.02, -0.01, -0.06, 0.03, 0.07, 0.01, 0.02;
  stretch(2, 2) = -0.03;
  for (const Eigen::Matrix3d& gradient :
       {general, stretch, Eigen::Matrix3d(0.02 * Eigen::Matrix3d::Identity()),
        Eigen::Matrix3d(-general)}) {
    const Vectors f = linear(m, gradient);
    const Deformation d = solid_deformation(m, f);
    EXPECT_NEAR(d.strain, largest_principal(gradient), 1e-13);
    EXPECT_EQ(d.linear_strain, d.strain);
    EXPECT_NEAR(d.jacobian, (Eigen::Matrix3d::Identity() + gradient).determinant(), 1e-13);
  }
}

TEST(SolidStrain, AtRestThereIsNone) {
  const mesh::Mesh m = wheel();
  const Vectors f = linear(m, Eigen::Matrix3d::Zero());
  EXPECT_EQ(solid_deformation(m, f).strain, 0.0);
  EXPECT_EQ(solid_deformation(m, f).jacobian, 1.0);
}

TEST(SolidStrain, NamesTheHexahedronThatIsInverted) {
  const mesh::Mesh m = wheel();
  Vectors f = linear(m, Eigen::Matrix3d::Zero());
  const std::size_t e = m.hexahedra.size() - 1;
  const auto node = static_cast<std::size_t>(m.hexahedra[e][6]);
  f[node].z = m.axial[node] > 0.0 ? -1.0 : 1.0;  // through the others
  const Deformation d = solid_deformation(m, f);
  EXPECT_LT(d.jacobian, 0.0);
  const auto& corners = m.hexahedra[d.jacobian_cell];
  EXPECT_NE(std::find(corners.begin(), corners.end(), static_cast<int>(node)), corners.end());
}

}  // namespace
}  // namespace rondo::fem::solid_strain_test
