// SPDX-License-Identifier: BSD-3-Clause
/// The factors that implicit elements are solved with, against dense solutions.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/integrators/implicit/block_lu.hpp"
#include "rondo/integrators/implicit/circulant.hpp"

namespace implicit_factors_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

class Numbers {
 public:
  double operator()() { return of_(engine_); }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [this] { return (*this)(); });
  }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }

 private:
  std::mt19937 engine_{3};
  std::uniform_real_distribution<double> of_{-1.0, 1.0};
};

/// Couplings of a pattern by chance; its symmetric part dominates by its diagonal. Not symmetric.
fem::BlockCsr random_blocks(int n, int couplings, Numbers& numbers) {
  std::vector<std::set<int>> columns(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) columns[static_cast<std::size_t>(i)].insert(i);
  for (int k = 0; k < couplings; ++k) {
    const int i = numbers.below(n), j = numbers.below(n);
    columns[static_cast<std::size_t>(i)].insert(j);
    columns[static_cast<std::size_t>(j)].insert(i);
  }
  fem::BlockCsr a;
  a.row_start.push_back(0);
  for (int i = 0; i < n; ++i) {
    const auto& of_row = columns[static_cast<std::size_t>(i)];
    for (const int j : of_row) {
      fem::BlockCsr::Block block{numbers(), numbers(), numbers(), numbers()};
      if (j == i) block[0] = block[3] = 2.5 * static_cast<double>(of_row.size());
      if (j == i) block[1] += 40.0, block[2] -= 40.0;  // spin, more than there ever is
      a.column.push_back(j);
      a.values.push_back(block);
    }
    a.row_start.push_back(static_cast<std::int64_t>(a.column.size()));
  }
  return a;
}

Eigen::MatrixXd dense(const fem::BlockCsr& a) {
  const auto n = static_cast<Eigen::Index>(a.n_rows());
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (auto at = a.row_start[static_cast<std::size_t>(i)];
         at < a.row_start[static_cast<std::size_t>(i) + 1]; ++at) {
      const auto b = static_cast<std::size_t>(at);
      const Eigen::Index j = a.column[b];
      for (Eigen::Index c = 0; c < 4; ++c)
        full(2 * i + c % 2, 2 * j + c / 2) = a.values[b][static_cast<std::size_t>(c)];
    }
  return full;
}

/// Σ |a x_j - b x_{j-1}|² + least |x|², and a gyroscopic part.
RingBlocks ring_blocks(int rows, double least, Numbers& numbers) {
  const Eigen::MatrixXd a = numbers.matrix(rows, rows), b = numbers.matrix(rows, rows);
  const Eigen::MatrixXd spin = numbers.matrix(rows, rows);
  return {-a.transpose() * b,
          a.transpose() * a + b.transpose() * b + least * Eigen::MatrixXd::Identity(rows, rows) +
              spin - spin.transpose(),
          -b.transpose() * a};
}

Eigen::MatrixXd dense(const RingBlocks& blocks, int sectors) {
  const Eigen::Index rows = blocks.here.rows(), n = sectors;
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(rows * n, rows * n);
  for (Eigen::Index j = 0; j < n; ++j) {
    full.block(rows * j, rows * j, rows, rows) += blocks.here;
    full.block(rows * j, rows * ((j + n - 1) % n), rows, rows) += blocks.left;
    full.block(rows * j, rows * ((j + 1) % n), rows, rows) += blocks.right;
  }
  return full;
}

/// The solution of the ring's system against the dense one, of its size.
double ring_error(const RingBlocks& blocks, int sectors, RingProduct product, Numbers& numbers) {
  const auto rows = static_cast<int>(blocks.here.rows());
  Circulant factor(sectors, blocks, product);
  const Eigen::VectorXd b = numbers.matrix(rows * sectors, 1);
  RingRows x(rows, sectors);
  double error = 0.0;
  const Eigen::VectorXd exact = dense(blocks, sectors).partialPivLu().solve(b);
  for (int again = 0; again < 2; ++again) {  // nothing of a solution is in the way of the next
    for (int j = 0; j < sectors; ++j)
      for (int i = 0; i < rows; ++i) x.row(i)[j] = b[rows * j + i];
    factor.solve(x);
    for (int j = 0; j < sectors; ++j)
      for (int i = 0; i < rows; ++i)
        error = std::max(error, std::abs(x.row(i)[j] - exact[rows * j + i]));
  }
  return error / exact.cwiseAbs().maxCoeff();
}

}  // namespace

