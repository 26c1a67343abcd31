// SPDX-License-Identifier: BSD-3-Clause
/// Modes by harmonics and by sparse factors against dense solutions and each other.
#include "rondo/modal/modes.hpp"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bodies.hpp"
#include "rondo/modal/harmonic_problem.hpp"
#include "rondo/modal/residual.hpp"

namespace modes_test {

using namespace rondo;
using modal::Wave;

namespace {

/// Of frequencies by different ways: that of the dense solution without symmetry, whose round-off
/// is some ε of the largest frequency squared over that of the lowest.
constexpr double dense_error = 1e-9;
/// ‖K u‖ cancels by the square of the largest frequency over the mode's: 1e4 on these meshes.
constexpr double residual_bound = 1e-10;

void expect_equal(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_LE(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i] / expected[i], 1.0, dense_error) << i;
}

double product(const test::ModalBody& b, const modal::Mode& p, const modal::Mode& q) {
  double sum = 0.0;
  for (std::size_t i = 0; i < b.mass.size(); ++i)
    sum += b.mass[i] * dot(p.real.plane()[i], q.real.plane()[i]);
  return sum;
}

}  // namespace

TEST(Modes, AllAreThoseOfADenseSolution) {
  // Odd columns, and even ones, which have a harmonic N/2; one layer: two unknowns a sector.
  for (const auto& [layers, columns] :
       {std::pair{2, 9}, std::pair{2, 8}, std::pair{1, 9}, std::pair{1, 8}, std::pair{1, 3}}) {
    const auto b = test::body_of(test::ring(layers, columns));
    const int all = static_cast<int>(2 * fem::free_nodes(b.mesh).size());
    for (const double spin : {0.0, 60.0, -60.0}) {
      const std::vector<double> expected = test::dense_frequencies(b, spin);
      ASSERT_EQ(expected.size(), static_cast<std::size_t>(all));
      for (const modal::Modes& found :
           {modal::cyclic_modes(b.cyclic(), spin, all), modal::mesh_modes(b.any(), spin, all)}) {
        EXPECT_EQ(found.modes.size(), static_cast<std::size_t>(all)) << columns << " " << spin;
        EXPECT_TRUE(found.counted);
        expect_equal(test::frequencies(found), expected);
      }
    }
  }
}

TEST(Modes, LowestOfBothWaysAreTheSame) {
  const auto b = test::body_of(test::ring(6, 90));
  for (const double spin : {0.0, 60.0}) {
    const modal::Modes cyclic = modal::cyclic_modes(b.cyclic(), spin, 25);
    const modal::Modes mesh = modal::mesh_modes(b.any(), spin, 25);
    EXPECT_TRUE(cyclic.counted);
    EXPECT_TRUE(mesh.counted);
    EXPECT_GE(cyclic.modes.size(), 25U);
    EXPECT_LE(cyclic.modes.size(), 26U);  // a pair at rest is not cut
    EXPECT_EQ(cyclic.modes.size(), mesh.modes.size());
    expect_equal(test::frequencies(mesh), test::frequencies(cyclic));
    for (const modal::Mode& mode : cyclic.modes)
      EXPECT_LT(modal::residual(b.cyclic(), spin, mode), residual_bound) << mode.omega;
    for (const modal::Mode& mode : mesh.modes) {
      EXPECT_LT(modal::residual(b.any(), spin, mode), residual_bound) << mode.omega;
      EXPECT_EQ(mode.diameters, -1);
      EXPECT_EQ(mode.wave, Wave::unknown);
    }
    // The shapes of one way fulfil the equation of the other.
    for (const modal::Mode& mode : mesh.modes)
      EXPECT_LT(modal::residual(b.cyclic(), spin, mode), residual_bound) << mode.omega;
  }
}

TEST(Modes, ResidualSeesAWrongModeAndAWrongFrequency) {
  const auto b = test::body_of(test::ring(4, 40));
  modal::Mode mode = modal::cyclic_modes(b.cyclic(), 60.0, 1).modes[0];
  mode.omega *= 1.0 + 1e-6;
  EXPECT_GT(modal::residual(b.cyclic(), 60.0, mode), 1e-7);
  EXPECT_NEAR(modal::residual(b.cyclic(), 60.0, mode), modal::residual(b.any(), 60.0, mode), 1e-12);
  mode.omega /= 1.0 + 1e-6;
  std::swap(mode.real, mode.imaginary);  // as if it went the other way
  EXPECT_GT(modal::residual(b.cyclic(), 60.0, mode), 1e-2);
}

