// SPDX-License-Identifier: BSD-3-Clause
/// The study of the paper: its plan, the figures taken from results, the judgement of rows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <set>

#include "rondo/core/build_id.hpp"
#include "rondo/core/error.hpp"
#include "rondo/mesh/disk.hpp"
#include "rondo/study/paper/paper_plan.hpp"
#include "rondo/study/paper/paper_results.hpp"
#include "rondo/study/paper/paper_table.hpp"
#include "rondo/study/paper/shipped_cases.hpp"

namespace rondo::study {
namespace {

namespace fs = std::filesystem;

TEST(ShippedCases, AreTheFilesOfCases) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(RONDO_CASES)) {
    if (entry.path().extension() != ".toml") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(shipped_case(entry.path().stem().string()), text) << entry.path();
    ++files;
  }
  EXPECT_EQ(shipped_cases().size(), files);
}

TEST(BuildId, IsTheProgramsOwn) {
  const std::string id = build_id();
  EXPECT_GE(id.size(), 16U);
  EXPECT_EQ(id.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(id, build_id());
}

class Plan : public testing::TestWithParam<bool> {};

TEST_P(Plan, EveryCaseIsValidAndEveryPodHasItsRun) {
  const PaperPlan plan = paper_plan(GetParam());
  std::set<std::string> names;
  for (const PaperRun& run : plan.runs) {
    const Case c = case_of(run);  // throws where it is not valid
    EXPECT_TRUE(c.warnings.empty()) << run.name << ": " << c.warnings[0];
    EXPECT_TRUE(names.insert(run.name).second) << run.name << " twice";
  }
  for (const PaperPod& pod : plan.pods) EXPECT_TRUE(names.count(pod.run)) << pod.run;
}

TEST_P(Plan, TheLedgeRunsMeetThePapersTimes) {
  for (const PaperRun& run : paper_plan(GetParam()).runs) {
    if (!run.name.starts_with("ledge")) continue;
    const Case c = case_of(run);
    const double spacing = c.time.end / (c.output.snapshots - 1);
    for (const double time : {0.0125, 0.0625, 0.1})
      EXPECT_NEAR(time / spacing, std::round(time / spacing), 1e-9) << run.name << ' ' << time;
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, Plan, testing::Values(false, true),
                         [](const auto& quick) { return quick.param ? "quick" : "full"; });

TEST(Plan, CommandsNameCaseAndSettings) {
  const PaperRun run{
      "friction-0.2", "ledge-smooth", {"ground.friction=0.2", "time.end=0.1"}, false};
  EXPECT_EQ(command_of(run, "some/paper"),
            "rondo run cases/ledge-smooth.toml -o some/paper/runs/friction-0.2 --set "
            "ground.friction=0.2 --set time.end=0.1");
}

/// a + b cos(2π f t + 0.3), as means over intervals of 0.3, 0.5, 0.7 ms in turn.
Columns wave(double a, double b, double f, double end) {
  Columns h;
  double t = 0.0;
  const double w = 2.0 * std::numbers::pi * f;
  for (int k = 0; t < end; ++k) {
    const double next = t + 1e-4 * (3 + 2 * (k % 3));
    h["time_s"].push_back(next);
    h["y"].push_back(a + b * (std::sin(w * next + 0.3) - std::sin(w * t + 0.3)) / (w * (next - t)));
    t = next;
  }
  return h;
}

TEST(PaperResults, MeansAndDeviationsAreByTimeNotByRow) {
  const Columns h{{"time_s", {1.0, 2.0, 5.0}}, {"y", {100.0, 1.0, 3.0}}};
  const Intervals all = intervals(h, "y", 0.0, "h.csv"), later = intervals(h, "y", 1.0, "h.csv");
  EXPECT_DOUBLE_EQ(mean(all), 22.0);
  EXPECT_DOUBLE_EQ(mean(later), 2.5);
  EXPECT_DOUBLE_EQ(deviation(later), std::sqrt(0.75));
}

TEST(PaperResults, MissingColumnsAndTimesAreNamed) {
  const Columns h{{"time_s", {1.0}}, {"y", {1.0}}};
  const auto message = [&](const char* column, double from) -> std::string {
    try {
      static_cast<void>(intervals(h, column, from, "some/history.csv"));
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("z", 0.0).find("some/history.csv"), std::string::npos);
  EXPECT_NE(message("z", 0.0).find("no column z"), std::string::npos);
  EXPECT_NE(message("y", 1.0).find("no rows after 1 s"), std::string::npos);
  const Columns empty{{"y", {}}};
  EXPECT_THROW(static_cast<void>(column(empty, "y", "h.csv")), FileError);
}

/// Found by fuzzing: the search of the highest line went on for ever.
TEST(PaperResults, TimesThatDoNotRiseAreRefused) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& time : {std::vector{0.1, 0.3, 0.2},
                                          {0.1, 0.1, 0.2},
                                          {-0.1, 0.1, 0.2},
                                          {0.1, nan, 0.2},
                                          {0.1, 0.2, infinity}}) {
    const Columns h{{"time_s", time}, {"y", {1.0, 2.0, 3.0}}};
    EXPECT_THROW(static_cast<void>(intervals(h, "y", 0.0, "h.csv")), FileError) << time[1];
  }
}

TEST(PaperResults, TheHighestLineIsFoundInTimesOfAnyLength) {
  const auto highest = [](double length) {
    return highest_line({{0.5 * length, 1.5 * length}, {length, length}, {1.0, 2.0}});
  };
  EXPECT_GE(highest(1e-9), 0.0);  // in tenths of a hertz it would take minutes
  EXPECT_TRUE(std::isinf(highest(1e-310)));
}

TEST(PaperResults, ALineHasTheHeightAndFrequencyOfItsHarmonic) {
  const Intervals f = intervals(wave(1000.0, 7.0, 123.4, 0.4), "y", 0.1, "h.csv");
  // Means over up to 0.7 ms damp the harmonic by at most (w Δt)²/24 = 1.2 %.
  EXPECT_NEAR(line(f, 123.4), 7.0, 0.12);
  EXPECT_LT(line(f, 223.4), 0.05);
  EXPECT_NEAR(highest_line(f), 123.4, 0.11);  // steps of a tenth of a hertz
}

TEST(PaperResults, WhatIsNoNumberComesThrough) {
  const double nan = std::nan("");
  EXPECT_TRUE(std::isnan(swing({{0.0, 1.0, 2.0}, {0.0, nan, 1.0}, {}}, 0.0, 2.0)));
}

TEST(PaperResults, SwingIsWithinItsTimes) {
  const EdgeMotion edge{{0.0, 1.0, 2.0, 3.0}, {0.0, 5.0, 2.0, -9.0}, {}};
  EXPECT_DOUBLE_EQ(swing(edge, 1.0, 2.0), 3.0);
  EXPECT_DOUBLE_EQ(swing(edge, 0.0, 3.0), 14.0);
}

TEST(PaperResults, EdgeDisplacementIsRadialAndTangential) {
  const mesh::Mesh mesh = mesh::make_disk({});
  std::vector<Vec2> u(mesh.n_nodes());
  for (std::size_t i = 0; i < u.size(); ++i)  // 1 % outwards and a turn
    u[i] = 0.01 * mesh.coordinates[i] + 0.3 * Vec2{-mesh.coordinates[i].y, mesh.coordinates[i].x};
  EXPECT_NEAR(edge_displacement(mesh, u).x, 0.01 * 0.3, 1e-15);
  EXPECT_NEAR(edge_displacement(mesh, u).y, 0.3 * 0.3, 1e-15);
}

TEST(PaperTable, ARowPassesWithinItsBound) {
  PaperRow row;
  row.expected = 2.0;
  const auto with = [&](Comparison comparison, double ours) {
    row.comparison = comparison;
    row.tolerance = comparison == Comparison::within ? 0.5 : 0.0;
    row.ours = ours;
    return passes(row);
  };
  EXPECT_TRUE(with(Comparison::within, 2.5));
  EXPECT_FALSE(with(Comparison::within, 2.51));
  EXPECT_FALSE(with(Comparison::within, 1.49));
  EXPECT_TRUE(with(Comparison::at_most, 2.0));
  EXPECT_FALSE(with(Comparison::at_most, 2.1));
  EXPECT_TRUE(with(Comparison::at_least, 2.0));
  EXPECT_FALSE(with(Comparison::at_least, 1.9));
  for (const Comparison c : {Comparison::within, Comparison::at_most, Comparison::at_least})
    EXPECT_FALSE(with(c, std::nan(""))) << name_of(c);
}

}  // namespace
}  // namespace rondo::study
