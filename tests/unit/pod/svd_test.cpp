// SPDX-License-Identifier: BSD-3-Clause
/// The direct decomposition against prescribed spectra and an independent solver.
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <Eigen/SVD>
#include <cmath>
#include <vector>

#include "rondo/pod/spectrum.hpp"
#include "rondo/pod/svd.hpp"
#include "support/matrices.hpp"

namespace svd_test {

using namespace rondo::pod;
using namespace rondo::pod::test;

namespace {

constexpr double eps = 2.2e-16;
const std::vector<std::pair<Index, Index>> shapes{{90, 17}, {17, 90}, {40, 40}, {1, 9}, {9, 1}};

Eigen::VectorXd jacobi(const Eigen::MatrixXd& a) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(a).singularValues();
}

}  // namespace

TEST(Direct, AgreesWithJacobi) {
  for (const auto& [rows, columns] : shapes) {
    const Eigen::MatrixXd a = random_matrix(rows, columns);
    const Index k = std::min(rows, columns);
    const Decomposition d = decompose_dense(a, Method::direct, k);
    ASSERT_EQ(d.sigma.size(), k);
    // Both err by a few ε σ_1.
    EXPECT_LT(relative_difference(d.sigma, jacobi(a)), 1e-13) << rows << " x " << columns;
    EXPECT_EQ(d.rank, k);
    ASSERT_EQ(d.modes.cols(), k);
    ASSERT_EQ(d.temporal.cols(), k);
    EXPECT_LT(off_orthonormal(d.modes), 1e-14);
    EXPECT_LT(off_orthonormal(d.temporal), 1e-14);
    const Eigen::MatrixXd again = d.modes * d.sigma.asDiagonal() * d.temporal.transpose();
    EXPECT_LT((again - a).norm(), 1e-14 * a.norm());
    EXPECT_NEAR(d.energy, a.squaredNorm(), 1e-14 * d.energy);
    EXPECT_EQ(d.lost_energy, 0.0);
    EXPECT_EQ(d.sigma_bound, 0.0);
  }
}

TEST(Direct, PrescribedSpectraDownToRoundOff) {
  for (const auto& [rows, columns] : {std::pair<Index, Index>{400, 33}, {33, 400}, {60, 60}}) {
    const Eigen::VectorXd sigma = falling(std::min(rows, columns), 16.0);
    const Eigen::MatrixXd a = with_spectrum(rows, columns, sigma);
    const Decomposition d = decompose_dense(a, Method::direct);
    // Absolute: also those of 1e-14 σ_1 and less are right to a few ε σ_1, among which is the error
    // of the products that make the matrix.
    EXPECT_LT(relative_difference(d.sigma, sigma), 5 * eps) << rows << " x " << columns;
    const double least = static_cast<double>(std::max(rows, columns)) * eps;
    EXPECT_NEAR(static_cast<double>(d.rank), static_cast<double>((sigma.array() > least).count()),
                1.0);
  }
}

