// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/solid/hexahedron.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace hexahedron_test {

using namespace rondo;
using fem::HexahedronCorners;
using fem::Material;

namespace {

const Material full{2.0e7, 0.3, 1100.0};
const Material b_bar{2.0e7, 0.3, 1100.0, fem::Plane::strain, fem::Integration::b_bar};

/// A brick with its corners moved about by up to a sixth of its edges.
HexahedronCorners distorted(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.16, 0.16);
  HexahedronCorners x{{{0, 0, 0},
                       {1, 0, 0},
                       {1, 1, 0},
                       {0, 1, 0},  //
                       {0, 0, 1},
                       {1, 0, 1},
                       {1, 1, 1},
                       {0, 1, 1}}};
  for (Vec3& corner : x)
    corner = Vec3{0.02 * (corner.x + shift(random)), 0.03 * (corner.y + shift(random)),
                  0.01 * (corner.z + shift(random))};
  return x;
}

Eigen::Matrix<double, 24, 1> numbers(const HexahedronCorners& u) {
  Eigen::Matrix<double, 24, 1> v;
  for (std::size_t i = 0; i < 8; ++i)
    v.segment<3>(static_cast<Eigen::Index>(3 * i)) << u[i].x, u[i].y, u[i].z;
  return v;
}

/// u = G x.
HexahedronCorners affine(const HexahedronCorners& x, const Eigen::Matrix3d& g) {
  HexahedronCorners u;
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector3d v = g * Eigen::Vector3d(x[i].x, x[i].y, x[i].z);
    u[i] = {v[0], v[1], v[2]};
  }
  return u;
}

fem::SolidStress hooke_stress(const Material& m, const Eigen::Matrix3d& g) {
  const double shear = m.youngs_modulus / (2 * (1 + m.poissons_ratio));
  const double lame = 2 * shear * m.poissons_ratio / (1 - 2 * m.poissons_ratio);
  const Eigen::Matrix3d s =
      lame * g.trace() * Eigen::Matrix3d::Identity() + shear * (g + g.transpose());
  return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)};
}

const Eigen::Matrix3d gradient =
    (Eigen::Matrix3d() << 1.2e-3, -0.7e-3, 0.4e-3, 0.9e-3, -0.3e-3, 1.1e-3, -0.6e-3, 0.2e-3, 0.8e-3)
        .finished();

}  // namespace

TEST(Hexahedron, StressOfALinearDisplacementIsExact) {
  for (const Material& m : {full, b_bar})
    for (unsigned seed = 1; seed < 6; ++seed) {
      const HexahedronCorners x = distorted(seed);
      const fem::SolidStress expected = hooke_stress(m, gradient);
      for (const auto& stress : fem::hexahedron_stress(x, affine(x, gradient), m))
        for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(stress[c], expected[c], 1e-9 * 2.0e4) << c;
    }
}

/// Virtual work: u·K v = V σ(u):ε(v) for linear displacements, and no force on rigid ones.
TEST(Hexahedron, EnergyOfLinearDisplacementsIsThatOfTheVolume) {
  for (const Material& m : {full, b_bar})
    for (unsigned seed = 1; seed < 6; ++seed) {
      const HexahedronCorners x = distorted(seed);
      const auto k = fem::hexahedron_stiffness(x, m);
      double volume = 0.0;
      for (const double v : fem::hexahedron_volumes(x)) volume += v;
      const fem::SolidStress s = hooke_stress(m, gradient);
      const double density = s[0] * gradient(0, 0) + s[1] * gradient(1, 1) + s[2] * gradient(2, 2) +
                             s[3] * (gradient(0, 1) + gradient(1, 0)) +
                             s[4] * (gradient(1, 2) + gradient(2, 1)) +
                             s[5] * (gradient(2, 0) + gradient(0, 2));
      const auto u = numbers(affine(x, gradient));
      EXPECT_NEAR(u.dot(k * u), volume * density, 1e-12 * volume * density);
      Eigen::Matrix3d spin;
      spin << 0, -3, 2, 3, 0, -1, -2, 1, 0;
      HexahedronCorners rigid = affine(x, spin);
      for (Vec3& v : rigid) v += Vec3{0.2, -0.5, 0.3};
      const double force = (k * numbers(rigid)).norm();
      EXPECT_LT(force, 1e-13 * k.norm() * numbers(rigid).norm());
    }
}

/// Six rigid motions and no more: neither quadrature lets an hourglass through.
TEST(Hexahedron, HasSixZeroEigenvalues) {
  for (const Material& m : {full, b_bar}) {
    const auto k = fem::hexahedron_stiffness(distorted(3), m);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(k);
    EXPECT_LT(solver.eigenvalues().head<6>().cwiseAbs().maxCoeff(),
              1e-12 * solver.eigenvalues()[23]);
    EXPECT_GT(solver.eigenvalues()[6], 1e-4 * solver.eigenvalues()[23]);
    EXPECT_EQ(k, k.transpose());
  }
}

TEST(Hexahedron, VolumesOfABrickAreEighths) {
  HexahedronCorners x{{{0, 0, 0},
                       {2, 0, 0},
                       {2, 3, 0},
                       {0, 3, 0},  //
                       {0, 0, 5},
                       {2, 0, 5},
                       {2, 3, 5},
                       {0, 3, 5}}};
  for (const double v : fem::hexahedron_volumes(x)) EXPECT_NEAR(v, 30.0 / 8.0, 1e-14);
}

/// A bar wave through a brick: with its nodes at the corners the largest is that of the
/// plane code's square, ω² <= 4 c²/h² in each direction.
TEST(Hexahedron, EigenvalueBoundFollowsTheSmallestEdge) {
  HexahedronCorners x{{{0, 0, 0},
                       {1, 0, 0},
                       {1, 1, 0},
                       {0, 1, 0},  //
                       {0, 0, .01},
                       {1, 0, .01},
                       {1, 1, .01},
                       {0, 1, .01}}};
  const double c2 = 2.0e7 * 0.7 / (1.3 * 0.4) / 1100.0;
  EXPECT_NEAR(fem::hexahedron_eigenvalue_bound(x, full), 4.0 * c2 / 1e-4, 1e-3 * 4.0 * c2 / 1e-4);
}

}  // namespace hexahedron_test
