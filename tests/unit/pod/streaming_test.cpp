// SPDX-License-Identifier: BSD-3-Clause
/// Decompositions that see a block at a time, against the one that sees all; plans.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/matrices.hpp"

namespace streaming_test {

using namespace rondo::pod;
using namespace rondo::pod::test;

namespace {

/// Directions and size of what the modes span, apart from their signs and order.
double distance_of_spaces(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b * (b.transpose() * a)).norm();
}

DecomposeOptions with(Method method, std::size_t memory, Index modes = -1) {
  DecomposeOptions options;
  options.method = method;
  options.memory = memory;
  options.modes = modes;
  return options;
}

struct Streamed {
  Decomposition d;
  DecomposePlan p;
  Index largest_block;
  int reads;
};

Streamed streamed(const Eigen::MatrixXd& a, const DecomposeOptions& options, Index grain = 1) {
  WatchedSnapshots source(a, grain);
  const DecomposePlan p = plan(a.rows(), a.cols(), grain, options);
  Decomposition d = decompose(source, options);
  return {std::move(d), p, source.largest_block(), source.reads()};
}

}  // namespace

TEST(Tsqr, AgreesWithDirectInBothOrientations) {
  // The memory decides the blocks: from a few rows, which do not divide the whole, to all at once.
  for (const auto& [rows, columns] : {std::pair<Index, Index>{501, 40}, {40, 501}, {64, 64}}) {
    const Index k = std::min(rows, columns);
    const Eigen::MatrixXd a = with_spectrum(rows, columns, falling(k, 6.0));
    const Decomposition all = decompose_dense(a, Method::direct, 25);
    for (const std::size_t memory : {1000U, 140000U, 150000U, 400000U, 9000000U})
      for (const Index grain : {1, 7, 600}) {
        const Streamed s = streamed(a, with(Method::tsqr, memory, 25), grain);
        ASSERT_EQ(s.d.modes.cols(), 25);
        EXPECT_LT(relative_difference(s.d.sigma, all.sigma), 1e-14);
        EXPECT_LT(off_orthonormal(s.d.modes), 1e-14);
        EXPECT_LT(off_orthonormal(s.d.temporal), 1e-14);
        // σ_25 is 1e-4 of σ_1 and apart from its neighbours by a third of itself.
        EXPECT_LT((s.d.modes - all.modes).cwiseAbs().maxCoeff(), 1e-11);
        EXPECT_LT((s.d.temporal.leftCols(25) - all.temporal.leftCols(25)).cwiseAbs().maxCoeff(),
                  1e-11);
        EXPECT_NEAR(s.d.energy, all.energy, 1e-14 * all.energy);
        EXPECT_EQ(s.d.rank, all.rank);
        EXPECT_EQ(s.d.lost_energy, 0.0);
      }
  }
}

TEST(Tsqr, ReadsBlocksOfTheSizePlanned) {
  const Eigen::MatrixXd a = random_matrix(501, 40);
  const Streamed s = streamed(a, with(Method::tsqr, 200000, 5), 7);
  EXPECT_EQ(s.p.block % 7, 0);
  EXPECT_GE(s.reads, 4);
  EXPECT_LE(s.largest_block, std::max<Index>(s.p.block * 40, 501));
  EXPECT_LE(s.p.memory, 200000U);
}

TEST(Tsqr, MakesNoModesOfRoundOff) {
  const Eigen::VectorXd sigma = falling(12, 11.0);
  for (const auto& [rows, columns] : {std::pair<Index, Index>{300, 30}, {30, 300}}) {
    const Eigen::MatrixXd a = with_spectrum(rows, columns, sigma);
    const Streamed s = streamed(a, with(Method::tsqr, 200000, 30));
    EXPECT_EQ(s.d.rank, 12);
    ASSERT_EQ(s.d.modes.cols(), 12);
    EXPECT_LT(off_orthonormal(s.d.modes), 1e-14);
    EXPECT_LT(relative_difference(s.d.sigma.head(12), sigma), 1e-15);
    // Σ of the last mode is 1e-11 σ_1: its direction is known to 1e-16 / 1e-11.
    EXPECT_LT(distance_of_spaces(s.d.modes, random_orthonormal(rows, 12, 2)), 1e-4);
    EXPECT_LT((a - s.d.modes * (s.d.modes.transpose() * a)).norm(), 1e-14);
  }
}

