// SPDX-License-Identifier: BSD-3-Clause
/// @file  Results of runs that are killed, watched, or out of room.
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <thread>

#include "rondo/core/complex.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/io/results.hpp"
#include "unit/io/support.hpp"

namespace rondo::io::test::results_failure_test {
namespace {

constexpr std::size_t planned = 40, written = 21;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

void expect_half(const Folder& folder, SmallRun& run) {
  const h5::File file = h5::File::open(folder / "results.h5");
  const auto time = file.read<double>("/frame/time");
  ASSERT_EQ(time.size(), planned);
  for (std::size_t k = 0; k < planned; ++k) EXPECT_EQ(std::isnan(time[k]), k >= written) << k;
  for (std::size_t k = 0; k < written; ++k) {
    const Snapshot s = run.snapshot(k);
    EXPECT_EQ(time[k], s.time);
    EXPECT_EQ(row_of<Vec2>(file.dataset("/snapshots/displacement"), k), points_of(s.u));
    EXPECT_EQ(row_of<Vec2>(file.dataset("/contact/force"), k),
              points_of(run.fields(k).contact_force));
    const auto position = row_of<std::array<float, 3>>(file.dataset("/fields/position"), k);
    const Vec2 x =
        s.center.plane() + rotation(s.angle) * (run.mesh.coordinates[5] + s.u.plane()[5]);
    EXPECT_EQ(position[5][0], static_cast<float>(x.x));
    EXPECT_EQ(position[5][1], static_cast<float>(x.y));
  }
  const h5::File vtk = h5::File::open(folder / "fields.vtkhdf");
  const auto steps = vtk.read<double>("/VTKHDF/Steps/Values");  // those of its last 0.1 s may lack
  ASSERT_TRUE(!steps.empty() && steps.size() <= written) << steps.size();
  for (std::size_t k = 0; k < steps.size(); ++k) EXPECT_EQ(steps[k], time[k]) << k;
  EXPECT_EQ(vtk.dataset("/VTKHDF/Points").shape()[1], 3U);
  const std::string text = text_of(folder / "fields.xdmf");
  EXPECT_LE(count(text, "<Time "), written);
  EXPECT_GE(count(text, "<Time "), written - written / 16);
  EXPECT_EQ(count(text, "<Grid "), count(text, "</Grid>"));
  EXPECT_TRUE(text.ends_with("</Grid>\n</Domain>\n</Xdmf>\n"));
}

TEST(ResultsOfAKilledRun, OpenAndHoldEverySnapshotWritten) {
  const Folder folder;
  SmallRun run(64, 8);
  const int status = in_child([&] {
    Results results(folder.path(), run.layout(planned));
    for (std::size_t k = 0; k < written; ++k) run.write(k, results);
    std::raise(SIGKILL);
  });
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  expect_half(folder, run);
}

TEST(ResultsOfAKilledRun, OpenAfterExitWithoutClosing) {
  const Folder folder;
  SmallRun run;
  const int status = in_child([&] {
    Results results(folder.path(), run.layout(planned));
    for (std::size_t k = 0; k < written; ++k) run.write(k, results);
    std::_Exit(0);
  });
  ASSERT_TRUE(went_well(status));
  expect_half(folder, run);
}

/// A write that breaks off in the middle leaves no time: nobody takes the snapshot for complete.
TEST(ResultsOfAKilledRun, ASnapshotBrokenOffHasNoTime) {
  const Folder folder;
  SmallRun run;
  static_cast<void>(in_child([&] {
    Results results(folder.path(), run.layout(planned));
    run.write(0, results);
    std::signal(SIGXFSZ, SIG_IGN);
    const ::rlimit none{1, 1};
    ::setrlimit(RLIMIT_FSIZE, &none);
    try {
      run.write(1, results);
    } catch (const FileError&) {
    }
    std::raise(SIGKILL);
  }));
  const auto time = h5::File::open(folder / "results.h5").read<double>("/frame/time");
  EXPECT_EQ(time[0], run.snapshot(0).time);
  EXPECT_TRUE(std::isnan(time[1]));
}

/// Bytes of results.h5 that are neither a snapshot's nor its time's do not change in the run.
TEST(ResultsOfAKilledRun, DescriptionOfTheFileIsCompleteFromTheStart) {
  const Folder folder;
  SmallRun run(64, 8);
  Results results(folder.path(), run.layout(planned));
  const std::string before = text_of(folder / "results.h5");
  for (std::size_t k = 0; k < written; ++k) run.write(k, results);
  const std::string after = text_of(folder / "results.h5");
  ASSERT_EQ(before.size(), after.size());
  std::size_t wrong = 0;
  const std::string nan_time = [] {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::string bytes(sizeof nan, '\0');
    std::memcpy(bytes.data(), &nan, sizeof nan);
    return bytes;
  }();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool was_empty = before[i] == '\0' || nan_time.find(before[i]) != std::string::npos;
    if (before[i] != after[i] && !was_empty) ++wrong;
  }
  EXPECT_EQ(wrong, 0U);
  results.close();
}

TEST(ResultsOfARunningRun, CanBeReadMeanwhile) {
  const Folder folder;
  SmallRun run;
  Results results(folder.path(), run.layout(planned));
  const std::string empty = text_of(folder / "fields.xdmf");
  EXPECT_EQ(count(empty, "<Grid "), 2U);  // the collection and the reference mesh
  EXPECT_TRUE(empty.ends_with("</Xdmf>\n"));
  for (std::size_t k = 0; k < written; ++k) run.write(k, results);
  const int status = in_child([&] {
    expect_half(folder, run);
    if (::testing::Test::HasFailure()) std::_Exit(1);
  });
  EXPECT_TRUE(went_well(status));
}

TEST(ResultsOutOfRoom, NameTheFileAndTheReason) {
  const Folder folder;
  SmallRun run(64, 8);
  const int status = in_child([&] {
    Results results(folder.path(), run.layout(planned));
    limit_files(std::filesystem::file_size(folder / "results.h5") / 2);
    const std::string what = error_of<FileError>([&] {
      for (std::size_t k = 0; k < planned; ++k) run.write(k, results);
    });
    EXPECT_NE(what.find("results.h5: cannot write /"), std::string::npos) << what;
    EXPECT_NE(what.find("File too large"), std::string::npos) << what;
    if (::testing::Test::HasFailure()) std::_Exit(1);
  });
  EXPECT_TRUE(went_well(status));
}

/// HDF5 keeps its settings for each thread: where it does not know better, it prints errors.
TEST(ResultsOutOfRoom, AreSilentOnAThreadThatDidNotMakeThem) {
  const Folder folder;
  SmallRun run(64, 8);
  const int status = in_child([&] {
    Results results(folder.path(), run.layout(planned));
    limit_files(std::filesystem::file_size(folder / "results.h5") / 2);
    testing::internal::CaptureStderr();
    std::string what;
    std::thread([&] {
      what = error_of<FileError>([&] {
        for (std::size_t k = 0; k < planned; ++k) run.write(k, results);
      });
    }).join();
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_NE(what.find("File too large"), std::string::npos) << what;
    if (::testing::Test::HasFailure()) std::_Exit(1);
  });
  EXPECT_TRUE(went_well(status));
}

TEST(ResultsOutOfRoom, AreRefusedBeforeTheRunStarts) {
  const Folder folder;
  SmallRun run;
  const std::size_t far_too_many = 1'000'000'000'000;
  const std::string what =
      error_of<FileError>([&] { const Results r(folder.path(), run.layout(far_too_many)); });
  EXPECT_NE(what.find("results.h5: disk full: "), std::string::npos) << what;
}

TEST(ResultsWithoutDirectory, AreRefused) {
  const Folder folder;
  SmallRun run;
  const std::string what =
      error_of<FileError>([&] { const Results r(folder / "none", run.layout(2)); });
  EXPECT_NE(what.find("none/results.h5.new: cannot create"), std::string::npos) << what;
  EXPECT_NE(what.find("No such file or directory"), std::string::npos) << what;
}

}  // namespace
}  // namespace rondo::io::test::results_failure_test
