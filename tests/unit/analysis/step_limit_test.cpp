// SPDX-License-Identifier: BSD-3-Clause
/// What sets the critical step is named.
#include "rondo/analysis/build/step_limit.hpp"

#include <gtest/gtest.h>

#include "rondo/analysis/build/build.hpp"
#include "unit/analysis/mesh_fixture.hpp"

namespace rondo::study::step_limit_test {
namespace {

using namespace test;

Setup disk(const std::string& mesh, const std::string& rim = "bonded") {
  const std::string motion = rim == "free"
                                 ? "initial = {position = [1, 2]}\n"
                                 : "motion = {angular_velocity = 0, speed = 0, height = 0.4}\n";
  return build(read_text("schema = 1\ndisk = {outer_radius = 0.3, inner_radius = 0.1, rim = '" +
                         rim + "', mesh = {" + mesh +
                         "}}\nmaterial = {youngs_modulus = 1e6, poissons_ratio = 0.3, density = "
                         "1000}\ntime.end = 1e-3\n" +
                         motion),
               1);
}

Case disk_case() {
  return read_text(
      "schema = 1\ndisk = {outer_radius = 0.3, inner_radius = 0.1, mesh = {radial = 1, "
      "circumferential = 9}}\nmaterial = {youngs_modulus = 1e6, poissons_ratio = 0.3, density = "
      "1000}\ntime.end = 1e-3\nmotion = {angular_velocity = 0, speed = 0, height = 0.4}\n");
}

}  // namespace

/// Columns are narrowest at the rim; with layers that grow finer outwards it is the last.
TEST(StepLimit, OfADiskIsALayer) {
  const auto even = disk("radial = 5, circumferential = 200");
  const StepLimit inner = find_step_limit(disk_case(), even);
  EXPECT_EQ(inner.part, "layer 1 of 5 from the rim, r = 0.1 to 0.14 m");
  EXPECT_NEAR(norm(inner.place), 0.12, 1e-3);
  EXPECT_EQ(inner.cell % 5, 0U);
  EXPECT_NEAR(inner.step, 2.0 / even.critical.element_bound, 1e-12 * inner.step);
  EXPECT_GT(inner.without_part, 1.1 * inner.step);
  EXPECT_LE(inner.without_worst, inner.without_part);
  const auto graded = disk("radial = 5, circumferential = 20, grading = 10.0");
  const StepLimit outer = find_step_limit(disk_case(), graded);
  EXPECT_EQ(outer.part.find("layer 5 of 5"), 0U) << outer.part;
  // Of a free disk, which has no sectors and is elsewhere, the same.
  const StepLimit placed =
      find_step_limit(disk_case(), disk("radial = 5, circumferential = 200", "free"));
  EXPECT_EQ(placed.part, inner.part);
  EXPECT_NEAR(placed.step, inner.step, 1e-9 * inner.step);
}

TEST(StepLimit, OfAMeshIsACellAndItsSurface) {
  const MeshCaseFile file(squares);
  const Case c = file.read({"material.region=[{surface = 'right', youngs_modulus = 4e6}]"});
  const StepLimit limit = find_step_limit(c, build(c, 1));
  EXPECT_EQ(limit.part, "surface \"right\"");
  EXPECT_GT(limit.place.x, 1.1);
  EXPECT_NEAR(limit.without_part, 2.0 * limit.step, 1e-9 * limit.step);  // √4
  // One in two of that stiffness is as bad as the worst, of which nothing is then said.
  EXPECT_NEAR(limit.without_worst, limit.step, 1e-9 * limit.step);
  const auto lines = lines_of(limit);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NE(lines[0].second.find("surface \"right\""), std::string::npos);
  EXPECT_EQ(lines[0].second.find(" s"), lines[0].second.find(" surface"));  // no second step
  EXPECT_EQ(lines[1], (std::pair<std::string, std::string>{
                          "without that surface", "2 times the step, by the element bound"}));
}

TEST(StepLimit, WithoutTheWorstIsAFactorToo) {
  StepLimit limit;
  limit.step = 1e-6;
  limit.without_worst = 1.12e-6;
  const auto lines = lines_of(limit);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1].first, "without the worst");
  EXPECT_EQ(lines[1].second.find("1.12 times the step"), 0U) << lines[1].second;
}

TEST(StepLimit, CellsOfNoPhysicalSurface) {
  const MeshCaseFile file(squares);
  const Case c = file.read({});
  auto s = build(c, 1);
  for (std::string& name : s.mesh.region_names) name.clear();
  EXPECT_EQ(find_step_limit(c, s).part, "no physical surface");
}

}  // namespace rondo::study::step_limit_test
