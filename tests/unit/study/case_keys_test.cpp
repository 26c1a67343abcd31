// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/case_keys.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rondo/study/estimate.hpp"
#include "rondo/study/memory_limits.hpp"
#include "unit/study/case_fixture.hpp"

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

TEST(CaseKeys, ManualHasEveryKey) {
  const std::string manual = file_text(source_folder() / "docs" / "cases.md");
  ASSERT_FALSE(manual.empty());
  for (const CaseKey& key : case_keys()) {
    const auto row = fmt::format("\n| `{}` | {} | {} | {} | {} | ", key.path, type_text(key),
                                 key.unit, allowed_text(key), key.standard);
    EXPECT_NE(manual.find(row), std::string::npos) << row;
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
  EXPECT_EQ(count, 4);
}

TEST(Estimate, CountsNodesAndCells) {
  Case c = read_text(base, {"motion.angular_velocity=0.0", "output.snapshots=0"});
  EXPECT_EQ(n_disk_cells(c.disk), 12U * 180U);
  constexpr std::size_t program = 30'000'000;
  const std::size_t still = estimated_memory(c, size_of(c.disk)) - program;
  EXPECT_EQ(still, 13U * 180U * (2 * 9 * 36 + 368) + 12U * 180U * 16U);
  c.initial.state = InitialState::stationary;  // needs the factors of K
  EXPECT_GT(estimated_memory(c, size_of(c.disk)) - program, 2 * still);
  c.initial.state = InitialState::rest;
  c.output.snapshots = 7;  // all of them may wait to be written
  EXPECT_EQ(estimated_memory(c, size_of(c.disk)) - program, still + 7U * 13U * 180U * 32U);
  c.output.snapshots = 100'000;
  EXPECT_LE(estimated_memory(c, size_of(c.disk)) - program, still + 64'000'000U);
  c.analysis = {AnalysisKind::crush, 0.02, 10};
  EXPECT_GT(estimated_memory(c, size_of(c.disk)) - program, 2 * still);
  c = read_text(treaded());
  EXPECT_EQ(n_disk_cells(c.disk), mesh::make_disk(c.disk).cells.size());
}

TEST(Estimate, ReadableBytes) {
  EXPECT_EQ(readable_bytes(0), "0 B");
  EXPECT_EQ(readable_bytes(999), "999 B");
  EXPECT_EQ(readable_bytes(512'000'000), "512 MB");
  EXPECT_EQ(readable_bytes(1'840'000'000'000), "1.84 TB");
  EXPECT_GT(physical_memory(), 0U);
}

TEST(Estimate, BytesInAText) {
  EXPECT_EQ(bytes_in("2GB"), 2'000'000'000U);
  EXPECT_EQ(bytes_in("2.5 gb"), 2'500'000'000U);
  EXPECT_EQ(bytes_in("1.5GiB"), 1'610'612'736U);
  EXPECT_EQ(bytes_in("64k"), 64'000U);
  EXPECT_EQ(bytes_in("100B"), 100U);
  EXPECT_EQ(bytes_in("100"), 100U);
  for (const char* wrong : {"", "much", "-5", "0", "nan", "inf", "2XB", "2GBs", "1e30GB", "GB"})
    EXPECT_FALSE(bytes_in(wrong).has_value()) << wrong;
}

}  // namespace
}  // namespace rondo::study
