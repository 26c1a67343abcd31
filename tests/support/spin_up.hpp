// SPDX-License-Identifier: BSD-3-Clause
/// V10, long times: a disk that starts to spin suddenly, without damping.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/statics/stationary_spin.hpp"
#include "support/models.hpp"
#include "support/stepping.hpp"

namespace rondo::test {

/// It oscillates about the stationary spin. Checks mean and amplitude over the first and the last
/// 200 periods of its slowest axisymmetric wave.
inline void expect_oscillation_for_ever(dynamics::StiffnessOperator of, int steps) {
  const auto b = build(rubber_annulus(4, 24));
  const auto exact = statics::stationary_spin(b.model.stiffness, b.model.mass, b.model.reference,
                                              b.model.free, -50.0);
  const double stationary =
      -exact.u.plane()[4].y;  // top of column 0, straight down: -y is outwards
  Stepping run(b, of);
  const double period = 2.0 * std::numbers::pi / 475.0;  // the slowest axisymmetric wave
  const auto window = static_cast<int>(std::lround(200.0 * period / b.model.dt));
  double first_sum = 0.0, largest_early = 0.0, largest_late = 0.0, last_sum = 0.0;
  ASSERT_GT(steps, 2 * window);
  for (int n = 1; n <= steps; ++n) {
    run.advance();
    const double u = -run.state().u.plane()[4].y;
    if (n <= window) {
      first_sum += u;
      largest_early = std::max(largest_early, u);
    }
    if (n > steps - window) {
      last_sum += u;
      largest_late = std::max(largest_late, u);
    }
  }
  // The mean over 200 periods has an error of at most 1/(2π 200) = 0.08 % of the amplitude, which
  // is about the mean itself.
  testing::Test::RecordProperty("first_mean",
                                fmt::format("{:.6f}", first_sum / window / stationary));
  testing::Test::RecordProperty("last_mean", fmt::format("{:.6f}", last_sum / window / stationary));
  testing::Test::RecordProperty("maxima", fmt::format("{:.6f}", largest_late / largest_early));
  testing::Test::RecordProperty("relative", fmt::format("{:.2g}", run.balance().relative));
  EXPECT_NEAR(first_sum / window / stationary, 1.0, 2e-3);
  EXPECT_NEAR(last_sum / window / stationary, 1.0, 2e-3);
  EXPECT_GT(largest_early, 1.9 * stationary);  // its maximum is about twice the mean
  // The amplitude neither decays nor grows: both maxima include many beats of the same waves.
  EXPECT_NEAR(largest_late / largest_early, 1.0, 0.005);
  EXPECT_LT(run.balance().relative, 1e-12);
}

}  // namespace rondo::test
