// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_keys.hpp"

#include <gtest/gtest.h>

#include "unit/case/case_fixture.hpp"

namespace rondo::study {
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
  EXPECT_EQ(count, 4);
}

}  // namespace
}  // namespace rondo::study
