// SPDX-License-Identifier: BSD-3-Clause
/// V19, V20: how many modes a rolling disk takes, smooth and treaded, in the rotating and in the
/// rectified frame, against its quasi-static crush. Expected: an independent code of the same
/// scheme on the same meshes (docs/validation.md).
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <string>

#include "rondo/analysis/run.hpp"
#include "rondo/study/pod/pod.hpp"

namespace v19_reducibility {

using namespace rondo;
using namespace rondo::study;

namespace {

namespace fs = std::filesystem;

struct Counts {
  const char *run, *field, *frame, *shift;
  std::array<long long, 3> modes;  ///< that leave 1e-2, 1e-4, 1e-6 of the energy
};

void PrintTo(const Counts& c, std::ostream* out) {
  *out << c.run << ' ' << c.field << ' ' << c.frame << ' ' << c.shift;
}

std::string name_of(const testing::TestParamInfo<Counts>& info) {
  std::string name = fmt::format("{}_{}_{}_{}", info.param.run, info.param.field, info.param.frame,
                                 info.param.shift);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Each run is made once for all tests of the program.
class Reducibility : public testing::TestWithParam<Counts> {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / fmt::format("rondo-v19-{}", getpid());
    make("ledge-smooth", {"time.end=0.2585", "output.snapshots=595"});
    // Ten snapshots a pitch: other numbers meet the tread in more phases, and see more modes.
    make("ledge-treaded", {"time.end=0.2584956", "output.snapshots=601"});
    make("crush-smooth", {});
    const std::vector<std::string> turn{"time.end=0.2585", "output.snapshots=595",
                                        "output.snapshots_from=0.07"};
    make("massless-boundary", turn);
    std::vector<std::string> undamped = turn;
    undamped.emplace_back("damping.stiffness=0.0");
    make("massless-boundary", undamped, "massless-undamped");
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  /// One turn of steady rolling, from 0.07 s on; or a crush.
  static void make(const std::string& name, std::vector<std::string> settings,
                   const std::string& folder = "") {
    settings.emplace_back("output.stress=false");
    if (name.starts_with("ledge")) settings.emplace_back("output.snapshots_from=0.07");
    const Case c = read_case(fs::path(RONDO_CASES) / (name + ".toml"), settings);
    RunOptions options;
    options.directory = folder_ / (folder.empty() ? name : folder);
    options.threads = 1;
    ASSERT_EQ(run_case(c, options).status, RunStatus::done) << name;
  }

  static fs::path folder_;
};

fs::path Reducibility::folder_;

/// One mode more or less where there are few, a tenth where there are many: the two codes differ in
/// step and start, and a count moves by that where the spectrum is flat.
long long allowed(long long expected) {
  return expected < 10 ? 1 : static_cast<long long>(std::ceil(0.1 * static_cast<double>(expected)));
}

}  // namespace

TEST_P(Reducibility, ModesNeeded) {
  const Counts& expected = GetParam();
  PodRequest request;
  request.runs = {folder_ / expected.run};
  request.field = expected.field;
  request.frame = expected.frame;
  request.shift = expected.shift;
  request.reconstruct = 0;
  const PodReport report = run_pod(request);
  static const std::map<std::string, std::size_t> snapshots{{"ledge-smooth", 595},
                                                            {"ledge-treaded", 601},
                                                            {"crush-smooth", 40},
                                                            {"massless-boundary", 595},
                                                            {"massless-undamped", 595}};
  EXPECT_EQ(report.snapshots, snapshots.at(expected.run));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(static_cast<double>(report.counts[k].modes), static_cast<double>(expected.modes[k]),
                static_cast<double>(allowed(expected.modes[k])))
        << "to discard " << report.counts[k].discarded;
    RecordProperty(fmt::format("modes_{:.0e}", report.counts[k].discarded),
                   static_cast<int>(report.counts[k].modes));
  }
  // The identity holds to the round-off of the energy.
  EXPECT_LT(report.difference, 1e-14);
  EXPECT_LT(report.orthonormality, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(
    V19, Reducibility,
    testing::Values(Counts{"ledge-smooth", "displacement", "rotating", "fourier", {20, 45, 192}},
                    Counts{"ledge-smooth", "displacement", "rectified", "fourier", {1, 1, 4}},
                    Counts{"ledge-smooth", "velocity", "rotating", "fourier", {75, 417, 584}},
                    Counts{"ledge-smooth", "velocity", "rectified", "fourier", {2, 8, 56}},
                    Counts{"crush-smooth", "displacement", "rotating", "fourier", {1, 2, 5}}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    V20, Reducibility,
    testing::Values(Counts{"ledge-treaded", "displacement", "rotating", "fourier", {21, 69, 252}},
                    Counts{"ledge-treaded", "displacement", "rectified", "fourier", {1, 3, 9}},
                    Counts{"ledge-treaded", "displacement", "rectified", "pitch", {2, 3, 8}},
                    Counts{"ledge-treaded", "velocity", "rotating", "fourier", {125, 495, 597}},
                    Counts{"ledge-treaded", "velocity", "rectified", "fourier", {6, 13, 76}},
                    Counts{"ledge-treaded", "velocity", "rectified", "pitch", {6, 10, 67}}),
    name_of);

/// Contact nodes without mass: no shocks of arrivals, which take most of the modes of the velocity.
INSTANTIATE_TEST_SUITE_P(
    V33, Reducibility,
    testing::Values(Counts{"massless-boundary", "velocity", "rectified", "fourier", {2, 6, 19}},
                    Counts{"massless-boundary", "displacement", "rectified", "fourier", {1, 1, 4}},
                    Counts{"massless-undamped", "velocity", "rectified", "fourier", {4, 9, 65}}),
    name_of);

}  // namespace v19_reducibility
