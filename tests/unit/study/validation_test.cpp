// SPDX-License-Identifier: BSD-3-Clause
/// What a validation measures with, on data made by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string_view>
#include <vector>

#include "rondo/mesh/disk.hpp"
#include "rondo/study/paper/validation_measures.hpp"
#include "rondo/study/paper/validation_table.hpp"

using namespace rondo;
using namespace rondo::study;

namespace {

constexpr double pi = std::numbers::pi;
// Sums of some ten numbers of size 1, and angles of that size.
constexpr double round_off = 1e-13;

mesh::Mesh disk(int columns) {
  mesh::Disk d;
  d.radial = 2;
  d.circumferential = columns;
  return mesh::make_disk(d);
}

/// Index of the place at an angle.
std::size_t place(const Profile& p, double angle) {
  for (std::size_t k = 0; k < p.angle.size(); ++k)
    if (std::abs(p.angle[k] - angle) < 1e-9) return k;
  ADD_FAILURE() << "no place at " << angle;
  return 0;
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST(ValidationMeasures, SharesOfNothingAreNoNumbers) {
  EXPECT_EQ(share_of(1.0, -4.0), -0.25);
  EXPECT_TRUE(std::isnan(share_of(0.0, 0.0)));
  EXPECT_EQ((SquareSums{9.0, 16.0}.relative()), 0.75);
  EXPECT_TRUE(std::isnan(SquareSums{}.relative()));
}

TEST(ValidationMeasures, TimesLieBetweenSnapshots) {
  const std::vector<double> times{1.0, 2.0, 4.0};
  const auto at = [&](double t) { return between(times, t); };
  EXPECT_FALSE(at(0.999));
  EXPECT_FALSE(at(4.001));
  EXPECT_FALSE(at(NAN));
  EXPECT_FALSE(between({}, 1.0));
  EXPECT_EQ(at(1.0)->first, 0u);
  EXPECT_EQ(at(1.0)->weight, 0.0);
  EXPECT_EQ(at(3.5)->first, 1u);
  EXPECT_EQ(at(3.5)->weight, 0.75);
  EXPECT_EQ(at(2.0)->first, 1u);
  EXPECT_EQ(at(4.0)->first, 2u);
  EXPECT_EQ(at(4.0)->weight, 0.0);
}

TEST(ValidationMeasures, ForcesStandAtTheirAngleInSpace) {
  for (const int columns : {12, 13}) {
    const mesh::Mesh mesh = disk(columns);
    const double pitch = 2.0 * pi / columns;
    const double length = sum(mesh.tributary);
    std::vector<Vec2> force(mesh.boundary.size());
    // The candidate straight down in the turning frame, by number.
    std::size_t down = 0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      const Vec2 x = mesh.coordinates[static_cast<std::size_t>(mesh.boundary[i])];
      if (std::abs(std::atan2(x.x, -x.y)) < 1e-9) down = i;
    }
    force[down] = {6.0, -2.0};
    ProfileSum profile(mesh);
    profile.add(2.0 * pitch, force);               // two places to the right, exactly
    profile.add(-2.0 * pi - 0.25 * pitch, force);  // a quarter of a place to the left
    profile.add(pi, force);                        // up
    const Profile p = profile.mean();
    ASSERT_EQ(p.angle.size(), force.size());
    for (std::size_t k = 1; k < p.angle.size(); ++k)
      EXPECT_NEAR(p.angle[k] - p.angle[k - 1], pitch, round_off);
    EXPECT_GE(p.angle.front(), -pi - round_off);
    EXPECT_LT(p.angle.back(), pi);
    // Three snapshots; force by length of a place.
    const double unit = 1.0 / 3.0 / (length / columns);
    EXPECT_NEAR(p.pressure[place(p, 2.0 * pitch)] / unit, 6.0, 1e-12);
    EXPECT_NEAR(p.shear[place(p, 2.0 * pitch)] / unit, -2.0, 1e-12);
    EXPECT_NEAR(p.pressure[place(p, 0.0)] / unit, 4.5, 1e-12);
    EXPECT_NEAR(p.pressure[place(p, -pitch)] / unit, 1.5, 1e-12);
    EXPECT_NEAR(p.shear[place(p, -pitch)] / unit, -0.5, 1e-12);
    // The integral is the mean force.
    EXPECT_NEAR(sum(p.pressure) * length / columns, 6.0, 1e-12);
    EXPECT_NEAR(sum(p.shear) * length / columns, -2.0, 1e-12);
  }
}

TEST(ValidationMeasures, ErrorsOfProfilesAreByTheOneNamed) {
  const std::vector<double> full{3.0, 0.0, 4.0}, reduced{3.0, 2.0, 4.0}, pressure{0.0, 8.0, 0.0};
  EXPECT_DOUBLE_EQ(profile_error(full, reduced, full), 0.4);
  EXPECT_DOUBLE_EQ(profile_error(full, reduced, pressure), 0.25);
}

TEST(ValidationTable, ColumnsAndLines) {
  ValidationReport report;
  Validated run;
  run.name = "held,out";
  run.status = RunStatus::done;
  run.figures.force_x = {-100.0, -130.0};
  run.figures.force_y = {2000.0, 1990.0};
  run.figures.friction_power = {0.0, 0.0};
  run.figures.loop_wall = {6.0, 1.5};
  report.runs = {run, run};
  report.runs[1].status = RunStatus::failed;
  EXPECT_EQ(report.status(), RunStatus::failed);
  const auto value = [&](std::string_view name) {
    for (const ValidationColumn& c : validation_columns()) {
      if (c.name == name) return c.value(run.figures);
    }
    ADD_FAILURE() << "no column " << name;
    return 0.0;
  };
  EXPECT_DOUBLE_EQ(value("force_x_error"), -0.015);  // of the vertical one
  EXPECT_DOUBLE_EQ(value("force_y_error"), -0.005);
  EXPECT_TRUE(std::isnan(value("friction_error")));
  EXPECT_DOUBLE_EQ(value("speed_up"), 4.0);
  const std::string csv = validation_csv(report);
  EXPECT_NE(csv.find("\n\"held,out\",0,0,0,nan"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n\"held,out\",nan,nan,nan,nan"), std::string::npos) << csv;
  const std::string text = validation_text(report);
  EXPECT_NE(text.find("-100 | -130"), std::string::npos) << text;
  EXPECT_NE(text.find("failed"), std::string::npos) << text;
}

TEST(ValidationTable, StandsBesideTheModel) {
  EXPECT_EQ(validation_directory("a/b.c/model.h5"), "a/b.c/model-validation");
  EXPECT_EQ(validation_directory("model.h5"), "model-validation");
}
