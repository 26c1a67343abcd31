// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/limits/memory_limits.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace memory_limits_test {

using namespace rondo;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// A folder that looks like /sys/fs/cgroup.
class ControlGroups : public testing::Test {
 protected:
  void SetUp() override {
    mount_ = fs::temp_directory_path() / ("rondo-groups-" + std::to_string(getpid()));
  }
  void TearDown() override { fs::remove_all(mount_); }

  void put(const std::string& file, const std::string& text) const {
    fs::create_directories((mount_ / file).parent_path());
    std::ofstream(mount_ / file) << text << '\n';
  }

  fs::path mount_;
};

}  // namespace

TEST_F(ControlGroups, TheLeastOfAGroupAndThoseAboveItCounts) {
  put("a/memory.max", "2000000000");
  put("a/b/memory.max", "max");
  put("a/b/c/memory.max", "3000000000");
  put("other/memory.max", "1");
  EXPECT_EQ(control_group_limit("0::/a/b/c\n", mount_), 2'000'000'000U);
  put("a/b/memory.max", "1500000000");
  EXPECT_EQ(control_group_limit("0::/a/b/c\n", mount_), 1'500'000'000U);
}

TEST_F(ControlGroups, BothVersions) {
  put("memory/x/memory.limit_in_bytes", "700000000");
  put("memory/memory.limit_in_bytes", "9223372036854771712");
  const std::string groups = "5:devices:/x\n4:cpu,memory:/x\n0::/\n";
  EXPECT_EQ(control_group_limit(groups, mount_), 700'000'000U);
  EXPECT_EQ(control_group_limit("5:devices:/x\n0::/\n", mount_), none);
  put("memory.max", "600000000");  // of a container's root
  EXPECT_EQ(control_group_limit(groups, mount_), 600'000'000U);
}

TEST_F(ControlGroups, NothingToReadIsNoLimit) {
  EXPECT_EQ(control_group_limit("", mount_), none);
  EXPECT_EQ(control_group_limit("rubbish\n:\n4:memory\n", mount_), none);
  EXPECT_EQ(control_group_limit("4:memory:/not/there\n0::/nor/this\n", mount_), none);
}

TEST(AllowedMemory, IsNeverMoreThanTheMachineHas) {
  const AllowedMemory allowed = allowed_memory();
  EXPECT_GT(allowed.bytes, 0U);
  EXPECT_LE(allowed.bytes, physical_memory());
  EXPECT_FALSE(allowed.source.empty());
}

}  // namespace memory_limits_test
