// SPDX-License-Identifier: BSD-3-Clause
/// Output off the loop: how much may wait, rows that appear in time, errors that come back.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>

#include "rondo/integrators/stepper.hpp"
#include "rondo/output/run_output.hpp"
#include "unit/case/case_fixture.hpp"
#include "unit/study/processes.hpp"

using namespace rondo;
using namespace rondo::study;

namespace {

namespace fs = std::filesystem;

class RunOutputTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rondo-run-output-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static Case small(const std::string& snapshots) {
    return test::read_text(test::base,
                           {"disk.mesh.radial=2", "disk.mesh.circumferential=24",
                            "output.history_interval=0", "output.snapshots=" + snapshots});
  }
  [[nodiscard]] std::ptrdiff_t lines(const char* name) const {
    const std::string text = test::file_text(folder_ / name);
    return std::count(text.begin(), text.end(), '\n');
  }

  fs::path folder_;
};

}  // namespace

TEST_F(RunOutputTest, AsManySnapshotsWaitAsMemoryAllowsAndAreOfUse) {
  constexpr std::size_t mega = 1'000'000;
  EXPECT_EQ(queue_length(400, 100'000), 408U);    // all, and some rows between them
  EXPECT_EQ(queue_length(400, mega), 64U);        // 64 MB
  EXPECT_EQ(queue_length(400, 1000 * mega), 2U);  // one is written, one waits
  EXPECT_EQ(queue_length(100'000, 1000), 512U);   // not far behind the run
  EXPECT_EQ(queue_length(0, 1000), 8U);           // rows alone
}

/// Nobody calls for the row: it is there because time goes by.
TEST_F(RunOutputTest, ARowAppearsWithoutASnapshotOrFurtherRows) {
  const Case c = small("0");
  const study::Setup setup = build(c, 1);
  const SnapshotSchedule schedule = snapshot_schedule(c.output, setup.model.dt, setup.n_steps);
  RunOutput output({folder_, c, setup, schedule});
  dynamics::StepReport step;
  step.frame.time = setup.model.dt;
  output.observe(step);
  EXPECT_TRUE(holds_soon([&] {
    output.keep_up();
    return lines("history.csv") == 2;
  }));
}

TEST_F(RunOutputTest, ASnapshotBringsTheRowsBeforeItAndStepsAreAskedForInTurn) {
  const Case c = small("3");
  const study::Setup setup = build(c, 1);
  const SnapshotSchedule schedule = snapshot_schedule(c.output, setup.model.dt, setup.n_steps);
  RunOutput output({folder_, c, setup, schedule});
  dynamics::State state = dynamics::start(setup.model, setup.displacement, setup.velocity);
  EXPECT_EQ(output.next_snapshot(), 0);
  output.observe(state);
  const long long next = output.next_snapshot();
  EXPECT_GT(next, 1);
  output.observe(state);  // not wanted: nothing comes of it
  dynamics::StepReport step;
  for (long long k = 1; k <= next; ++k) {
    step.frame.time = static_cast<double>(k) * setup.model.dt;
    output.observe(step);
  }
  state.step = next;
  output.observe(state);
  EXPECT_TRUE(holds_soon([&] { return lines("history.csv") == 1 + next; }));
  EXPECT_EQ(output.next_snapshot(), setup.n_steps);
  output.close();
  EXPECT_EQ(output.written(), 2U);
  EXPECT_GT(output.cost().write_wall_s, 0.0);
  EXPECT_GT(output.cost().wait_wall_s, 0.0);
}

TEST_F(RunOutputTest, RowsNotYetHandedOverAreWrittenWhereTheRunBreaksOff) {
  const Case c = small("0");
  const study::Setup setup = build(c, 1);
  {
    const SnapshotSchedule schedule = snapshot_schedule(c.output, setup.model.dt, setup.n_steps);
    RunOutput output({folder_, c, setup, schedule});
    dynamics::StepReport step;
    for (int k = 1; k <= 5; ++k) {
      step.frame.time = k * setup.model.dt;
      output.observe(step);
    }
  }
  EXPECT_EQ(lines("history.csv"), 6);
}

/// In a child process, whose files must not grow beyond some rows.
TEST_F(RunOutputTest, AFullDiskIsThrownAtTheLoopAndTheRestIsClosed) {
  const Case c = small("0");
  const study::Setup setup = build(c, 1);
  EXPECT_EQ(in_process([&] {
              const SnapshotSchedule schedule =
                  snapshot_schedule(c.output, setup.model.dt, setup.n_steps);
              RunOutput output({folder_, c, setup, schedule});
              std::signal(SIGXFSZ, SIG_IGN);
              const rlimit limit{20000, 20000};
              if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 1;
              dynamics::StepReport step;
              try {
                for (long long k = 1; k < 10'000'000; ++k) {
                  step.frame.time = static_cast<double>(k) * setup.model.dt;
                  output.observe(step);
                  output.keep_up();
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
  EXPECT_GT(text.size(), 19900U) << "as many rows as there is room for";
  EXPECT_TRUE(text.ends_with("\n")) << "complete ones";
}
