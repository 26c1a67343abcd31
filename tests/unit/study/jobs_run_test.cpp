// SPDX-License-Identifier: BSD-3-Clause
/// Whole runs and decompositions as jobs: result files, factorisations and BLAS in forked
/// processes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rondo/analysis/run.hpp"
#include "rondo/study/pod/pod.hpp"
#include "unit/case/case_fixture.hpp"
#include "unit/study/jobs_fixture.hpp"

using namespace rondo;
using namespace rondo::study;

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> small = {"disk.mesh.radial=4", "disk.mesh.circumferential=60",
                                        "output.snapshots=40"};

std::vector<std::string> with(const std::string& setting) {
  std::vector<std::string> settings = small;
  settings.push_back(setting);
  return settings;
}

class JobsRun : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rondo-jobs-run-" + std::to_string(getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static JobReport run(const Case& c, const fs::path& directory, JobChannel& channel) {
    RunOptions options;
    options.directory = directory;
    options.threads = 1;
    options.stop = channel.stop();
    options.progress = [&](long long done, long long total) { channel.progress(done, total); };
    const RunReport report = run_case(c, options);
    switch (report.status) {
      case RunStatus::done:
        return {};
      case RunStatus::interrupted:
        return {job_interrupted, fmt::format("after {} steps", report.steps), {}};
      case RunStatus::failed:
        break;
    }
    return {job_failed, report.message, {}};
  }

  /// Two runs of different friction, a crush, and the decomposition of the first run.
  [[nodiscard]] std::vector<Job> jobs(const fs::path& folder) const {
    const fs::path crush = test::source_folder() / "cases" / "crush-smooth.toml";
    std::vector<std::string> crush_settings = small;
    crush_settings.back() = "analysis.increments=5";
    std::vector<Job> list;
    const auto add = [&](const std::string& name, const Case& c) {
      list.push_back(make_job(
          name, [c, folder, name](JobChannel& channel) { return run(c, folder / name, channel); }));
    };
    add("low", test::read_text(test::base, small));
    add("high", test::read_text(test::base, with("ground.friction=0.6")));
    add("crush", read_case(crush, crush_settings));
    list.push_back(make_job("pod", [folder](JobChannel&) {
      PodRequest request;
      request.runs = {folder / "low"};
      const PodReport report = run_pod(request);
      return JobReport{report.trouble.empty() ? 0 : 3, report.trouble, {}};
    }));
    list.back().after = {0};
    return list;
  }

  fs::path folder_;
};

}  // namespace

TEST_F(JobsRun, GiveTheSameFilesHoweverManyRunAtOnce) {
  for (const int n : {1, 4}) {
    const std::vector<Job> list = jobs(folder_ / std::to_string(n));
    for (const JobOutcome& outcome : run_jobs(list, at_once(n)))
      EXPECT_EQ(outcome.status, JobStatus::done) << outcome.message;
  }
  for (const char* name : {"low/history.csv", "high/history.csv", "crush/history.csv",
                           "low/pod/displacement-rotating/spectrum.csv"}) {
    const std::string text = test::file_text(folder_ / "1" / name);
    EXPECT_GT(text.size(), 500U) << name;
    EXPECT_TRUE(text == test::file_text(folder_ / "4" / name)) << name;
  }
  EXPECT_NE(test::file_text(folder_ / "1/low/history.csv"),
            test::file_text(folder_ / "1/high/history.csv"));
}

TEST_F(JobsRun, AStoppedRunLeavesReadableResultsAndAFailedOneItsReason) {
  std::vector<Job> list = jobs(folder_);
  list.erase(list.begin() + 1, list.end());
  const Case longer = test::read_text(test::base, with("time.end=1000.0"));
  list[0].work = [&](JobChannel& channel) { return run(longer, folder_ / "long", channel); };
  fs::create_directories(folder_);
  std::ofstream(folder_ / "blocked") << "a file where a directory is wanted";
  list.push_back(make_job("blocked", [&](JobChannel& channel) {
    return run(longer, folder_ / "blocked" / "run", channel);
  }));
  std::atomic<bool> stop{false};
  JobsOptions options = at_once(2);
  options.stop = &stop;
  options.progress = [&](const JobsProgress& p) {
    stop = p.ended == 1 && fs::exists(folder_ / "long" / "history.csv");
  };
  const std::vector<JobOutcome> outcomes = run_jobs(list, options);
  EXPECT_EQ(outcomes[0].status, JobStatus::interrupted) << outcomes[0].message;
  EXPECT_NE(test::file_text(folder_ / "long/run.json").find("\"status\": \"interrupted\""),
            std::string::npos);
  EXPECT_EQ(outcomes[1].status, JobStatus::failed);
  EXPECT_NE(outcomes[1].message.find((folder_ / "blocked").string()), std::string::npos)
      << outcomes[1].message;
}
