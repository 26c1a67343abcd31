// SPDX-License-Identifier: BSD-3-Clause
/// Output off the loop: how much may wait, rows that appear in time, errors that come back.
#include "rondo/output/recorder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>

#include "rondo/io/run_reader.hpp"
#include "rondo/mesh/disk.hpp"
#include "unit/case/case_fixture.hpp"
#include "unit/study/processes.hpp"

namespace recorder_test {

using namespace rondo;
using namespace rondo::study;

namespace {

namespace fs = std::filesystem;

class RecorderTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rondo-recorder-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Two columns, two snapshots of a small disk, one series.
  [[nodiscard]] RecordPlan plan() const {
    RecordPlan plan;
    plan.results = {.mesh = &mesh_, .mass = mass_, .n_snapshots = 2};
    plan.results.series = {{"/frame/share", "1", "a number of each snapshot"}};
    plan.columns = {{"time", "s", "time"}, {"x_m", "m", "place"}};
    plan.n_rows = 100;
    return plan;
  }
  static void add(Recorder& recorder, double time) {
    recorder.add_row(std::vector<double>{time, 2.0 * time});
  }
  void add_snapshot(Recorder& recorder, double time) const {
    Snapshot& s = recorder.next_snapshot();
    s = {};
    s.time = s.time_velocity = time;
    s.u = std::vector<Vec2>(mesh_.n_nodes(), Vec2{time, 0.0});
    s.v = Field(mesh_.n_nodes(), 2);
    s.series = {7.0 + time};
    recorder.add_snapshot();
  }
  [[nodiscard]] std::ptrdiff_t lines(const char* name) const {
    const std::string text = test::file_text(folder_ / name);
    return std::count(text.begin(), text.end(), '\n');
  }

  fs::path folder_;
  mesh::Mesh mesh_ = [] {
    mesh::Disk disk;
    disk.radial = 1;
    disk.circumferential = 8;
    return mesh::make_disk(disk);
  }();
  std::vector<double> mass_ = std::vector<double>(mesh_.n_nodes(), 1.0);
};

}  // namespace

TEST_F(RecorderTest, AsManySnapshotsWaitAsMemoryAllowsAndAreOfUse) {
  constexpr std::size_t mega = 1'000'000;
  EXPECT_EQ(queue_length(400, 100'000), 408U);    // all, and some rows between them
  EXPECT_EQ(queue_length(400, mega), 64U);        // 64 MB
  EXPECT_EQ(queue_length(400, 1000 * mega), 2U);  // one is written, one waits
  EXPECT_EQ(queue_length(100'000, 1000), 512U);   // not far behind the run
  EXPECT_EQ(queue_length(0, 1000), 8U);           // rows alone
}

/// Nobody calls for the row: it is there because time goes by.
TEST_F(RecorderTest, ARowAppearsWithoutASnapshotOrFurtherRows) {
  FileRecorder recorder(folder_, plan());
  add(recorder, 0.5);
  EXPECT_TRUE(holds_soon([&] {
    recorder.keep_up();
    return lines("history.csv") == 2;
  }));
}

TEST_F(RecorderTest, ASnapshotBringsTheRowsBeforeIt) {
  FileRecorder recorder(folder_, plan());
  add_snapshot(recorder, 0.0);
  for (int k = 1; k <= 5; ++k) add(recorder, k);
  add_snapshot(recorder, 5.0);
  EXPECT_TRUE(holds_soon([&] { return lines("history.csv") == 6; }));
  recorder.close();
  EXPECT_EQ(recorder.written(), 2U);
  EXPECT_EQ(recorder.last_time(), 5.0);
  EXPECT_GT(recorder.cost().write_wall_s, 0.0);
  EXPECT_GT(recorder.cost().wait_wall_s, 0.0);
}

TEST_F(RecorderTest, RowsNotYetHandedOverAreWrittenWhereTheRunBreaksOff) {
  {
    FileRecorder recorder(folder_, plan());
    for (int k = 1; k <= 5; ++k) add(recorder, k);
  }
  EXPECT_EQ(lines("history.csv"), 6);
  EXPECT_TRUE(test::file_text(folder_ / "history.csv").starts_with("time,x_m\n"));
}

TEST_F(RecorderTest, WhatTheFilesHoldIsSaidInTheUnitOfTheirTime) {
  RecordPlan share = plan();
  share.results.words.time_unit = "1";
  for (const RecordPlan& p : {plan(), share}) {
    FileRecorder recorder(folder_, p);
    add(recorder, 0.25);
    add_snapshot(recorder, 0.25);
    const bool is_time = p.results.words.time_unit == "s";
    EXPECT_EQ(recorder.kept(), is_time
                                   ? "kept are history.csv to t = 0.25 s and 1 snapshots"
                                   : "kept are history.csv to 0.25 of the load and 1 snapshots");
  }
}

TEST_F(RecorderTest, GoesOnWithTheTimeOfTheRowsThatAreKept) {
  RecordPlan rows_only = plan();
  rows_only.results.n_snapshots = 0;
  Checkpoint k;
  {
    FileRecorder recorder(folder_, rows_only);
    add(recorder, 1.5);
    add(recorder, 2.5);
    recorder.close();
    k.files = recorder.files();
  }
  FileRecorder again(folder_, rows_only, &k);
  again.close();
  EXPECT_EQ(again.last_time(), 2.5);
}

/// In a child process, whose files must not grow beyond some rows.
TEST_F(RecorderTest, AFullDiskIsThrownAtTheLoopAndTheRestIsClosed) {
  RecordPlan rows_only = plan();
  rows_only.results.n_snapshots = 0;
  EXPECT_EQ(in_process([&] {
              FileRecorder recorder(folder_, rows_only);
              std::signal(SIGXFSZ, SIG_IGN);
              const rlimit limit{20000, 20000};
              if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 1;
              try {
                for (long long k = 1; k < 10'000'000; ++k) {
                  add(recorder, static_cast<double>(k));
                  recorder.keep_up();
                }
                return 2;
              } catch (const FileError& error) {
                const std::string what = error.what();
                const std::string expected = "history.csv: cannot write: File too large";
                return what.find(expected) != std::string::npos ? 0 : 3;
              }
            }),
            0);
  const std::string text = test::file_text(folder_ / "history.csv");
  EXPECT_GT(text.size(), 19900U) << "as many rows as fit";
  EXPECT_TRUE(text.ends_with("\n")) << "complete ones";
}

TEST_F(RecorderTest, TakesRowsOfAsManyNumbersAsColumns) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto add_half_a_row = [&] {
    FileRecorder recorder(folder_, plan());
    recorder.add_row(std::vector<double>{1.0});
  };
  EXPECT_DEATH(add_half_a_row(), "rows_.size\\(\\) % n_columns_ == 0.*values: false 1 2");
}

TEST_F(RecorderTest, TakesNoSnapshotThatWasNotBegun) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto add_none = [&] { FileRecorder(folder_, plan()).add_snapshot(); };
  EXPECT_DEATH(add_none(), "has_snapshot");
}

}  // namespace recorder_test
