// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/files/regular_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <list>

#include "rondo/core/error.hpp"
#include "rondo/core/files/removed_at_signal.hpp"

namespace rondo::regular_file_test {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "rondo-core-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path make(const std::string& name) {
    std::ofstream(folder_ / name) << "text";
    return folder_ / name;
  }

  fs::path folder_;
};

TEST_F(Files, OtherThingsThanRegularFilesAreNamed) {
  const fs::path file = make("file"), fifo = folder_ / "fifo", link = folder_ / "link";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  fs::create_symlink(file, link);
  EXPECT_EQ(kind_of_no_file(file), "");
  EXPECT_EQ(kind_of_no_file(link), "");
  EXPECT_EQ(kind_of_no_file(folder_ / "none"), "");
  EXPECT_EQ(kind_of_no_file(fifo), "a FIFO");
  EXPECT_EQ(kind_of_no_file(folder_), "a directory");
  EXPECT_EQ(kind_of_no_file("/dev/zero"), "a device");
  EXPECT_NO_THROW(demand_regular_file(file));
  try {
    demand_regular_file(fifo);
    FAIL() << "a FIFO is taken";
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()), fifo.string() + ": is a FIFO, not a regular file");
  }
}

TEST_F(Files, WhatIsListedIsRemovedFoldersAfterTheirFiles) {
  const fs::path folder = folder_ / "made";
  fs::create_directory(folder);
  const fs::path inside = make("made/file"), kept = make("kept");
  { const RemovedAtSignal no_more(kept); }
  const RemovedAtSignal first(folder), second(inside);
  remove_at_signal();
  EXPECT_FALSE(fs::exists(folder));
  EXPECT_TRUE(fs::exists(kept));
}

TEST_F(Files, AChildRemovesNothingOfItsParent) {
  const fs::path file = make("file");
  const RemovedAtSignal listed(file);
  const pid_t child = ::fork();
  if (child == 0) {
    remove_at_signal();
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(fs::exists(file));
}

TEST_F(Files, MoreThanThereIsRoomForAreLeftOut) {
  std::list<RemovedAtSignal> listed;
  for (int k = 0; k < 100; ++k) listed.emplace_back(make(std::to_string(k)));
  remove_at_signal();
  EXPECT_FALSE(fs::exists(folder_ / "0"));
  EXPECT_TRUE(fs::exists(folder_ / "99"));
  const RemovedAtSignal long_one(std::string(5000, 'x'));
}

}  // namespace
}  // namespace rondo::regular_file_test
