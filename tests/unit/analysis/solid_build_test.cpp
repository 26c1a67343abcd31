// SPDX-License-Identifier: BSD-3-Clause
/// A wheel in three dimensions from a case: its masses, parts, critical step, and what runs share.
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::solid_build_test {
namespace {

const std::string wheel = R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
width = 0.1
[disk.mesh]
radial = 3
circumferential = 24
axial = 2
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1000.0
[damping]
stiffness = 2.0e-5
[motion]
angular_velocity = 33.0
speed = 10.0
height = 0.3
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.1
)";

Case of(const std::vector<std::string>& settings = {}) {
  return test::read_text(wheel, settings);
}

TEST(SolidBuild, MassesAreThoseOfTheVolume) {
  const auto s = build(of(), 1);
  const double mass = std::accumulate(s.model.mass.begin(), s.model.mass.end(), 0.0);
  // Of the polygon of 24 sides between the radii.
  const double area = 12.0 * std::sin(std::numbers::pi / 12.0) * (0.3 * 0.3 - 0.15 * 0.15);
  EXPECT_NEAR(mass, 1000.0 * 0.1 * area, 1e-9);
  EXPECT_EQ(count_dofs(s.model), 3U * 24 * 3 * 3);
  EXPECT_EQ(s.model.stiffness_operator, dynamics::StiffnessOperator::cyclic);
  EXPECT_FALSE(s.model.sector);
  EXPECT_TRUE(s.critical.proven);
}

TEST(SolidBuild, LayersHaveTheirMaterials) {
  const auto plain = build(of(), 1);
  const auto s = build(of({"material.region=[{layers = [3], density = 3000.0}]"}), 1);
  ASSERT_EQ(s.mesh.region.size(), s.mesh.hexahedra.size());
  for (std::size_t i = 0; i < s.mesh.n_nodes(); ++i) {
    const double r = norm(s.mesh.coordinates[i]);
    const double factor = r > 0.29 ? 3.0 : r < 0.24 ? 1.0 : 0.0;  // between: of both
    if (factor > 0.0) {
      EXPECT_NEAR(s.model.mass[i], factor * plain.model.mass[i], 1e-12);
    }
  }
}

TEST(SolidBuild, ALayerThatIsNotThereIsRefused) {
  EXPECT_THROW(build(of({"material.region=[{layers = [4], density = 3000.0}]"}), 1), InputError);
}

TEST(SolidBuild, SlipAngleAndCamberShareTheBody) {
  const std::string key = body_key(of());
  EXPECT_EQ(key, body_key(of({"motion.slip_angle=0.1", "motion.camber=0.1"})));
  EXPECT_NE(key, body_key(of({"disk.width=0.2"})));
  EXPECT_NE(key, body_key(of({"disk.mesh.axial=3"})));
  EXPECT_NE(key, body_key(of({"disk.crown_radius=0.2"})));
}

TEST(SolidBuild, RunsThatShareABodyAreThoseOfOneAlone) {
  SharedBody shared;
  const std::vector<std::string> stationary{"initial.state=stationary", "motion.height=0.4"};
  build(of(stationary), 1, &shared);
  const auto again = build(
      of({"initial.state=stationary", "motion.height=0.4", "motion.camber=0.05"}), 1, &shared);
  const auto alone =
      build(of({"initial.state=stationary", "motion.height=0.4", "motion.camber=0.05"}), 1);
  EXPECT_EQ(again.displacement, alone.displacement);
  EXPECT_EQ(again.critical.step, alone.critical.step);
  const Vec3 largest = std::ranges::max(alone.displacement.space(), {}, &Vec3::z);
  EXPECT_GT(largest.z, 0.0);  // it becomes narrower as it spins
}

/// The lowest point of a wheel that leans is an edge.
TEST(SolidBuild, CamberCountsForTheStart) {
  EXPECT_NO_THROW(build(of({"motion.height=0.301"}), 1));
  EXPECT_TRUE(build(of({"motion.height=0.301"}), 1).warnings.empty());
  const auto leaning = build(of({"motion.height=0.301", "motion.camber=0.1"}), 1);
  ASSERT_FALSE(leaning.warnings.empty());
  EXPECT_NE(leaning.warnings.front().find("inside the ground"), std::string::npos);
}

TEST(SolidBuild, PressureHasTheAreaOfItsSide) {
  const auto s = build(of({"load.pressure=[{curve = 'right', value = 1.0}]"}), 1);
  ASSERT_EQ(s.model.solid->pressures.size(), 1U);
  double axial = 0.0, radial = 0.0;
  for (const Vec3 force : s.model.solid->pressures[0].force) {
    axial += force.z;
    radial = std::max(radial, std::abs(force.x));
  }
  EXPECT_LT(axial, 0.0);  // pressed to the left
  EXPECT_NEAR(radial, 0.0, 1e-15);
}

}  // namespace
}  // namespace rondo::study::solid_build_test
