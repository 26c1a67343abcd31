// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/limits/processors.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <thread>

namespace processors_test {

using namespace rondo;

namespace {

namespace fs = std::filesystem;

/// A tree as of /sys/fs/cgroup, for as long as this lives.
class Groups {
 public:
  Groups() : root_(fs::temp_directory_path() / ("rondo-cgroup-" + std::to_string(getpid()))) {}
  ~Groups() { fs::remove_all(root_); }
  Groups(const Groups&) = delete;
  Groups& operator=(const Groups&) = delete;
  [[nodiscard]] const fs::path& root() const { return root_; }
  void put(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }

 private:
  fs::path root_;
};

}  // namespace

TEST(Processors, QuotaOfText) {
  EXPECT_EQ(quota_of("150000 100000\n"), 1.5);
  EXPECT_EQ(quota_of("400000 100000"), 4.0);
  for (const char* none :
       {"max 100000\n", "-1\n 100000\n", "", " ", "100000", "0 100000", "100000 0", "12x 100000"})
    EXPECT_EQ(quota_of(none), std::nullopt) << none;
}

TEST(Processors, QuotaOfVersion2IsTheLeastOfTheGroupsAbove) {
  const Groups groups;
  groups.put("cgroup.controllers", "cpu");
  EXPECT_EQ(least_quota("0::/a/b\n", groups.root()), std::nullopt);
  groups.put("a/b/cpu.max", "max 100000\n");
  groups.put("a/cpu.max", "200000 100000\n");
  EXPECT_EQ(least_quota("0::/a/b\n", groups.root()), 2.0);
  groups.put("a/b/cpu.max", "300000 100000\n");
  EXPECT_EQ(least_quota("0::/a/b\n", groups.root()), 2.0);
  groups.put("a/b/cpu.max", "50000 100000\n");
  EXPECT_EQ(least_quota("0::/a/b\n", groups.root()), 0.5);
  EXPECT_EQ(least_quota("0::/\n", groups.root()), std::nullopt);
  groups.put("cpu.max", "100000 100000\n");  // as in a container that sees its own group as "/"
  EXPECT_EQ(least_quota("0::/\n", groups.root()), 1.0);
}

TEST(Processors, QuotaOfVersion1) {
  const Groups groups;
  groups.put("cpu,cpuacct/docker/x/cpu.cfs_quota_us", "250000\n");
  groups.put("cpu,cpuacct/docker/x/cpu.cfs_period_us", "100000\n");
  groups.put("cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  groups.put("cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  const std::string lines = "12:memory:/docker/x\n4:cpu,cpuacct:/docker/x\n1:name=systemd:/y\n";
  EXPECT_EQ(least_quota(lines, groups.root()), 2.5);
  EXPECT_EQ(least_quota("3:cpuset:/docker/x\n", groups.root()), std::nullopt);
  EXPECT_EQ(least_quota("no lines of groups", groups.root()), std::nullopt);
}

TEST(Processors, AtMostThoseOfTheAffinity) {
  cpu_set_t all;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  EXPECT_GE(allowed_processors(), 1);
  EXPECT_LE(allowed_processors(), CPU_COUNT(&all));
  std::thread([&] {  // which has an affinity of its own
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int k = 0; k < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++k)
      if (CPU_ISSET(k, &all)) CPU_SET(k, &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    EXPECT_EQ(allowed_processors(), 1);
  })
      .join();
}

}  // namespace processors_test
