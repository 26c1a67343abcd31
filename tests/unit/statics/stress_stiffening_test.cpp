// SPDX-License-Identifier: BSD-3-Clause
/// Geometric stiffness by the stress of the spin: frequencies in the turning frame; the
/// displacement that it comes from, by both forms of the stiffness.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "rondo/fem/harmonics.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "support/rings.hpp"

namespace stress_stiffening_test {

using namespace rondo;

namespace {

const fem::Material rubber{5.0e6, 0.45, 1100.0, fem::Plane::strain};
constexpr double spin = -50.0;

mesh::Mesh annulus(int radial, int circumferential) {
  mesh::Disk disk;
  disk.outer_radius = 0.3;
  disk.inner_radius = 0.2;
  disk.radial = radial;
  disk.circumferential = circumferential;
  return mesh::make_disk(disk);
}

/// In the turning frame [rad/s].
struct Waves {
  double backward, forward;
};

/// Lowest of M ü + 2sMJ u̇ + (K - s²M) u = 0 in one harmonic.
Waves lowest(fem::Harmonics& harmonics, int harmonic) {
  const Eigen::MatrixXcd lower = harmonics.lower(harmonic, 1.0, -spin * spin);
  const Eigen::Index n = lower.rows();
  Eigen::MatrixXcd a = Eigen::MatrixXcd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -Eigen::MatrixXcd(lower.selfadjointView<Eigen::Lower>());
  for (Eigen::Index i = 0; i < n; i += 2) {
    a(n + i, n + i + 1) = 2.0 * spin;  // -2sJ
    a(n + i + 1, n + i) = -2.0 * spin;
  }
  Waves w{1e300, 1e300};
  const Eigen::VectorXcd lambdas = a.eigenvalues();
  for (const std::complex<double> lambda : lambdas) {
    double& found = lambda.imag() > 0.0 ? w.backward : w.forward;
    found = std::min(found, std::abs(lambda.imag()));
  }
  if (w.backward < w.forward) std::swap(w.backward, w.forward);
  return w;
}

/// Of one mesh: n = 0 … 3.
std::array<Waves, 4> frequencies(int radial, bool stiffened) {
  const mesh::Mesh m = annulus(radial, 15 * radial);
  const std::vector<double> mass = fem::lumped_mass(m, {&rubber, 1});
  fem::SectorStiffness k = fem::assemble_sector(m, {&rubber, 1});
  if (stiffened) {
    const auto prestress = statics::centrifugal_prestress(k, mass, m.coordinates, spin);
    EXPECT_EQ(prestress.status, statics::SpinStatus::solved);
    k = fem::assemble_sector(m, {&rubber, 1}, prestress.u);
  }
  fem::Harmonics harmonics(k, mass);
  std::array<Waves, 4> waves;
  for (int n = 0; n < 4; ++n) waves[static_cast<std::size_t>(n)] = lowest(harmonics, n);
  return waves;
}

/// The error is second order in the size of the elements; what is left of it after extrapolation
/// from 16 and 32 layers was at most 1.3e-6 (n = 3), beside the digits given.
void expect_frequencies(bool stiffened, const std::array<Waves, 4>& expected) {
  const auto coarse = frequencies(16, stiffened), fine = frequencies(32, stiffened);
  for (std::size_t n = 0; n < 4; ++n) {
    const auto limit = [&](double Waves::*wave) {
      return (4.0 * fine[n].*wave - coarse[n].*wave) / 3.0;
    };
    EXPECT_NEAR(limit(&Waves::backward), expected[n].backward, 2e-3) << n;
    EXPECT_NEAR(limit(&Waves::forward), expected[n].forward, 2e-3) << n;
  }
}

}  // namespace

/// Of the linear elastic annulus by a solution in r for each n, to the digits given.
TEST(StressStiffening, FrequenciesWithout) {
  expect_frequencies(
      false, {{{475.447, 475.447}, {550.560, 523.625}, {706.775, 653.541}, {879.893, 803.108}}});
}

/// The stress of the spin without softening; with softening n = 0 would have 485.4045.
TEST(StressStiffening, FrequenciesWith) {
  expect_frequencies(
      true, {{{485.400, 485.400}, {559.592, 532.692}, {714.488, 661.333}, {887.129, 810.455}}});
}

TEST(StressStiffening, PrestressOfASectorIsThatOfTheAssembledStiffness) {
  for (const mesh::Disk& disk : test::cyclic_disks()) {
    const mesh::Mesh m = mesh::make_disk(disk);
    const std::vector<double> mass = fem::lumped_mass(m, {&rubber, 1});
    const std::vector<int> free = fem::free_nodes(m);
    const fem::BlockCsr k = fem::assemble_stiffness(m, {&rubber, 1});
    const fem::SectorStiffness sector = fem::assemble_sector(m, {&rubber, 1});
    const auto expected = statics::centrifugal_prestress(k, mass, m.coordinates, free, spin);
    const auto found = statics::centrifugal_prestress(sector, mass, m.coordinates, spin);
    const auto twice = statics::centrifugal_prestress(sector, mass, m.coordinates, 2.0 * spin);
    ASSERT_EQ(expected.status, statics::SpinStatus::solved);
    ASSERT_EQ(found.status, statics::SpinStatus::solved);
    EXPECT_LT(expected.residual, 1e-12);
    EXPECT_LT(found.residual, 1e-12);
    double largest = 0.0, error = 0.0, off = 0.0;
    for (std::size_t i = 0; i < found.u.size(); ++i) {
      largest = std::max(largest, norm(expected.u.plane()[i]));
      error = std::max(error, norm(found.u.plane()[i] - expected.u.plane()[i]));
      off = std::max(off, norm(twice.u.plane()[i] - 4.0 * found.u.plane()[i]));
    }
    EXPECT_GT(largest, 1e-5);
    EXPECT_LT(error, 1e-12 * largest);
    EXPECT_LT(off, 1e-12 * largest);  // no softening: as the square of the spin
  }
}

}  // namespace stress_stiffening_test