TEST(Direct, KeepsTheModesAskedFor) {
  const Eigen::MatrixXd a = with_spectrum(50, 20, falling(20, 5.0));
  const Decomposition all = decompose_dense(a, Method::direct, 20);
  const Decomposition some = decompose_dense(a, Method::direct, 7);
  ASSERT_EQ(some.modes.cols(), 7);
  EXPECT_LT((some.modes - all.modes.leftCols(7)).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_EQ(decompose_dense(a, Method::direct, 0).modes.cols(), 0);
  EXPECT_EQ(decompose_dense(a, Method::direct, 99).modes.cols(), 20);
}

TEST(EveryMethod, KeepsAMillionthOfTheEnergyUnasked) {
  // After three modes 1.2e-6 of the energy is left, after four 1e-8.
  Eigen::VectorXd sigma(5);
  sigma << 1.0, 0.1, 0.01, 1.1e-3, 1e-4;
  for (const Method method : {Method::direct, Method::tsqr, Method::incremental}) {
    EXPECT_EQ(decompose_dense(with_spectrum(30, 12, sigma), method).modes.cols(), 4);
    EXPECT_EQ(decompose_dense(with_spectrum(12, 30, sigma), method).modes.cols(), 4);
  }
}

TEST(EveryMethod, DegenerateMatrices) {
  struct Case {
    Eigen::MatrixXd a;
    Index rank;
  };
  const Eigen::VectorXd one = random_matrix(23, 1).col(0);
  Eigen::MatrixXd with_zeros = random_matrix(23, 9);
  with_zeros.col(0).setZero();
  with_zeros.col(5).setZero();
  const std::vector<Case> cases{
      {Eigen::MatrixXd::Zero(23, 9), 0},
      {Eigen::MatrixXd::Zero(9, 23), 0},
      {Eigen::MatrixXd::Zero(1, 1), 0},
      {one, 1},
      {one.transpose(), 1},
      {one.replicate(1, 9), 1},
      {one.transpose().replicate(9, 1), 1},
      {with_spectrum(23, 9, falling(4, 2.0)), 4},
      {with_spectrum(9, 23, falling(4, 2.0)), 4},
      {with_zeros, 7},
      {Eigen::MatrixXd::Identity(12, 12), 12},
      {1e-150 * one.replicate(1, 30), 1},
  };
  for (const Method method : {Method::direct, Method::tsqr, Method::incremental})
    for (const Case& c : cases) {
      const Decomposition d = decompose_dense(c.a, method, 100);
      EXPECT_EQ(d.rank, c.rank) << static_cast<int>(method);
      EXPECT_EQ(d.modes.cols(), c.rank);
      EXPECT_EQ(d.modes.rows(), c.a.rows());
      EXPECT_EQ(d.temporal.rows(), c.a.cols());
      EXPECT_TRUE(d.sigma.allFinite() && d.modes.allFinite() && d.temporal.allFinite());
      EXPECT_LT(off_orthonormal(d.modes), 1e-14);
      EXPECT_NEAR(d.energy, c.a.squaredNorm(), 1e-14 * d.energy);
      EXPECT_NEAR(d.sigma.squaredNorm() + d.lost_energy, d.energy, 1e-13 * d.energy);
      const auto r = static_cast<Eigen::Index>(c.rank);
      const Eigen::MatrixXd again =
          d.modes * d.sigma.head(r).asDiagonal() * d.temporal.leftCols(r).transpose();
      EXPECT_LE((again - c.a).norm(), 1e-13 * c.a.norm());
      const Spectrum s = spectrum(d);
      for (const auto* shares : {&s.energy, &s.cumulative, &s.discarded})
        for (const double share : *shares) EXPECT_TRUE(share >= 0.0 && share < 1.0 + 1e-13);
      if (c.rank == 0) {
        EXPECT_EQ(d.energy, 0.0);
        EXPECT_TRUE(d.sigma.isZero(0.0));
      }
    }
}

TEST(EveryMethod, LargestNumberOfAModeIsPositive) {
  for (const Method method : {Method::direct, Method::tsqr, Method::incremental})
    for (const Eigen::MatrixXd& a : {random_matrix(31, 8), random_matrix(8, 31)}) {
      const Decomposition d = decompose_dense(a, method, 8);
      ASSERT_EQ(d.modes.cols(), 8);
      for (Index i = 0; i < 8; ++i)
        EXPECT_EQ(d.modes.col(i).maxCoeff(), d.modes.col(i).cwiseAbs().maxCoeff());
    }
}

TEST(EveryMethod, SameBitsEachTime) {
  const Eigen::MatrixXd a = random_matrix(700, 150);
  for (const Method method : {Method::direct, Method::tsqr, Method::incremental}) {
    const Decomposition once = decompose_dense(a, method, 20),
                        twice = decompose_dense(a, method, 20);
    EXPECT_TRUE(once.sigma == twice.sigma && once.modes == twice.modes &&
                once.temporal == twice.temporal);
  }
}

}  // namespace svd_test