TEST(Tsqr, KeepsWhatFitsInMemory) {
  const Eigen::MatrixXd a = random_matrix(60, 4000);  // a flat spectrum: all modes asked for
  const Streamed s = streamed(a, with(Method::tsqr, 800000));
  EXPECT_LE(s.p.memory, 800000U);
  EXPECT_LT(s.p.modes, 60);
  EXPECT_EQ(s.d.modes.cols(), s.p.modes);
  EXPECT_EQ(s.d.temporal.cols(), s.p.modes);
  EXPECT_EQ(s.d.sigma.size(), 60);
  const Decomposition all = decompose_dense(a, Method::direct);
  EXPECT_LT(relative_difference(s.d.sigma, all.sigma), 1e-14);
}

TEST(Incremental, WithinItsBoundOfDirect) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  for (const auto& [rows, columns] : {std::pair<Index, Index>{300, 90}, {90, 300}, {12, 200}})
    for (const double tolerance : {0.0, 1e-10, 1e-6, 1e-2}) {
      const Index k = std::min(rows, columns);
      const Eigen::MatrixXd a = with_spectrum(rows, columns, falling(k, 12.0));
      DecomposeOptions options = with(Method::incremental, 2400000, 1000);
      options.tolerance = tolerance;
      const Streamed s = streamed(a, options);
      ASSERT_GT(s.reads, 1);
      const Decomposition all = decompose_dense(a, Method::direct, k);
      const Eigen::VectorXd error = all.sigma.head(s.d.sigma.size()) - s.d.sigma;
      // Each block's decomposition, and that of the whole, rounds singular values by some ε σ_1: by
      // how many depends on the kernels that the BLAS has for the processor.
      const double rounding = 8.0 * epsilon * (s.reads + 1) * all.sigma[0];
      EXPECT_GT(error.minCoeff(), -rounding) << tolerance;
      EXPECT_LT(error.maxCoeff(), s.d.sigma_bound + rounding) << tolerance;
      // Not more than aimed at, beside what is under round-off.
      EXPECT_LE(s.d.sigma_bound, std::max(tolerance * std::sqrt(s.d.energy), 1e-12));
      EXPECT_NEAR(s.d.energy, a.squaredNorm(), 1e-14 * s.d.energy);
      EXPECT_LT(off_orthonormal(s.d.modes), 1e-13);
      EXPECT_LT(off_orthonormal(s.d.temporal), 1e-13);
      // What is lost is what the factors do not hold, measured.
      const auto r = s.d.modes.cols();
      const Eigen::MatrixXd rest =
          a - s.d.modes * s.d.sigma.head(r).asDiagonal() * s.d.temporal.leftCols(r).transpose();
      const double tail = s.d.sigma.tail(s.d.sigma.size() - r).squaredNorm();
      // The rest is right to a few ε of A, its square to that of twice its norm.
      EXPECT_NEAR(rest.squaredNorm(), s.d.lost_energy + tail, 2e-14 * rest.norm() + 1e-28);
    }
}

TEST(Incremental, TruncatedByMemorySaysSo) {
  // A flat spectrum that cannot be held: the bound is large, honest, and no longer what was aimed
  // at.
  const Eigen::MatrixXd a = random_matrix(200, 120);
  const Decomposition all = decompose_dense(a, Method::direct);
  const Streamed s = streamed(a, with(Method::incremental, 100000, 1000));
  ASSERT_LT(s.p.modes, 60);
  EXPECT_EQ(s.d.sigma.size(), s.p.modes);
  EXPECT_GT(s.d.sigma_bound, 1e-2 * all.sigma[0]);
  const Eigen::VectorXd error = all.sigma.head(s.d.sigma.size()) - s.d.sigma;
  EXPECT_GT(error.minCoeff(), 0.0);
  EXPECT_LT(error.maxCoeff(), s.d.sigma_bound);
  EXPECT_NEAR(s.d.sigma.squaredNorm() + s.d.lost_energy, a.squaredNorm(), 1e-13 * a.squaredNorm());
  EXPECT_LT(off_orthonormal(s.d.modes), 1e-13);
  EXPECT_LE(s.p.memory, 100000U);
}

