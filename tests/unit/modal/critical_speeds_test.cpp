// SPDX-License-Identifier: BSD-3-Clause
/// Critical speeds against the frequencies of the quadratic problem, spin by spin.
#include "rondo/modal/critical_speeds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bodies.hpp"
#include "rondo/fem/harmonics.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/mesh/solid/wheel.hpp"

namespace critical_speeds_test {

using namespace rondo;
using modal::Wave;

namespace {

/// Lowest frequency of the backward wave with n diameters.
double backward(const modal::CyclicBody<2>& body, double spin, int n) {
  for (const modal::Mode& mode : modal::cyclic_modes(body, spin, 60).modes)
    if (mode.diameters == n && mode.wave == Wave::backward) return mode.omega;
  return std::numeric_limits<double>::quiet_NaN();
}

fem::SectorStiffness scaled(fem::SectorStiffness k, double by) {
  for (auto& entry : k.entries)
    for (double& value : entry.block) value *= by;
  return k;
}

}  // namespace

TEST(CriticalSpeeds, TheBackwardWaveStandsStillThereAndNotBefore) {
  const auto b = test::body_of(test::ring(3, 36));
  const auto speeds = modal::critical_speeds(b.cyclic(), nullptr, 6);
  ASSERT_EQ(speeds.size(), 6U);
  for (const modal::CriticalSpeed& c : speeds) {
    EXPECT_LT(c.residual, 1e-10) << c.diameters;
    const int n = c.diameters;
    // K' stays positive definite up to the critical speed for n > 1 only: checked by the residual.
    const modal::Modes there = modal::cyclic_modes(b.cyclic(), c.spin, 60);
    if (there.unstable > 0) continue;
    EXPECT_NEAR(backward(b.cyclic(), c.spin, n) / (n * c.spin), 1.0, 1e-9) << n;
    for (const double share : {0.2, 0.5, 0.8, 0.95, 0.999})
      EXPECT_GT(backward(b.cyclic(), share * c.spin, n), n * share * c.spin) << n << " " << share;
    EXPECT_LT(backward(b.cyclic(), 1.001 * c.spin, n), n * 1.001 * c.spin) << n;
  }
  EXPECT_EQ(modal::cyclic_modes(b.cyclic(), speeds[2].spin, 1).unstable, 0);  // some were checked
}

TEST(CriticalSpeeds, WithStiffeningThatGrowsWithTheSquareOfTheSpin) {
  const auto b = test::body_of(test::ring(3, 36));
  const double share = 2e-6;  // at 300 rad/s the body is stiffer by 18 %
  const fem::SectorStiffness stiffening = scaled(b.sector, share);
  const auto without = modal::critical_speeds(b.cyclic(), nullptr, 6);
  const auto with = modal::critical_speeds(b.cyclic(), &stiffening, 6);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 2; i < with.size(); ++i) {
    const int n = with[i].diameters;
    EXPECT_GT(with[i].spin, 1.01 * without[i].spin) << n;
    const double s = with[i].spin;
    const auto stiff = scaled(b.sector, 1.0 + share * s * s);
    EXPECT_NEAR(backward({stiff, b.mass, b.mesh.coordinates}, s, n) / (n * s), 1.0, 1e-9) << n;
  }
}

TEST(CriticalSpeeds, TooMuchStiffeningLeavesNone) {
  const auto b = test::body_of(test::ring(2, 12));
  const fem::SectorStiffness stiffening = scaled(b.sector, 1.0);
  EXPECT_TRUE(modal::critical_speeds(b.cyclic(), &stiffening, 4).empty());
}

TEST(CriticalSpeeds, OfAFreeDiskFromTwoDiametersOn) {
  const auto b = test::body_of(test::ring(3, 36, false));
  const auto speeds = modal::critical_speeds(b.cyclic(), nullptr, 3);
  ASSERT_EQ(speeds.size(), 2U);
  EXPECT_EQ(speeds[0].diameters, 2);
}

TEST(CriticalSpeeds, UpToASpinAreThoseThatAreNotAboveIt) {
  const auto b = test::body_of(test::ring(3, 36));
  const auto all = modal::critical_speeds(b.cyclic(), nullptr, 18);
  ASSERT_GT(all.size(), 6U);
  std::vector<double> spins;
  for (const modal::CriticalSpeed& c : all) spins.push_back(c.spin);
  std::ranges::sort(spins);
  EXPECT_TRUE(modal::critical_speeds_up_to(b.cyclic(), 0.999 * spins[0]).empty());
  for (const std::size_t count : {std::size_t{1}, std::size_t{4}}) {
    const double spin = 0.5 * (spins[count - 1] + spins[count]);
    const auto found = modal::critical_speeds_up_to(b.cyclic(), spin);
    ASSERT_EQ(found.size(), count);
    for (const modal::CriticalSpeed& c : found) {
      EXPECT_LT(c.spin, spin);
      const auto same = std::ranges::find(all, c.diameters, &modal::CriticalSpeed::diameters);
      ASSERT_NE(same, all.end());
      EXPECT_NEAR(c.spin, same->spin, 1e-9 * same->spin);
    }
  }
}

