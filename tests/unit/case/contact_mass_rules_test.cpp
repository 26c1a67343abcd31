// SPDX-License-Identifier: BSD-3-Clause
/// What contact nodes without mass are refused with, by a case alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::contact_mass_rules_test {
namespace {

using namespace test;

struct Refused {
  const char* name;
  std::vector<std::string> settings;
  std::string key;
  std::vector<std::string> fragments;
};

class ContactMass : public testing::TestWithParam<Refused> {};

TEST_P(ContactMass, IsRefusedWith) {
  std::vector<std::string> settings = GetParam().settings;
  settings.emplace_back("solver.contact_mass=singular");
  try {
    read_text(base, settings);
    FAIL() << "read";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1u) << error.what();
    const Fault& fault = error.faults().front();
    EXPECT_EQ(fault.key, GetParam().key);
    const std::string text = error.what();
    for (const std::string& fragment : GetParam().fragments)
      EXPECT_NE(text.find(fragment), std::string::npos) << fragment << " in " << text;
  }
}

const std::string key = "solver.contact_mass";

INSTANTIATE_TEST_SUITE_P(
    All, ContactMass,
    testing::Values(
        Refused{"restitution",
                {"ground.restitution=0.5"},
                key,
                {"restitution", "ground.restitution = 0"}},
        Refused{"sharp_corners", {"ground.fillet=0"}, key, {"sharp convex", "ground.fillet > 0"}},
        Refused{"as_printed", {"time.scheme=as-printed"}, key, {"time.scheme"}},
        Refused{"contact_of_bodies", {"contact.between=bodies"}, key, {"[contact]"}},
        Refused{"energy_safe", {"ground.impact=energy-safe"}, key, {"energy-safe", "gaps"}},
        Refused{"rim", {"rim.free=[]"}, key, {"[rim]"}}),
    [](const auto& p) { return p.param.name; });

TEST(ContactMassKey, WithoutGroundIsRefused) {
  const std::string text =
      "schema = 1\n[disk]\nouter_radius = 0.3\ninner_radius = 0.15\n[disk.mesh]\nradial = 3\n"
      "circumferential = 24\n[material]\nyoungs_modulus = 2e7\npoissons_ratio = 0.3\n"
      "density = 1100\n[motion]\nangular_velocity = 1\nspeed = 0\nheight = 1\n[time]\nend = 0.1\n"
      "[solver]\ncontact_mass = \"singular\"\n";
  try {
    read_text(text);
    FAIL() << "read";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1u) << error.what();
    EXPECT_EQ(error.faults().front().key, key);
    EXPECT_EQ(error.faults().front().line, 19);
    EXPECT_NE(std::string(error.what()).find("no [ground]"), std::string::npos);
  }
}

TEST(ContactMassKey, FlatGroundAndFilletsAreTaken) {
  for (const char* value : {"lumped", "singular", "singular-kept"})
    EXPECT_NO_THROW(read_text(base, {std::string("solver.contact_mass=") + value}));
  EXPECT_NO_THROW(
      read_text(base, {"solver.contact_mass=singular", "ground.profile=flat", "ground.fillet=0"}));
}

}  // namespace
}  // namespace rondo::study::contact_mass_rules_test