TEST(Modes, ShapesAreOrthonormalAtRest) {
  const auto b = test::body_of(test::ring(4, 40));
  for (const modal::Modes& found :
       {modal::cyclic_modes(b.cyclic(), 0.0, 12), modal::mesh_modes(b.any(), 0.0, 12)})
    for (std::size_t i = 0; i < found.modes.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        // Round-off; of shapes with frequencies apart that of the eigensolver over their distance.
        EXPECT_NEAR(product(b, found.modes[i], found.modes[j]), i == j ? 1.0 : 0.0, 1e-9)
            << i << " " << j;
}

namespace {

/// Angle by which the pattern of n diameters moves on while ωt goes from 0 to a tenth, seen at the
/// outermost nodes: from the phase of the radial displacement's n-th Fourier coefficient.
double advance(const test::ModalBody& b, const modal::Mode& mode) {
  const auto coefficient = [&](double phase) {
    std::complex<double> sum;
    for (std::size_t i = 0; i < b.mass.size(); ++i) {
      const Vec2 x = b.mesh.coordinates[i];
      if (norm(x) < 0.3 - 1e-9) continue;
      const Vec2 u =
          std::cos(phase) * mode.real.plane()[i] - std::sin(phase) * mode.imaginary.plane()[i];
      sum += dot(u, x) * std::polar(1.0, -mode.diameters * std::atan2(x.y, x.x));
    }
    return sum;
  };
  return -std::arg(coefficient(0.1) / coefficient(0.0)) / mode.diameters;
}

}  // namespace

TEST(Modes, ForwardWavesTravelInTheSenseOfTheSpin) {
  const auto b = test::body_of(test::ring(4, 40));
  for (const double spin : {60.0, -60.0}) {
    int waves = 0;
    for (const modal::Mode& mode : modal::cyclic_modes(b.cyclic(), spin, 9).modes) {
      if (mode.wave == Wave::standing) continue;
      ++waves;
      const double sense = mode.wave == Wave::forward ? 1.0 : -1.0;
      EXPECT_GT(sense * spin * advance(b, mode), 0.0) << mode.diameters;
      EXPECT_NEAR(std::abs(advance(b, mode)), 0.1 / mode.diameters, 1e-6) << mode.diameters;
    }
    EXPECT_GE(waves, 6);
  }
}

TEST(Modes, SpinSplitsAPairBackwardAbove) {
  const auto b = test::body_of(test::ring(6, 60));
  const auto omega = [&](double spin, int n, Wave wave) {
    for (const modal::Mode& mode : modal::cyclic_modes(b.cyclic(), spin, 12).modes)
      if (mode.diameters == n && mode.wave == wave) return mode.omega;
    return 0.0;
  };
  for (const int n : {1, 2}) {
    const double rest = omega(0.0, n, Wave::standing);
    EXPECT_GT(omega(50.0, n, Wave::backward), omega(50.0, n, Wave::forward) + 10.0) << n;
    // Little spin, little split: both meet at rest.
    EXPECT_NEAR(omega(1e-3, n, Wave::backward) / rest, 1.0, 1e-5) << n;
    EXPECT_NEAR(omega(1e-3, n, Wave::forward) / rest, 1.0, 1e-5) << n;
    EXPECT_NEAR(omega(-50.0, n, Wave::forward) / omega(50.0, n, Wave::forward), 1.0, 1e-12) << n;
  }
}

TEST(Modes, TreadedDiskOfBothWays) {
  mesh::Disk disk;
  disk.radial = 3;
  disk.tread = mesh::Tread{.pitches = 11, .layers = 2};
  const auto b = test::body_of(mesh::make_disk(disk));
  for (const double spin : {0.0, 30.0}) {
    const modal::Modes cyclic = modal::cyclic_modes(b.cyclic(), spin, 30);
    expect_equal(test::frequencies(modal::mesh_modes(b.any(), spin, 30)),
                 test::frequencies(cyclic));
    EXPECT_TRUE(cyclic.counted);
  }
}

TEST(Modes, OfEqualBodiesEachIsThere) {
  const mesh::Mesh one = test::ring(4, 48);
  const auto single = test::body_of(one);
  mesh::Mesh row = one;
  for (int k = 1; k < 6; ++k) row = test::beside(row, one, {1.0 * k, 0.0});
  const auto b = test::body_of(row);
  for (const double spin : {0.0, 60.0}) {
    // About their own centers, all of them: the Coriolis and centrifugal terms know no place.
    const modal::Modes found = modal::mesh_modes(b.any(), spin, 12);
    const auto expected = test::frequencies(modal::cyclic_modes(single.cyclic(), spin, 12));
    EXPECT_TRUE(found.counted);
    ASSERT_GE(found.modes.size(), 12U);
    for (std::size_t i = 0; i < found.modes.size(); ++i)
      EXPECT_NEAR(found.modes[i].omega / expected[i / 6], 1.0, dense_error) << i;
  }
}

TEST(Modes, RootsAreCountedBeforeTheyAreSought) {
  const auto b = test::body_of(test::ring(3, 24));
  const modal::CyclicBody<2> body = b.cyclic();
  for (const double spin : {60.0, -60.0}) {
    modal::HarmonicProblem<2> problem(body, spin);
    for (const int n : {0, 2, 5, 12}) {
      problem.choose(n);
      const int all = problem.size();
      const auto roots = problem.roots_below(1e6, {all, all});
      ASSERT_EQ(roots.size(), static_cast<std::size_t>(2 * all));
      int split = 0;
      for (double sigma = 500.0; sigma < 4000.0; sigma *= 1.03) {
        const modal::RootCounts counts = problem.count_below(sigma);
        const auto within = [&](double sense) {
          return std::count_if(roots.begin(), roots.end(), [&](const modal::HarmonicRoot& r) {
            return sense * r.omega > 0.0 && sense * r.omega < sigma;
          });
        };
        EXPECT_EQ(counts.positive, within(1.0)) << n << " " << sigma;
        EXPECT_EQ(counts.negative, within(-1.0)) << n << " " << sigma;
        split += counts.positive != counts.negative ? 1 : 0;
      }
      EXPECT_EQ(split > 0, problem.has_partner()) << n;  // waves against each other differ
    }
  }
}

TEST(Modes, TooMuchSpinIsCounted) {
  const auto b = test::body_of(test::ring(2, 9));
  const Eigen::VectorXd squares =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(test::dense(b, 0.0)).eigenvalues();
  const double spin = std::sqrt(0.5 * (squares[4] + squares[5]));
  int below = 0;
  for (const double s : squares) below += s < spin * spin ? 1 : 0;
  ASSERT_GE(below, 5);
  for (const modal::Modes& found :
       {modal::cyclic_modes(b.cyclic(), spin, 4), modal::mesh_modes(b.any(), spin, 4)}) {
    EXPECT_EQ(found.unstable, below);
    EXPECT_TRUE(found.modes.empty());
  }
}

}  // namespace modes_test
