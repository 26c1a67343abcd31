// SPDX-License-Identifier: BSD-3-Clause
/// Relaxation lengths of forces over a distance.
#include "rondo/analysis/steady/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace relaxation_test {

using namespace rondo::study;

namespace {

struct Rolled {
  std::vector<double> distance, force;
};

/// Of a force that goes from 100 to -200 N.
template <class Share>
Rolled rolled(double step, int steps, Share share) {
  Rolled r;
  for (int n = 0; n <= steps; ++n) {
    r.distance.push_back(n * step);
    r.force.push_back(100.0 - 300.0 * share(n * step));
  }
  return r;
}

}  // namespace

TEST(Relaxation, OfAnExponentialIsItsLength) {
  const Rolled r = rolled(0.01, 300, [](double s) { return -std::expm1(-s / 0.5); });
  const Relaxation found = relaxation_of(r.distance, r.force, -200.0, 1e-3);
  EXPECT_EQ(found.before, 100.0);
  EXPECT_EQ(found.after, -200.0);
  ASSERT_TRUE(found.length && found.fitted);
  EXPECT_NEAR(*found.length, 0.5, 1e-4);  // linear between the rows
  EXPECT_NEAR(*found.fitted, 0.5, 1e-8);
  EXPECT_NEAR(found.share, -std::expm1(-6.0), 1e-12);
  EXPECT_TRUE(found.changes);
  EXPECT_LT(found.fit_error.value(), 1e-9);
}

/// A straight line reaches 1 - 1/e there, and is no exponential.
TEST(Relaxation, OfALineIsWhereItReachesItsShare) {
  const Rolled r = rolled(0.1, 10, [](double s) { return s; });
  const Relaxation found = relaxation_of(r.distance, r.force, -200.0, 1e-3);
  EXPECT_NEAR(found.length.value(), 1.0 - std::exp(-1.0), 1e-12);
  EXPECT_GT(found.fit_error.value(), 0.05);
}

TEST(Relaxation, IsNotThereBeforeItIsReached) {
  const Rolled r = rolled(0.01, 30, [](double s) { return -std::expm1(-s / 0.5); });
  const Relaxation found = relaxation_of(r.distance, r.force, -200.0, 1e-3);
  EXPECT_FALSE(found.length);
  EXPECT_NEAR(found.fitted.value(), 0.5, 1e-8);
  EXPECT_NEAR(found.share, -std::expm1(-0.6), 1e-12);
}

TEST(Relaxation, IsNotThereWithoutAChange) {
  const Rolled r = rolled(0.01, 30, [](double) { return 0.0; });
  const Relaxation found = relaxation_of(r.distance, r.force, 100.0 + 1e-4, 1e-3);
  EXPECT_FALSE(found.changes || found.length || found.fitted || found.fit_error);
  EXPECT_EQ(found.share, 0.0);
}

/// What is still, all but still, or goes back would take any length; what jumps, none.
TEST(Relaxation, HasNoFitBeyondTheSearch) {
  const auto found = [](auto share) {
    const Rolled r = rolled(0.01, 30, share);
    return relaxation_of(r.distance, r.force, -200.0, 1e-3);
  };
  for (const double part : {0.0, 0.02, -0.02}) {
    const Relaxation short_way = found([=](double s) { return part * s / 0.3; });
    EXPECT_TRUE(short_way.changes);
    EXPECT_FALSE(short_way.length || short_way.fitted || short_way.fit_error) << part;
  }
  const Relaxation jump = found([](double s) { return s > 0.0 ? 1.0 : 0.0; });
  EXPECT_NEAR(jump.length.value(), 0.01 * (1.0 - std::exp(-1.0)), 1e-12);
  EXPECT_FALSE(jump.fitted || jump.fit_error);
}

}  // namespace relaxation_test
