// SPDX-License-Identifier: BSD-3-Clause
/// Slopes of nominal stresses against closed forms, and where laws stop being stable.
#include "rondo/case/rubber/stable_range.hpp"

#include <gtest/gtest.h>

namespace rondo::study::stable_range_test {
namespace {

using fem::Rubber;
using fem::RubberLaw;

const Rubber neo_hooke{.law = RubberLaw::neo_hooke, .c10 = 0.5, .terms = {}, .branches = {}};
const Rubber mooney{
    .law = RubberLaw::mooney_rivlin, .c10 = 0.4, .c01 = 0.1, .terms = {}, .branches = {}};
const Rubber yeoh{
    .law = RubberLaw::yeoh, .c10 = 0.5, .c20 = -0.02, .c30 = 0.01, .terms = {}, .branches = {}};
const Rubber treloar{
    .law = RubberLaw::ogden, .terms = {{0.63, 1.3}, {0.0012, 5.0}, {-0.01, -2.0}}, .branches = {}};

constexpr double uniaxial[3] = {1.0, -0.5, -0.5}, equibiaxial[3] = {1.0, 1.0, -2.0},
                 planar[3] = {1.0, 0.0, -1.0};

/// From stretch 1, where there is none, by Simpson's rule.
double stress(const Rubber& rubber, const double (&powers)[3], double stretch) {
  constexpr int n = 400;
  const double h = (stretch - 1.0) / n;
  double sum = 0.0;
  for (int k = 0; k <= n; ++k)
    sum += (k == 0 || k == n ? 1.0
            : k % 2 == 1     ? 4.0
                             : 2.0) *
           stress_slope(rubber, powers, 1.0 + k * h);
  return sum * h / 3.0;
}

/// Of two equal stresses the slope is that of the sum.
TEST(StableRange, SlopesAreThoseOfTheClosedForms) {
  EXPECT_NEAR(stress(neo_hooke, uniaxial, 2.0), 1.75, 1e-6);
  EXPECT_NEAR(stress(mooney, uniaxial, 2.0), 1.575, 1e-6);
  EXPECT_NEAR(stress(yeoh, uniaxial, 2.0), 1.89, 1e-6);
  EXPECT_NEAR(stress(treloar, uniaxial, 2.0), 0.602722, 1e-6);
  EXPECT_NEAR(stress(neo_hooke, equibiaxial, 1.5), 2.0 * 1.368313, 2e-6);
  EXPECT_NEAR(stress(mooney, equibiaxial, 1.5), 2.0 * 1.710391, 2e-6);
  EXPECT_NEAR(stress(yeoh, equibiaxial, 1.5), 2.0 * 1.419069, 2e-6);
  EXPECT_NEAR(stress(treloar, equibiaxial, 1.5), 2.0 * 0.601980, 2e-6);
  EXPECT_NEAR(stress(neo_hooke, planar, 0.5), 0.5 - 8.0, 1e-6);  // λ - λ⁻³
}

TEST(StableRange, UsualLawsAreStable) {
  for (const Rubber& rubber : {neo_hooke, mooney, yeoh, treloar})
    EXPECT_FALSE(find_unstable(rubber)) << static_cast<int>(rubber.law);
}

/// A Yeoh law without c30; in uniaxial tension P = 2 (λ - λ⁻²) (c10 + 2 c20 (I₁ - 3)).
TEST(StableRange, AFallingStressIsFound) {
  Rubber falling = yeoh;
  falling.c20 = -0.05;
  falling.c30 = 0.0;
  const auto slope = [&](double x) {
    const auto p = [&](double l) {
      return 2.0 * (l - 1.0 / (l * l)) *
             (falling.c10 + 2.0 * falling.c20 * (l * l + 2.0 / l - 3.0));
    };
    return (p(x + 1e-5) - p(x - 1e-5)) / 2e-5;
  };
  for (const double stretch : {0.6, 1.3, 1.9})
    EXPECT_NEAR(stress_slope(falling, uniaxial, stretch), slope(stretch), 1e-8);
  const auto found = find_unstable(falling);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->test, "equibiaxial");
  EXPECT_NEAR(found->stretch, 1.414, 0.005);
}

TEST(StableRange, ANegativeTermMayMakeItUnstable) {
  Rubber ogden = treloar;
  ogden.terms.push_back({-0.2, 2.0});
  EXPECT_FALSE(find_unstable(ogden));
  ogden.terms.back().modulus = -0.35;
  const auto found = find_unstable(ogden);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->test, "equibiaxial");
  EXPECT_NEAR(found->stretch, 0.82, 0.005);
  ogden.terms = {{1.0, 1000.0}, {-1.0, 900.0}};  // beyond numbers
  EXPECT_TRUE(find_unstable(ogden));
}

}  // namespace
}  // namespace rondo::study::stable_range_test