TEST(BlockLu, SolvesAsADenseFactorDoes) {
  Numbers numbers;
  for (const auto& [n, couplings] :
       {std::pair{1, 0}, {2, 1}, {7, 0}, {40, 60}, {40, 800}, {150, 250}}) {
    SCOPED_TRACE(n);
    const fem::BlockCsr a = random_blocks(n, couplings, numbers);
    BlockLu factor(a);
    EXPECT_EQ(factor.size(), static_cast<std::size_t>(n));
    const Eigen::MatrixXd full = dense(a);
    for (int again = 0; again < 2; ++again) {
      const Eigen::VectorXd b = numbers.matrix(2 * n, 1);
      const Eigen::VectorXd exact = full.partialPivLu().solve(b);
      std::vector<double> x(static_cast<std::size_t>(n)), y(x);
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = b[static_cast<Eigen::Index>(2 * i)];
        y[i] = b[static_cast<Eigen::Index>(2 * i) + 1];
      }
      factor.solve(x, y);
      double error = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i)
        error = std::max({error, std::abs(x[i] - exact[static_cast<Eigen::Index>(2 * i)]),
                          std::abs(y[i] - exact[static_cast<Eigen::Index>(2 * i) + 1])});
      EXPECT_LT(error, 1e-13 * exact.cwiseAbs().maxCoeff());
    }
  }
}

/// What a tree needs: as many blocks as it has edges.
TEST(BlockLu, AStarFillsNothingIn) {
  constexpr int n = 30;
  fem::BlockCsr a;
  a.row_start.push_back(0);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      if (i == j || i == 0 || j == 0) {
        a.column.push_back(j);
        a.values.push_back(i == j ? fem::BlockCsr::Block{60.0, 0.0, 0.0, 60.0}
                                  : fem::BlockCsr::Block{1.0, 0.0, 0.0, 1.0});
      }
    a.row_start.push_back(static_cast<std::int64_t>(a.column.size()));
  }
  EXPECT_EQ(BlockLu(a).n_blocks(), static_cast<std::size_t>(n - 1));
}

/// Few and many sectors, powers of two or not, on which the coupling comes round to itself.
TEST(Circulant, SolvesAsADenseFactorDoes) {
  Numbers numbers;
  for (const kernels::Table* table : kernel_tables())
    for (const int sectors : {3, 4, 5, 7, 8, 16, 61, 64, 90})
      for (const int rows : {1, 2, 4, 6}) {
        SCOPED_TRACE(testing::Message() << sectors << " sectors, " << rows << " rows");
        const RingBlocks blocks = ring_blocks(rows, 1.0, numbers);
        EXPECT_LT(ring_error(blocks, sectors, table->ring_product, numbers), 1e-12);
      }
}

/// A coupling that hardly decays over the ring takes more levels, and is as exact.
TEST(Circulant, SlowDecay) {
  Numbers numbers;
  std::size_t levels = 0;
  for (const double least : {10.0, 1e-2, 1e-6}) {
    RingBlocks blocks = ring_blocks(1, 0.0, numbers);
    blocks.left(0, 0) = blocks.right(0, 0) = -1.0;
    blocks.here(0, 0) = 2.0 + least;
    const Circulant factor(64, blocks, kernel_table().ring_product);
    EXPECT_GT(factor.n_levels(), levels) << least;
    levels = factor.n_levels();
    // What is lost is the condition, 4/least.
    EXPECT_LT(ring_error(blocks, 64, kernel_table().ring_product, numbers), 1e-15 + 4e-15 / least);
  }
  EXPECT_GT(levels, 10U);
}

}  // namespace implicit_factors_test