TEST(Incremental, BoundAddsUpWhatEachBlockCut) {
  // One mode kept, and it is the first snapshot: each other, along its own direction, is a little
  // shorter and is cut off, though together they are the larger. σ_1² = 99 · 0.99², close to the
  // bound σ̂_1² + Σδ² = 1 + 99 · 0.99².
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(10, 100);
  a(3, 0) = 1.0;
  a.row(7).tail(99).setConstant(0.99);
  const Streamed s = streamed(a, with(Method::incremental, 1000));
  ASSERT_EQ(s.p.modes, 1);
  ASSERT_EQ(s.p.block, 1);
  EXPECT_NEAR(s.d.sigma[0], 1.0, 1e-15);
  EXPECT_NEAR(s.d.sigma_bound, 0.99 * std::sqrt(99.0), 1e-13);
  EXPECT_LT(0.99 * std::sqrt(99.0) - s.d.sigma[0], s.d.sigma_bound);
  EXPECT_NEAR(s.d.lost_energy, 0.99 * 0.99 * 99.0, 1e-12);
}

TEST(Incremental, StaysOrthonormalOverManyBlocks) {
  // 1200 blocks of one snapshot; singular values over twelve decades, so that each projection
  // leaves a remainder far smaller than the snapshot.
  const Eigen::MatrixXd a = with_spectrum(150, 1200, falling(40, 12.0));
  DecomposeOptions options = with(Method::incremental, 8 * 60000, 40);
  options.tolerance = 1e-13;
  const Streamed s = streamed(a, options);
  ASSERT_GT(s.reads, 50);
  EXPECT_LT(off_orthonormal(s.d.modes), 1e-13);
  EXPECT_LT(off_orthonormal(s.d.temporal), 1e-12);
  EXPECT_LT(std::abs(s.d.sigma[0] - 1.0), 1e-13);
}

TEST(Decompose, TellsOfItsProgress) {
  for (const Method method : {Method::direct, Method::tsqr, Method::incremental})
    for (const double size : {0.0, 1.0}) {
      DecomposeOptions options = with(method, 60000, 5);
      long long last = 0, total = 0;
      int calls = 0;
      options.progress = [&](long long done, long long all) {
        EXPECT_GT(done, last);
        EXPECT_TRUE(total == 0 || all == total);
        last = done;
        total = all;
        ++calls;
      };
      static_cast<void>(streamed(size * random_matrix(200, 30), options));
      EXPECT_EQ(last, total);
      EXPECT_GE(calls, method == Method::direct ? 1 : 3);
    }
}

TEST(Plan, TheFirstMethodThatFits) {
  const Index rows = 200000, columns = 1000;
  const auto chosen = [&](std::size_t memory, Index modes) {
    return plan(rows, columns, 360, with(Method::automatic, memory, modes));
  };
  const DecomposePlan whole = plan(rows, columns, 360, with(Method::direct, 0, 50));
  // The matrix, 50 modes, and the work space of the small decomposition.
  EXPECT_GT(whole.memory, 8U * 1050 * 200000);
  EXPECT_LT(whole.memory, 8U * 1050 * 200000 + 100'000'000U);
  EXPECT_EQ(chosen(whole.memory, 50).method, Method::direct);
  EXPECT_EQ(chosen(whole.memory - 1, 50).method, Method::tsqr);
  const DecomposePlan least = plan(rows, columns, 360, with(Method::tsqr, 0, 50));
  EXPECT_EQ(least.block, 360);
  EXPECT_EQ(chosen(least.memory, 50).method, Method::tsqr);
  EXPECT_EQ(chosen(least.memory - 1, 50).method, Method::incremental);
  for (std::size_t memory = 10'000'000; memory < 10'000'000'000; memory += memory / 7)
    for (const Index modes : {-1, 20, 1000}) {
      const DecomposePlan p = chosen(memory, modes);
      EXPECT_LE(p.memory, memory) << modes;
      EXPECT_GT(p.flops, 0.0);
      EXPECT_TRUE(p.method == Method::incremental || modes < 0 || p.modes == modes);
    }
}

TEST(Plan, TooLittleForAny) {
  const DecomposePlan p = plan(200000, 1000, 360, with(Method::automatic, 1000));
  EXPECT_EQ(p.method, Method::incremental);
  EXPECT_EQ(p.block, 1);
  EXPECT_EQ(p.modes, 1);
  EXPECT_GT(p.memory, 1000U);
  // It still runs, and says what it lost.
  const Eigen::MatrixXd a = random_matrix(50, 30);
  const Streamed s = streamed(a, with(Method::automatic, 1000));
  EXPECT_EQ(s.d.sigma.size(), 1);
  EXPECT_NEAR(s.d.sigma[0] * s.d.sigma[0] + s.d.lost_energy, a.squaredNorm(), 1e-11);
}

}  // namespace streaming_test
