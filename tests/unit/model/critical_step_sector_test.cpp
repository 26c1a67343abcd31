// SPDX-License-Identifier: BSD-3-Clause
/// The critical step by harmonics, against dense eigenvalues and the Lanczos of the assembled K.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/fem/assembly.hpp"
#include "rondo/model/stability/critical_step.hpp"
#include "support/rings.hpp"

namespace critical_step_sector_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

const fem::Material material{2.0e7, 0.3, 1100.0, fem::Plane::strain};

CriticalStep by_harmonics(const mesh::Mesh& mesh, LaggedDamping damping = {}) {
  return critical_step(fem::assemble_sector(mesh, {&material, 1}),
                       fem::lumped_mass(mesh, {&material, 1}), damping,
                       fem::sector_eigenvalue_bound(mesh, {&material, 1}));
}

CriticalStep assembled(const mesh::Mesh& mesh) {
  return critical_step(fem::assemble_stiffness(mesh, {&material, 1}),
                       fem::lumped_mass(mesh, {&material, 1}), fem::free_nodes(mesh), {},
                       fem::element_eigenvalue_bound(mesh, {&material, 1}));
}

double dense_omega(const mesh::Mesh& mesh) {
  const std::vector<int> free = fem::free_nodes(mesh);
  const std::vector<double> mass = fem::lumped_mass(mesh, {&material, 1});
  Eigen::MatrixXd a = fem::free_matrix(fem::assemble_stiffness(mesh, {&material, 1}), free);
  const auto m = [&](Eigen::Index i) {
    return mass[static_cast<std::size_t>(free[static_cast<std::size_t>(i / 2)])];
  };
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) a(i, j) /= std::sqrt(m(i) * m(j));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> dense(a, Eigen::EigenvaluesOnly);
  return std::sqrt(dense.eigenvalues().maxCoeff());
}

}  // namespace

TEST(CriticalStepBySectors, EnclosesTheLargestFrequencyFromAbove) {
  for (const mesh::Disk& disk : test::cyclic_disks()) {
    const mesh::Mesh mesh = mesh::make_disk(disk);
    const double omega = dense_omega(mesh);
    const CriticalStep found = by_harmonics(mesh);
    EXPECT_TRUE(found.converged);
    EXPECT_TRUE(found.proven);
    EXPECT_GE(found.omega, omega * (1.0 - 1e-14));
    EXPECT_LT(found.omega, omega * (1.0 + 6e-7));  // half of the width
    EXPECT_LE(found.uncertainty, 1e-6);
    EXPECT_GT(found.element_bound, found.omega);
    EXPECT_EQ(found.step, critical_step_of(found.omega, {}));
  }
}

/// The largest eigenvalue in one harmonic after another: none is left out.
TEST(CriticalStepBySectors, FindsItInAnyHarmonic) {
  for (const int n : {3, 4, 39, 40, 41})
    for (int p = 0; p <= n / 2; ++p) {
      const CriticalStep found = critical_step(
          test::ring(n, p), std::vector<double>(static_cast<std::size_t>(n), 1.0), {}, 2e7);
      EXPECT_GE(found.omega * found.omega, 7e6) << n << " " << p;
      EXPECT_LT(found.omega * found.omega, 7e6 * (1.0 + 1.1e-6)) << n << " " << p;
      EXPECT_TRUE(found.proven);
    }
}

/// Lanczos stops up to half of 1e-3 above. A bound known beforehand that is exact is the answer.
TEST(CriticalStepBySectors, AgreesWithTheAssembledStiffness) {
  mesh::Disk smooth, graded, treaded;
  smooth.radial = 26, smooth.circumferential = 390;
  graded.radial = 12, graded.circumferential = 181, graded.grading = 1.5;
  treaded.tread = mesh::Tread{};
  for (const mesh::Disk& disk : {smooth, graded, treaded}) {
    const mesh::Mesh mesh = mesh::make_disk(disk);
    const CriticalStep found = by_harmonics(mesh), expected = assembled(mesh);
    EXPECT_LT(found.omega, expected.omega);
    EXPECT_GT(found.omega, expected.omega * (1.0 - 5e-4));
  }
  const CriticalStep at_bound =
      critical_step(test::ring(12, 2), std::vector<double>(12, 1.0), {}, 7e6);
  EXPECT_EQ(at_bound.omega, std::sqrt(7e6));
  EXPECT_TRUE(at_bound.proven);
}

/// One mesh as 300 sectors, as 60 and as 3: these are too large for the proof, and get Lanczos.
TEST(CriticalStepBySectors, DoesNotHangOnWhatIsCalledASector) {
  mesh::Disk disk;
  disk.radial = 20, disk.circumferential = 300;
  const mesh::Mesh mesh = mesh::make_disk(disk);
  const CriticalStep narrow = by_harmonics(mesh),
                     wider = by_harmonics(test::with_wider_sectors(mesh, 5)),
                     large = by_harmonics(test::with_wider_sectors(mesh, 100));
  EXPECT_TRUE(narrow.proven);
  EXPECT_TRUE(wider.proven);
  EXPECT_NEAR(wider.omega, narrow.omega, 1e-6 * narrow.omega);
  EXPECT_TRUE(large.converged);
  EXPECT_FALSE(large.proven);
  EXPECT_LE(large.uncertainty, 1e-3);
  EXPECT_GT(large.omega, narrow.omega * (1.0 - 1e-6));
  EXPECT_LT(large.omega, narrow.omega * (1.0 + 5e-4));
}

TEST(CriticalStepBySectors, LargeSectorsHaveNoHarmonicLeftOutEither) {
  for (int p = 0; p <= 20; p += 4) {
    const fem::SectorStiffness ring = test::wide_ring(40, p, 150);
    const CriticalStep found = critical_step(ring, std::vector<double>(40 * 151, 1.0), {}, 2e7);
    EXPECT_TRUE(found.converged);
    EXPECT_FALSE(found.proven);
    EXPECT_NEAR(found.omega * found.omega, 7e6, 7e3) << p;
  }
}

/// √2 ε m^2.5 by hand: m = 10,000 gives 1.4142·2.2204e-16·1e10.
TEST(CriticalStepBySectors, TheMarginForRoundingGrowsWithTheFactor) {
  EXPECT_EQ(cholesky_rounding(1), 1e-8);
  EXPECT_EQ(cholesky_rounding(900), 1e-8);
  EXPECT_GT(cholesky_rounding(1100), 1e-8);
  EXPECT_NEAR(cholesky_rounding(10000), 3.1402e-6, 1e-10);  // five digits by hand
}

TEST(CriticalStepBySectors, DampingShortensTheStepAsEver) {
  mesh::Disk disk;
  disk.radial = 4, disk.circumferential = 30;
  const LaggedDamping damping{2e-5, 150.0};
  const CriticalStep found = by_harmonics(mesh::make_disk(disk), damping);
  EXPECT_EQ(found.step, critical_step_of(found.omega, damping));
}

TEST(CriticalStepBySectors, NumbersOutOfRangeGiveTheElementBound) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [mass, bound] : {std::pair(1.0, infinity), std::pair(0.0, 2e7)}) {
    const CriticalStep found =
        critical_step(test::ring(5, 1), std::vector<double>(5, mass), {}, bound);
    EXPECT_FALSE(found.converged);
    EXPECT_FALSE(found.proven);
    EXPECT_EQ(found.omega, std::sqrt(bound));
  }
}

}  // namespace critical_step_sector_test
