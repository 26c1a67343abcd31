// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/nonnegative.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <random>

using namespace rondo::pod;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd random_nonnegative(Index rows, Index columns, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(engine); });
}

/// Narrow hats that overlap, and sums of them.
MatrixXd hats(Index rows, Index patterns) {
  MatrixXd w(rows, patterns);
  for (Index i = 0; i < rows; ++i)
    for (Index k = 0; k < patterns; ++k) {
      const double middle = (static_cast<double>(k) + 0.5) * static_cast<double>(rows) /
                            static_cast<double>(patterns);
      w(i, k) = std::max(0.0, 6.0 - std::abs(static_cast<double>(i) - middle));
    }
  return w;
}

void expect_sound(const MatrixXd& a, const NonnegativeFactors& f) {
  EXPECT_EQ(f.w.rows(), a.rows());
  EXPECT_EQ(f.h.cols(), a.cols());
  ASSERT_EQ(f.w.cols(), f.h.rows());
  EXPECT_TRUE((f.w.array() >= 0.0).all());
  EXPECT_TRUE((f.h.array() >= 0.0).all());
  for (Index k = 0; k < f.w.cols(); ++k) {
    EXPECT_NEAR(f.w.col(k).sum(), 1.0, 1e-14);
    EXPECT_GT(f.h.row(k).maxCoeff(), 0.0) << "pattern " << k << " is dead";
  }
  // What is reported is what is returned; leaving out and scaling change nothing but round-off.
  if (a.norm() > 0.0) {
    EXPECT_NEAR((a - f.w * f.h).norm() / a.norm(), f.residual(), 1e-13);
  }
  for (std::size_t s = 1; s < f.residuals.size(); ++s)
    EXPECT_LE(f.residuals[s], f.residuals[s - 1] + 1e-14) << "sweep " << s;
}

}  // namespace

TEST(Nonnegative, FindsTheFactorsOfAProduct) {
  // Columns that are one pattern alone make the factors unique, but for scales and order.
  const MatrixXd w = hats(40, 5);
  MatrixXd h = random_nonnegative(5, 60, 1);
  h.leftCols(5).setIdentity();
  const MatrixXd a = w * h;
  const NonnegativeFactors f = factor_nonnegative(a, 5, {20000, 1e-6});
  expect_sound(a, f);
  ASSERT_EQ(f.w.cols(), 5);
  EXPECT_LT(f.residual(), 1e-6);
  for (Index k = 0; k < 5; ++k) {
    const Eigen::VectorXd wanted = w.col(k) / w.col(k).sum();
    // The residual's accuracy, times what the overlap of the hats loses of it.
    EXPECT_LT((f.w.colwise() - wanted).colwise().norm().minCoeff(), 1e-4) << "pattern " << k;
  }
}

TEST(Nonnegative, ResidualFallsAndStaysAboveThatOfTheSvd) {
  const MatrixXd a = random_nonnegative(30, 50, 2);
  const Eigen::VectorXd sigma = Eigen::JacobiSVD<MatrixXd>(a).singularValues();
  double before = 1.0;
  for (const Index k : {1, 3, 8, 20}) {
    const NonnegativeFactors f = factor_nonnegative(a, k);
    expect_sound(a, f);
    EXPECT_EQ(f.w.cols(), k);
    EXPECT_LT(f.residual(), f.residuals.front()) << "sweeps do nothing";
    EXPECT_GE(f.residual(), sigma.tail(sigma.size() - k).norm() / a.norm() - 1e-14);
    EXPECT_LT(f.residual(), before);
    before = f.residual();
  }
  // One pattern: the first singular vectors are non-negative, and so the best there is.
  EXPECT_NEAR(factor_nonnegative(a, 1).residual(), sigma.tail(29).norm() / a.norm(), 1e-6);
}

TEST(Nonnegative, FewerPatternsThanAskedForWhereTheyHoldAll) {
  MatrixXd a(12, 9);
  const MatrixXd w = random_nonnegative(12, 3, 3);
  for (Index j = 0; j < 9; ++j) a.col(j) = static_cast<double>(j + 1) * w.col(j % 3);
  const NonnegativeFactors f = factor_nonnegative(a, 7);
  expect_sound(a, f);
  EXPECT_EQ(f.w.cols(), 3);
  EXPECT_LT(f.residual(), 1e-12);
  // One column is one pattern, however many are asked for.
  const NonnegativeFactors one = factor_nonnegative(a.leftCols(1), 4);
  EXPECT_EQ(one.w.cols(), 1);
  EXPECT_LT((one.w.col(0) - w.col(0) / w.col(0).sum()).norm(), 1e-15);
}

TEST(Nonnegative, OfNothingNothing) {
  for (const MatrixXd& a : {MatrixXd(MatrixXd::Zero(5, 4)), MatrixXd(5, 0)}) {
    const NonnegativeFactors f = factor_nonnegative(a, 3);
    expect_sound(a, f);
    EXPECT_EQ(f.w.cols(), 0);
    EXPECT_EQ(f.residual(), 0.0);
  }
}

TEST(Nonnegative, SparseAndBadlyScaled) {
  // Half of the entries zero, columns from 1e-3 to 1e6: no pattern dies for good.
  MatrixXd a = (random_nonnegative(25, 40, 4).array() - 0.5).cwiseMax(0.0);
  for (Index j = 0; j < 40; ++j) a.col(j) *= std::pow(10.0, static_cast<double>(j % 10) - 3.0);
  for (const Index k : {2, 6, 12}) {
    const NonnegativeFactors f = factor_nonnegative(a, k);
    expect_sound(a, f);
    EXPECT_EQ(f.w.cols(), k);
  }
}

TEST(Nonnegative, SameBitsEveryTime) {
  const MatrixXd a = random_nonnegative(20, 30, 5);
  const NonnegativeFactors f = factor_nonnegative(a, 4), g = factor_nonnegative(a, 4);
  EXPECT_EQ(f.w, g.w);
  EXPECT_EQ(f.h, g.h);
  EXPECT_EQ(f.residuals, g.residuals);
}
