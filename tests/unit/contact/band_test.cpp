// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/band.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace band_test {

using namespace rondo::contact;

TEST(BandLu, SolvesAsADenseFactorisation) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  BandLu band;
  for (int round = 0; round < 200; ++round) {
    const int n = 1 + static_cast<int>(random() % 40);
    const int width = static_cast<int>(random() % static_cast<unsigned>(n));
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    band.reset(n, width);
    for (int i = 0; i < n; ++i)
      for (int j = std::max(0, i - width); j <= std::min(n - 1, i + width); ++j)
        band.at(i, j) = dense(i, j) =
            i == j ? 0.01 * u(random) : u(random);  // rows do change places
    Eigen::VectorXd x(n);
    for (int i = 0; i < n; ++i) x[i] = u(random);
    const Eigen::VectorXd right = dense * x;
    std::vector<double> solution(right.data(), right.data() + n);
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(dense);
    const bool singular = lu.rcond() < 1e-10;
    if (singular) continue;
    ASSERT_TRUE(band.factorise());
    band.solve(solution);
    for (int i = 0; i < n; ++i)  // backward stable: round-off times the condition
      ASSERT_NEAR(solution[static_cast<std::size_t>(i)], x[i], 1e-14 / lu.rcond()) << n << width;
  }
}

TEST(BandLu, SaysThatAMatrixIsSingular) {
  BandLu band;
  band.reset(3, 1);
  band.at(0, 0) = 1.0;
  band.at(1, 0) = 2.0;
  band.at(2, 2) = 1.0;
  EXPECT_FALSE(band.factorise());
}

}  // namespace band_test