/// Two unknowns a sector: a quadratic in 1/s². For n = 1 (8.6)'s right side has rank 1 a node.
TEST(CriticalSpeeds, OfOneLayerAreThoseOfTwoUnknowns) {
  const auto b = test::body_of(test::ring(1, 12));
  fem::Harmonics harmonics(b.sector, b.mass);
  ASSERT_EQ(harmonics.size(), 2);
  const auto found = modal::critical_speeds(b.cyclic(), nullptr, 6);
  ASSERT_EQ(found.size(), 6U);
  for (const modal::CriticalSpeed& c : found) {
    const double n = c.diameters;
    Eigen::Matrix2cd right;
    right << n * n + 1.0, std::complex<double>(0.0, 2.0 * n), std::complex<double>(0.0, -2.0 * n),
        n * n + 1.0;
    const Eigen::MatrixXcd lower = Eigen::MatrixXcd(harmonics.lower(c.diameters, 1.0, 0.0));
    const Eigen::Matrix2cd left = Eigen::MatrixXcd(lower.selfadjointView<Eigen::Lower>());
    const double mu =
        Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2cd>(right, left).eigenvalues()[1];
    EXPECT_NEAR(c.spin * std::sqrt(mu), 1.0, 1e-10) << n;
    EXPECT_LT(c.residual, 1e-10) << n;
  }
}

namespace {

struct SolidWheel {
  mesh::Mesh mesh;
  fem::SolidSector sector;
  std::vector<double> mass;
};

SolidWheel solid_wheel(double poissons_ratio) {
  const fem::Material material{5.0e6, poissons_ratio, 1100.0, fem::Plane::strain};
  SolidWheel w;
  mesh::Wheel wheel;
  wheel.disk = {.outer_radius = 0.3,
                .inner_radius = 0.2,
                .radial = 2,
                .circumferential = 12,
                .grading = 1.0,
                .tread = {}};
  wheel.width = 0.1;
  wheel.axial = 2;
  w.mesh = mesh::make_wheel(wheel);
  w.sector = fem::assemble_solid_sector(w.mesh, {&material, 1});
  w.mass = fem::solid_mass(w.mesh, {&material, 1});
  return w;
}

/// Lowest spin of n = 0 … N/2 at which K(n) - s² Q is singular, by dense matrices.
modal::CriticalSpeed dense_critical_spin(const SolidWheel& w) {
  fem::Harmonics harmonics(w.sector, w.mass);
  modal::CriticalSpeed lowest{-1, std::numeric_limits<double>::infinity(), 0.0};
  for (int n = 0; n < harmonics.count(); ++n) {
    const double waves = n;
    const Eigen::MatrixXcd lower = Eigen::MatrixXcd(harmonics.lower(n, 1.0, 0.0));
    const Eigen::MatrixXcd left = lower.selfadjointView<Eigen::Lower>();
    Eigen::MatrixXcd right = Eigen::MatrixXcd::Zero(left.rows(), left.cols());
    for (Eigen::Index k = 0; k < left.rows(); k += 3) {
      right(k, k) = right(k + 1, k + 1) = waves * waves + 1.0;
      right(k + 2, k + 2) = waves * waves;
      right(k, k + 1) = std::complex<double>(0.0, 2.0 * waves);
      right(k + 1, k) = std::complex<double>(0.0, -2.0 * waves);
    }
    const double mu = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXcd>(right, left)
                          .eigenvalues()
                          .maxCoeff();
    if (1.0 / std::sqrt(mu) < lowest.spin) lowest = {n, 1.0 / std::sqrt(mu), 0.0};
  }
  return lowest;
}

}  // namespace

TEST(SolidCriticalSpin, IsTheLowestOfADenseSolution) {
  const SolidWheel w = solid_wheel(0.45);
  const modal::CriticalSpeed exact = dense_critical_spin(w);
  const modal::CyclicBody<3> body{w.sector, w.mass, w.mesh.coordinates};
  EXPECT_TRUE(modal::critical_speeds_up_to(body, 0.999 * exact.spin).empty());
  for (const double spin : {1.001 * exact.spin, 3.0 * exact.spin}) {
    const auto found = modal::critical_speeds_up_to(body, spin);
    ASSERT_FALSE(found.empty());
    const auto lowest = std::ranges::min_element(found, {}, &modal::CriticalSpeed::spin);
    EXPECT_EQ(lowest->diameters, exact.diameters);
    EXPECT_NEAR(lowest->spin / exact.spin, 1.0, 1e-9);
    EXPECT_LT(lowest->residual, 1e-9);
  }
}

/// Without lateral contraction a wheel can move as the plane body does, and in more ways besides.
TEST(SolidCriticalSpin, IsNotAboveThatOfThePlaneBody) {
  const SolidWheel w = solid_wheel(0.0);
  const fem::SectorStiffness plane = fem::plane_part(w.sector);
  const auto of_plane = modal::critical_speeds<2>({plane, w.mass, w.mesh.coordinates}, nullptr, 6);
  const auto lowest = std::ranges::min_element(of_plane, {}, &modal::CriticalSpeed::spin);
  const auto found = modal::critical_speeds_up_to<3>({w.sector, w.mass, w.mesh.coordinates},
                                                     1.0001 * lowest->spin);
  ASSERT_FALSE(found.empty());
  EXPECT_LE(std::ranges::min_element(found, {}, &modal::CriticalSpeed::spin)->spin,
            1.0001 * lowest->spin);
}

}  // namespace critical_speeds_test
