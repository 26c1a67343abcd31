// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/matrices.hpp"

namespace spectrum_test {

using namespace rondo::pod;
using namespace rondo::pod::test;

namespace {

Decomposition of(const std::vector<double>& sigma, double lost = 0.0) {
  Decomposition d;
  d.sigma = Eigen::Map<const Eigen::VectorXd>(sigma.data(), static_cast<Index>(sigma.size()));
  d.lost_energy = lost;
  d.energy = d.sigma.squaredNorm() + lost;
  return d;
}

const std::vector<Method> methods{Method::direct, Method::tsqr, Method::incremental};

}  // namespace

TEST(Spectrum, SharesOfTheEnergy) {
  const Spectrum s = spectrum(of({3.0, 2.0, 1.0}, 2.0));  // 9, 4, 1, and 2 lost, of 16
  EXPECT_EQ(s.energy, (std::vector<double>{9.0 / 16, 4.0 / 16, 1.0 / 16}));
  EXPECT_EQ(s.cumulative, (std::vector<double>{9.0 / 16, 13.0 / 16, 14.0 / 16}));
  EXPECT_EQ(s.discarded, (std::vector<double>{7.0 / 16, 3.0 / 16, 2.0 / 16}));
}

TEST(Spectrum, DiscardedIsTheTailItself) {
  // 1 minus the cumulative share would be 0 or a few ε after the first mode.
  const Spectrum s = spectrum(of({1.0, 1e-9, 1e-12, 1e-15}));
  EXPECT_NEAR(s.discarded[0], 1e-18 + 1e-24 + 1e-30, 1e-33);
  EXPECT_NEAR(s.discarded[1], 1e-24 + 1e-30, 1e-39);
  EXPECT_NEAR(s.discarded[2], 1e-30, 1e-45);
  EXPECT_EQ(s.discarded[3], 0.0);
}

TEST(Spectrum, NumberOfModes) {
  const Spectrum s = spectrum(of({3.0, 2.0, 1.0}, 2.0));  // leaves 7, 3, 2 of 16
  EXPECT_EQ(modes_for(s, 1.0), 0);
  EXPECT_EQ(modes_for(s, 0.99), 1);
  EXPECT_EQ(modes_for(s, 7.0 / 16), 1);
  EXPECT_EQ(modes_for(s, 0.4), 2);
  EXPECT_EQ(modes_for(s, 2.0 / 16), 3);
  EXPECT_EQ(modes_for(s, 0.12), -1);
  EXPECT_EQ(modes_for(spectrum(of({0.0, 0.0})), 0.0), 0);
  EXPECT_EQ(modes_for(spectrum(of({})), 0.0), 0);
}

/// (7.2b): what q modes leave of a snapshot, from σ and V. @pre V is whole
double tail_of(const Decomposition& d, Index snapshot, Index modes) {
  double sum = 0.0;
  for (Index i = d.sigma.size(); i-- > modes;)
    sum += std::pow(d.sigma[i] * d.temporal(snapshot, i), 2);
  return sum;
}

TEST(Identity, ErrorsOfEachSnapshotWithFewerModes) {
  for (const auto& [rows, columns] : {std::pair<Index, Index>{60, 25}, {25, 60}})
    for (const Method method : methods) {
      const Eigen::MatrixXd a = with_spectrum(rows, columns, falling(25, 4.0));
      const Decomposition d = decompose_dense(a, method, 20);
      DenseSnapshots source(a);
      IdentityOptions options;
      options.block = 7;
      options.fewer = {0, 1, 6, 20};
      const Identity found = check_identity(source, d, options);
      ASSERT_EQ(found.fewer_error.size(), 4U);
      for (std::size_t k = 0; k < 4; ++k) {
        const Eigen::MatrixXd u = d.modes.leftCols(options.fewer[k]);
        const Eigen::VectorXd explicit_errors =
            (a - u * (u.transpose() * a)).colwise().squaredNorm();
        ASSERT_EQ(found.fewer_error[k].size(), static_cast<std::size_t>(columns));
        for (Index j = 0; j < columns; ++j) {
          const double scale = std::sqrt(d.energy * a.col(j).squaredNorm());
          const double error = found.fewer_error[k][static_cast<std::size_t>(j)];
          EXPECT_NEAR(error, explicit_errors[j], 5e-15 * scale);  // few ε σ_1 · ‖a_j‖
          if (d.temporal.cols() == d.sigma.size()) {
            EXPECT_NEAR(error, tail_of(d, j, options.fewer[k]), 5e-15 * scale);
          }
        }
      }
    }
}

/// What was cut is in the errors: they are measured, not summed from what is left.
TEST(Identity, ErrorsOfATruncatedDecompositionAreTrue) {
  const Eigen::MatrixXd a = random_matrix(60, 300);
  DenseSnapshots source(a);
  DecomposeOptions options;
  options.method = Method::incremental;
  options.memory = 60000;
  const Decomposition d = decompose(source, options);
  ASSERT_GT(d.lost_energy, 0.1 * d.energy);
  const Eigen::VectorXd explicit_errors =
      (a - d.modes * (d.modes.transpose() * a)).colwise().squaredNorm();
  const Identity found = check_identity(source, d, {32, {d.modes.cols()}, {}});
  for (Index j = 0; j < a.cols(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    EXPECT_NEAR(found.squared_error[at], explicit_errors[j], 1e-13 * a.col(j).squaredNorm());
    EXPECT_EQ(found.fewer_error[0][at], found.squared_error[at]);
  }
}

TEST(Identity, HoldsForAnyNumberOfModes) {
  for (const auto& [rows, columns] : {std::pair<Index, Index>{80, 33}, {33, 80}})
    for (const Method method : {Method::direct, Method::tsqr})
      for (const Index modes : {0, 1, 12, 33}) {
        const Eigen::MatrixXd a = with_spectrum(rows, columns, falling(33, 5.0));
        const Decomposition d = decompose_dense(a, method, modes);
        WatchedSnapshots source(a);
        const Identity i = check_identity(source, d, {7, {}, {}});
        EXPECT_EQ(i.modes, modes);
        EXPECT_NEAR(i.residual, i.tail, 1e-14);
        // Of the tail itself: the residual is made of numbers, each right to ε of the snapshots'.
        EXPECT_NEAR(i.residual, i.tail, 1e-14 * std::sqrt(i.tail) + 1e-29);
        EXPECT_EQ(i.difference, std::abs(i.residual - i.tail));
        EXPECT_LT(i.orthonormality, 1e-14);
        const double share = d.sigma.tail(33 - modes).squaredNorm() / a.squaredNorm();
        EXPECT_NEAR(i.tail, share, 1e-14 * share);
        ASSERT_EQ(i.squared_error.size(), static_cast<std::size_t>(a.cols()));
        for (std::size_t j = 0; j < i.squared_error.size(); ++j) {
          if (d.temporal.cols() == d.sigma.size()) {
            EXPECT_NEAR(i.squared_error[j], tail_of(d, static_cast<Index>(j), modes),
                        5e-15 * std::sqrt(d.energy * i.snapshot_energy[j]));
          }
          EXPECT_NEAR(i.snapshot_energy[j], a.col(static_cast<Index>(j)).squaredNorm(),
                      1e-15 * i.snapshot_energy[j]);
        }
      }
}

TEST(Identity, SeesWrongModes) {
  const Eigen::MatrixXd a = with_spectrum(80, 33, falling(33, 5.0));
  Decomposition d = decompose_dense(a, Method::direct, 5);
  DenseSnapshots source(a);
  d.modes.col(1) = -0.99 * d.modes.col(1);
  EXPECT_GT(check_identity(source, d).orthonormality, 1e-3);
  d.modes.col(1) = random_orthonormal(80, 1, 9);
  EXPECT_GT(check_identity(source, d).difference, 1e-3);
}

TEST(Identity, OfATruncatedDecomposition) {
  const Eigen::MatrixXd a = random_matrix(200, 120);
  WatchedSnapshots source(a);
  DecomposeOptions options;
  options.method = Method::incremental;
  options.memory = 100000;
  const Decomposition d = decompose(source, options);
  const Identity i = check_identity(source, d);
  EXPECT_GT(d.lost_energy, 0.1 * d.energy);
  // What was cut off may lie along the modes kept: then the true error is the smaller one.
  EXPECT_LT(i.residual, i.tail);
  EXPECT_LT(i.difference, d.lost_energy / d.energy);
}

TEST(Identity, OfNothing) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Zero(20, 6);
  DenseSnapshots source(a);
  for (const Method method : methods) {
    const Identity i = check_identity(source, decompose_dense(a, method));
    EXPECT_EQ(i.residual, 0.0);
    EXPECT_EQ(i.tail, 0.0);
    EXPECT_EQ(i.difference, 0.0);
    EXPECT_EQ(i.orthonormality, 0.0);
    EXPECT_EQ(i.squared_error, std::vector<double>(6, 0.0));
  }
}

}  // namespace spectrum_test
