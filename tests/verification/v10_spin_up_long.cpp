// SPDX-License-Identifier: BSD-3-Clause
/// V10, long times: a million steps without damping, by both operators.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rondo/statics/stationary_spin.hpp"
#include "support/models.hpp"
#include "support/stepping.hpp"

using namespace rondo;
using namespace rondo::dynamics;

namespace {
class SpinUpLong : public testing::TestWithParam<StiffnessOperator> {};
}  // namespace

TEST_P(SpinUpLong, OscillatesAboutTheStationarySpinForEver) {
  const auto b = test::build(test::rubber_annulus(4, 24));
  const auto exact = statics::stationary_spin(b.model.stiffness, b.model.mass, b.model.reference,
                                              b.model.free, -50.0);
  const double stationary = -exact.u[4].y;  // top of column 0, straight down: -y is outwards
  test::Stepping run(b, GetParam());
  const double period = 2.0 * std::numbers::pi / 475.0;  // the slowest axisymmetric wave
  const auto window = static_cast<int>(std::lround(200.0 * period / b.model.dt));
  double first_sum = 0.0, largest_early = 0.0, largest_late = 0.0, last_sum = 0.0;
  const int steps = 1000000;
  for (int n = 1; n <= steps; ++n) {
    run.advance();
    const double u = -run.state().u[4].y;
    if (n <= window) {
      first_sum += u;
      largest_early = std::max(largest_early, u);
    }
    if (n > steps - window) {
      last_sum += u;
      largest_late = std::max(largest_late, u);
    }
  }
  // The mean over 200 periods leaves at most 1/(2π 200) = 0.08 % of the amplitude, which is about
  // the mean itself.
  RecordProperty("first_mean", fmt::format("{:.6f}", first_sum / window / stationary));
  RecordProperty("last_mean", fmt::format("{:.6f}", last_sum / window / stationary));
  RecordProperty("maxima", fmt::format("{:.6f}", largest_late / largest_early));
  RecordProperty("relative", fmt::format("{:.2g}", run.balance().relative));
  EXPECT_NEAR(first_sum / window / stationary, 1.0, 2e-3);
  EXPECT_NEAR(last_sum / window / stationary, 1.0, 2e-3);
  EXPECT_GT(largest_early, 1.9 * stationary);  // it swings to about twice the mean
  // The amplitude neither decays nor grows: both maxima are over many beats of the same waves.
  EXPECT_NEAR(largest_late / largest_early, 1.0, 0.005);
  EXPECT_LT(run.balance().relative, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Both, SpinUpLong, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });
