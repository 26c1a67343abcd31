// SPDX-License-Identifier: BSD-3-Clause
/// Rubber in a case: what the parameters of each model become, what a region takes from [material].
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::rubber_case_test {
namespace {

using namespace test;

const std::string neo = "model = 'neo-hooke'\nshear_modulus = 1e6";

void expect_same_when_read_again(const Case& c) {
  EXPECT_EQ(write_case(read_text(write_case(c))), write_case(c));
}

/// E and ν are those of small strain, κ = 2μ(1 + ν)/(3(1 - 2ν)).
TEST(RubberCase, NeoHookeByPoissonsRatio) {
  const Case c = read_text(rubber(neo));
  ASSERT_TRUE(c.material.rubber);
  const fem::Rubber& r = *c.material.rubber;
  EXPECT_EQ(r.law, fem::RubberLaw::neo_hooke);
  EXPECT_EQ(r.c10, 5e5);
  EXPECT_EQ(r.shear_modulus(), 1e6);
  EXPECT_NEAR(r.bulk_modulus, 2e6 * 1.49 / 0.06, 1e-7);
  EXPECT_EQ(c.material.poissons_ratio, 0.49);
  EXPECT_EQ(c.material.youngs_modulus, 2.98e6);
  EXPECT_EQ(c.material.integration, fem::Integration::b_bar);
  EXPECT_FALSE(r.one_point);
  EXPECT_TRUE(r.branches.empty());
  EXPECT_TRUE(has_rubber(c));
  expect_same_when_read_again(c);
}

TEST(RubberCase, BulkModulusGivesPoissonsRatio) {
  const Case c = read_text(rubber(neo, "bulk_modulus = 1e8"));
  EXPECT_EQ(c.material.rubber->bulk_modulus, 1e8);
  EXPECT_NEAR(c.material.poissons_ratio, 298.0 / 602.0, 1e-15);
  EXPECT_NEAR(c.material.youngs_modulus, 9.0 * 1e8 * 1e6 / 3.01e8, 1e-8);
  EXPECT_EQ(write_case(c).find("poissons_ratio"), std::string::npos);
  expect_same_when_read_again(c);
}

TEST(RubberCase, CoefficientsOfTheOtherModels) {
  const Case mooney = read_text(rubber("model = 'mooney-rivlin'\nc10 = 4e5\nc01 = 1e5"));
  EXPECT_EQ(mooney.material.rubber->law, fem::RubberLaw::mooney_rivlin);
  EXPECT_EQ(mooney.material.rubber->c10, 4e5);
  EXPECT_EQ(mooney.material.rubber->c01, 1e5);
  EXPECT_EQ(mooney.material.rubber->shear_modulus(), 1e6);
  const Case yeoh = read_text(rubber("model = 'yeoh'\nc10 = 5e5\nc20 = -2e4\nc30 = 1e4"));
  EXPECT_EQ(yeoh.material.rubber->law, fem::RubberLaw::yeoh);
  EXPECT_EQ(yeoh.material.rubber->c20, -2e4);
  EXPECT_EQ(yeoh.material.rubber->c30, 1e4);
  const Case ogden =
      read_text(rubber("model = 'ogden'\nterms = [[6.3e5, 1.3], [1.2e3, 5], [-1e4, -2]]"));
  EXPECT_EQ(ogden.material.rubber->law, fem::RubberLaw::ogden);
  ASSERT_EQ(ogden.material.rubber->terms.size(), 3U);
  EXPECT_EQ(ogden.material.rubber->terms[2].exponent, -2.0);
  EXPECT_NEAR(ogden.material.rubber->shear_modulus(), 422500.0, 1e-9);
  for (const Case* c : {&mooney, &yeoh, &ogden}) expect_same_when_read_again(*c);
}

TEST(RubberCase, BranchesAndOnePoint) {
  const Case c = read_text(rubber(neo + "\nintegration = 'one-point'") +
                           "[[material.viscosity]]\nrelative_modulus = 0.3\ntime = 1e-3\n"
                           "[[material.viscosity]]\nrelative_modulus = 0.2\ntime = 1e-2\n");
  const fem::Rubber& r = *c.material.rubber;
  EXPECT_TRUE(r.one_point);
  EXPECT_EQ(c.material.integration, fem::Integration::b_bar);
  ASSERT_EQ(r.branches.size(), 2U);
  EXPECT_EQ(r.branches[1].relative_modulus, 0.2);
  EXPECT_EQ(r.branches[0].time, 1e-3);
  EXPECT_EQ(r.instantaneous(), 1.5);
  EXPECT_EQ(c.material.youngs_modulus, 2.98e6);  // long-term
  expect_same_when_read_again(c);
}

/// A belt that is linear, a tread that differs in some of it.
TEST(RubberCase, RegionsTakeWhatIsOfTheirModel) {
  const Case c = read_text(
      rubber(neo, "bulk_modulus = 1e8") +
      "[[material.viscosity]]\nrelative_modulus = 0.3\ntime = 1e-3\n"
      "[[material.region]]\nlayers = [1]\nmodel = 'linear'\nyoungs_modulus = 2e9\n"
      "poissons_ratio = 0.3\n"
      "[[material.region]]\nlayers = [2]\nshear_modulus = 2e6\n"
      "[[material.region]]\nlayers = [3]\npoissons_ratio = 0.48\nviscosity = []\n"
      "[[material.region]]\nlayers = [4]\nmodel = 'yeoh'\nc10 = 5e5\nc20 = -2e4\nc30 = 1e4\n"
      "poissons_ratio = 0.48\n");
  const auto& of = c.regions;
  EXPECT_FALSE(of[0].material.rubber);
  EXPECT_EQ(of[0].material.integration, fem::Integration::full);
  EXPECT_EQ(of[0].material.density, 1100.0);
  EXPECT_EQ(of[1].material.rubber->c10, 1e6);
  EXPECT_EQ(of[1].material.rubber->bulk_modulus, 1e8);
  EXPECT_EQ(of[1].material.rubber->branches.size(), 1U);
  EXPECT_EQ(of[2].material.rubber->c10, 5e5);
  EXPECT_EQ(of[2].material.poissons_ratio, 0.48);
  EXPECT_NEAR(of[2].material.rubber->bulk_modulus, 2e6 * 1.48 / 0.12, 1e-7);
  EXPECT_TRUE(of[2].material.rubber->branches.empty());
  EXPECT_TRUE(of[3].material.rubber->branches.empty());
  EXPECT_EQ(of[3].material.rubber->c30, 1e4);
  expect_same_when_read_again(c);
}

TEST(RubberCase, ARegionBesideALinearMaterial) {
  const std::vector<std::string> tread{
      "material.region=[{layers = [12], model = 'neo-hooke', shear_modulus = 1e6, bulk_modulus = "
      "1e8, viscosity = [[0.3, 1e-3]]}]"};
  const Case c = read_text(base, tread);
  EXPECT_TRUE(has_rubber(c));
  EXPECT_FALSE(c.material.rubber);
  EXPECT_EQ(c.regions[0].material.rubber->branches.at(0).time, 1e-3);
  EXPECT_EQ(c.regions[0].material.integration, fem::Integration::b_bar);
  expect_same_when_read_again(c);
}

/// Of bodies that are linear nothing is written that was not before.
TEST(RubberCase, LinearCasesAreWrittenAsTheyWere) {
  EXPECT_EQ(write_case(read_text(base)).find("model"), std::string::npos);
  EXPECT_EQ(read_text(base).material.integration, fem::Integration::full);
}

/// Not where the step or the safety is given.
TEST(RubberCase, TakesStepsOfItsOwn) {
  std::string text = with_line(35, "", rubber(neo));
  ASSERT_EQ(text.find("safety"), std::string::npos);
  EXPECT_EQ(read_text(text).time.safety, rubber_safety);
  EXPECT_EQ(read_text(text, {"time.safety=0.5"}).time.safety, 0.5);
  EXPECT_TRUE(read_text(text, {"time.step=1e-6"}).time.step);
  EXPECT_EQ(read_text(with_line(34, "")).time.safety, 0.8);
}

/// As of other keys that exclude each other.
TEST(RubberCase, ASettingTakesThePlaceOfItsRival) {
  EXPECT_EQ(read_text(rubber(neo), {"material.bulk_modulus=1e8"}).material.rubber->bulk_modulus,
            1e8);
  const Case c = read_text(rubber(neo, "bulk_modulus = 1e8"), {"material.poissons_ratio=0.48"});
  EXPECT_EQ(c.material.poissons_ratio, 0.48);
  EXPECT_FALSE(c.law.bulk_modulus);
  const auto both =
      faults_of(rubber(neo, ""), {"material.bulk_modulus=1e8", "material.poissons_ratio=0.48"});
  ASSERT_EQ(both.size(), 1U);
  EXPECT_EQ(both[0].key, "material.bulk_modulus");
}

}  // namespace
}  // namespace rondo::study::rubber_case_test
