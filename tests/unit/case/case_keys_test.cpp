// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_keys.hpp"

#include <gtest/gtest.h>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::case_keys_test {
namespace {

using namespace test;

TEST(CaseKeys, NearestKey) {
  EXPECT_EQ(nearest_key("ground.frction"), "ground.friction");
  EXPECT_EQ(nearest_key("friction"), "ground.friction");
  EXPECT_EQ(nearest_key("damping.friction"), "ground.friction");
  EXPECT_EQ(nearest_key("disk.radial"), "disk.mesh.radial");
  EXPECT_EQ(nearest_key("material.young_modulus"), "material.youngs_modulus");
  EXPECT_EQ(nearest_key("material.Density"), "material.density");
  EXPECT_EQ(nearest_key("motion.hieght"), "motion.height");
  EXPECT_EQ(nearest_key("outer_radus"), "disk.outer_radius");
  EXPECT_EQ(nearest_key("grond"), "ground");
  EXPECT_EQ(nearest_key("tread"), "disk.tread");
  EXPECT_EQ(nearest_key("velocity"), "initial.velocity");
  EXPECT_EQ(nearest_key("time.dt"), "");
  EXPECT_EQ(nearest_key("ground.colour"), "");
  EXPECT_EQ(nearest_key(std::string(100000, 'a')), "");
}

TEST(CaseKeys, Synonyms) {
  EXPECT_EQ(meant_text("ground.mu"), "did you mean ground.friction?");
  EXPECT_EQ(meant_text("contact.mu"), "did you mean contact.friction?");
  EXPECT_EQ(meant_text("mu"), "did you mean ground.friction?");
  EXPECT_EQ(meant_text("material.region[2].nu"), "did you mean material.region[].poissons_ratio?");
  EXPECT_EQ(meant_text("initial.omega"), "did you mean initial.angular_velocity?");
  EXPECT_EQ(meant_text("motion.velocity"), "did you mean motion.speed?");
  EXPECT_EQ(meant_text("ground.frction"), "did you mean ground.friction?");
  EXPECT_EQ(meant_text("ground.colour"), "");
  EXPECT_NE(meant_text("motion.load").find("rim.force_y"), std::string::npos);
  EXPECT_EQ(meant_text("motion.force_y"), "did you mean rim.force_y?");
  EXPECT_EQ(meant_text("rim.moment"), "did you mean rim.torque?");
  EXPECT_EQ(meant_text("rim.spring"), "did you mean rim.support.y.stiffness?");
  EXPECT_EQ(meant_text("rim.support.x.spring"), "did you mean rim.support.x.stiffness?");
  EXPECT_EQ(meant_text("ground.incline"), "did you mean motion.slope?");
  for (const Synonym& synonym : synonyms_of_keys()) {
    EXPECT_NE(synonym.key.empty(), synonym.instead.empty()) << synonym.word;
    EXPECT_TRUE(synonym.key.empty() || find_case_key(synonym.key) != nullptr) << synonym.key;
    for (const CaseKey& key : case_keys()) EXPECT_FALSE(key.path == synonym.word) << synonym.word;
  }
}

/// The examples of the manual are good cases; the fragments are too short to be one.
TEST(CaseKeys, ExamplesOfTheManualAreCases) {
  const std::string manual = file_text(source_folder() / "docs" / "cases.md");
  int count = 0;
  for (auto at = manual.find("```toml\nschema"); at != std::string::npos;
       at = manual.find("```toml\nschema", at + 1)) {
    const auto begin = at + 8;
    const std::string text = manual.substr(begin, manual.find("```", begin) - begin);
    SCOPED_TRACE(text);
    EXPECT_NO_THROW(read_text(text));
    ++count;
  }
  EXPECT_EQ(count, 5);
}

}  // namespace
}  // namespace rondo::study::case_keys_test
