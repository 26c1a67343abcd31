// SPDX-License-Identifier: BSD-3-Clause
/// Rigid-body motions: exactly counted, at rest and of a spinning disk.
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>

#include "bodies.hpp"
#include "rondo/modal/residual.hpp"

namespace free_bodies_test {

using namespace rondo;
using modal::Wave;

namespace {

int count_rigid(const modal::Modes& found) {
  int rigid = 0;
  for (const modal::Mode& mode : found.modes) rigid += mode.wave == Wave::rigid ? 1 : 0;
  return rigid;
}

}  // namespace

TEST(FreeBodies, AFreeDiskAtRestHasThreeRigidMotions) {
  const auto b = test::body_of(test::ring(4, 30, false));
  const modal::Modes cyclic = modal::cyclic_modes(b.cyclic(), 0.0, 10);
  const modal::Modes mesh = modal::mesh_modes(b.any(), 0.0, 10);
  for (const modal::Modes& found : {cyclic, mesh}) {
    EXPECT_EQ(count_rigid(found), 3);
    EXPECT_TRUE(found.counted);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(found.modes[i].wave, Wave::rigid);
      EXPECT_EQ(found.modes[i].omega, 0.0);
      EXPECT_LT(modal::residual(b.cyclic(), 0.0, found.modes[i]), 1e-14);
    }
    EXPECT_GT(found.modes[3].omega, 10.0);
  }
  const std::vector<double> a = test::frequencies(cyclic), c = test::frequencies(mesh);
  ASSERT_EQ(a.size(), c.size());
  for (std::size_t i = 3; i < a.size(); ++i) {
    EXPECT_NEAR(a[i] / c[i], 1.0, 1e-9) << i;
    EXPECT_LT(modal::residual(b.any(), 0.0, cyclic.modes[i]), 1e-9) << i;
    EXPECT_LT(modal::residual(b.any(), 0.0, mesh.modes[i]), 1e-9) << i;
  }
}

/// A shift of the size of the core's frequencies took 384 vectors.
TEST(FreeBodies, AStiffCoreNeedsNoLargeSpace) {
  test::ModalBody b;
  b.mesh = test::ring(6, 40, false);
  b.mesh.region_names = {"core", "rubber"};
  for (std::size_t e = 0; e < b.mesh.cells.size(); ++e) b.mesh.region.push_back(e % 6 < 3 ? 0 : 1);
  const std::array materials{fem::Material{2.0e11, 0.3, 7800.0}, test::rubber};
  b.stiffness = fem::assemble_stiffness(b.mesh, materials);
  b.mass = fem::lumped_mass(b.mesh, materials);
  const modal::Modes found = modal::mesh_modes(b.any(), 0.0, 20);
  EXPECT_EQ(count_rigid(found), 3);
  EXPECT_TRUE(found.counted);
  EXPECT_LT(found.dimension, 150);
  const Eigen::VectorXd squares =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(test::dense(b, 0.0)).eigenvalues();
  for (std::size_t i = 3; i < found.modes.size(); ++i) {
    EXPECT_NEAR(found.modes[i].omega / std::sqrt(squares[static_cast<Eigen::Index>(i)]), 1.0, 1e-8)
        << i;
    EXPECT_LT(modal::residual(b.any(), 0.0, found.modes[i]), 1e-9) << i;
  }
}

TEST(FreeBodies, TwoEqualFreeBodiesAndAClampedOne) {
  const mesh::Mesh free = test::ring(2, 12, false);
  const auto b = test::body_of(
      test::beside(test::beside(free, free, {1.0, 0.0}), test::ring(2, 12), {0.0, 1.0}));
  const modal::Modes found = modal::mesh_modes(b.any(), 0.0, 24);
  EXPECT_EQ(modal::free_bodies(b.mesh), (std::vector<int>{0, 1}));
  EXPECT_EQ(count_rigid(found), 6);
  EXPECT_TRUE(found.counted);
  const Eigen::VectorXd squares =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(test::dense(b, 0.0)).eigenvalues();
  ASSERT_GE(found.modes.size(), 30U);
  for (std::size_t i = 6; i < found.modes.size(); ++i)  // most of them four times
    EXPECT_NEAR(found.modes[i].omega / std::sqrt(squares[static_cast<Eigen::Index>(i)]), 1.0, 1e-9)
        << i;
}

TEST(FreeBodies, ASpinningFreeDiskIsThatOfADenseSolution) {
  const auto b = test::body_of(test::ring(2, 12, false));
  const double spin = 40.0;
  const modal::Modes found = modal::cyclic_modes(b.cyclic(), spin, 14);
  EXPECT_EQ(count_rigid(found), 3);
  EXPECT_TRUE(found.counted);
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(std::isnan(
        modal::damping_ratio(b.mass, spin, found.modes[static_cast<std::size_t>(i)], {20.0, 0.0})))
        << i;
  // The rotation is not held back without stiffening, and the translations are a double root.
  EXPECT_GT(found.modes[0].growth, 0.9 * spin);
  // Round-off of a dense solution without symmetry: ε (ω_max/s)², 1e-11, times some tens.
  EXPECT_LT(modal::residual(b.cyclic(), spin, found.modes[0]), 1e-8);
  std::vector<double> expected;
  int translations = 0;
  for (const double omega : test::dense_frequencies(b, spin)) {
    // Dense, a double root with one vector is off by the root of the round-off: 1e-8 of the
    // largest frequency.
    if (std::abs(omega - spin) < 1e-4 * spin)
      ++translations;
    else if (omega > 1.0)
      expected.push_back(omega);
  }
  EXPECT_EQ(translations, 2);
  for (std::size_t i = 3; i < found.modes.size(); ++i) {
    EXPECT_NEAR(found.modes[i].omega / expected[i - 3], 1.0, 1e-9) << i;
    EXPECT_LT(modal::residual(b.cyclic(), spin, found.modes[i]), 1e-9) << i;
  }
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(found.modes[i].omega, spin);
    EXPECT_LT(modal::residual(b.cyclic(), spin, found.modes[i]), 1e-10);
  }
}

}  // namespace free_bodies_test
