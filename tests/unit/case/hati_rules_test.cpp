// SPDX-License-Identifier: BSD-3-Clause
/// What time.scheme = "hati" refuses, each the one fault of an otherwise good case.
#include <gtest/gtest.h>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::hati_rules_test {
namespace {

using namespace test;

const std::vector<std::string> parts{"time.scheme=hati", "solver.hati.ratio=2",
                                     "solver.hati.fine.layers=[11, 12]"};

struct Refused {
  const char* name;
  std::string setting, key, fragment;
};

std::ostream& operator<<(std::ostream& out, const Refused& refused) {
  return out << refused.name;
}

class HatiRules : public testing::TestWithParam<Refused> {};

TEST(HatiCase, IsReadAndWritten) {
  const Case c = read_text(base, parts);
  ASSERT_TRUE(c.hati);
  EXPECT_EQ(c.hati->ratio, 2);
  EXPECT_EQ(c.hati->fine.layers, (std::vector<int>{11, 12}));
  EXPECT_EQ(c.time.scheme, Scheme::hati);
  EXPECT_EQ(write_case(read_text(write_case(c))), write_case(c));
}

/// A crush and steady rolling have no steps.
TEST(HatiCase, MeansNothingWithoutSteps) {
  std::vector<std::string> settings = parts;
  for (const char* setting :
       {"analysis.kind=crush", "analysis.depth=0.01", "analysis.increments=3"})
    settings.emplace_back(setting);
  settings.emplace_back("ground.profile=flat");
  const Case c = read_text(base, settings);
  EXPECT_FALSE(c.hati);
  EXPECT_EQ(c.time.scheme, Scheme::symplectic);
  ASSERT_FALSE(c.warnings.empty());
  EXPECT_NE(c.warnings.back().find("[solver.hati]"), std::string::npos) << c.warnings.back();
}

TEST_P(HatiRules, Refuse) {
  std::vector<std::string> settings = parts;
  settings.push_back(GetParam().setting);
  const std::vector<Fault> faults = faults_of(base, settings);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, GetParam().key);
  EXPECT_NE(faults[0].message.find(GetParam().fragment), std::string::npos) << faults[0].message;
  EXPECT_FALSE(faults[0].allowed.empty());
}

INSTANTIATE_TEST_SUITE_P(
    All, HatiRules,
    testing::Values(
        Refused{"SpinTable", "motion.angular_velocity=[[0, 30], [1, 31]]",
                "motion.angular_velocity", "varies"},
        Refused{"Rim", "rim.free=[]", "time.scheme", "a rim that forces move"},
        Refused{"SteadyStart", "initial.state=steady-rolling", "initial.state", "begins at t = 0"},
        Refused{"Pressure", "load.pressure=[{curve = 'tread', value = 3}]", "load.pressure[0]",
                "no load except the ground"},
        Refused{"Bodies", "contact.between=bodies", "contact.between", "with the ground"},
        Refused{"Implicit", "solver.implicit=[{layers = [1]}]", "solver.implicit[0]",
                "all elements that are not fine"},
        Refused{"Cyclic", "solver.operator=cyclic", "solver.operator", "step of its own"},
        Refused{"Region", "solver.hati.fine={region = 'skin'}", "solver.hati.fine.region",
                "no physical surfaces"},
        Refused{"Nothing", "solver.hati.fine={}", "solver.hati.fine", "no elements"},
        Refused{"Ratio", "solver.hati.ratio=0", "solver.hati.ratio", "out of bounds"}),
    [](const auto& p) { return p.param.name; });

/// The same angular velocity at two times is one.
TEST(HatiCase, TakesATableThatDoesNotVary) {
  std::vector<std::string> settings = parts;
  settings.emplace_back("motion.angular_velocity=[[0, 30], [1, 30]]");
  EXPECT_TRUE(faults_of(base, settings).empty());
}

}  // namespace
}  // namespace rondo::study::hati_rules_test
