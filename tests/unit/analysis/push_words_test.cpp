// SPDX-License-Identifier: BSD-3-Clause
/// Words on the way in which the ground pushes a wheel that the tests of the program do not reach
/// (tests/cli/test_push_words.py), and bounds of the radius of free rolling.
#include <gtest/gtest.h>

#include <cmath>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/push/free_rolling.hpp"
#include "rondo/analysis/build/push/push_words.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::test::push_words_test {
namespace {

const std::string plane = R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 2
circumferential = 24
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[motion]
angular_velocity = 33.333333
speed = 10.0
height = 0.294
[ground]
profile = "flat"
friction = 0.5
[time]
end = 0.02
)";
const std::vector<std::string> solid{"disk.width=0.1", "disk.mesh.axial=2"};

std::vector<std::string> joined(std::vector<std::string> first,
                                const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// The words with this name; empty: there are none.
std::string words(const std::string& name, const std::vector<std::string>& settings,
                  const std::string& text = plane) {
  const Case c = read_text(text, settings);
  for (const auto& [what, said] : push_lines(c, build(c, 1).mesh))
    if (what == name) return said;
  return {};
}

FreeRadii radii(const std::vector<std::string>& settings) {
  const Case c = read_text(plane, settings);
  const mesh::Mesh mesh = build(c, 1).mesh;
  return free_radii(c, mesh, wall_of(mesh).value());
}

TEST(PushWords, OfAWheelThatStands) {
  const std::vector<std::string> stands =
      joined(solid, {"motion.speed=0", "motion.angular_velocity=0", "motion.slip_angle=0.02",
                     "motion.camber=-0.05"});
  EXPECT_EQ(words("push of the spin", stands),
            "neither turns nor travels: the ground does not push it along");
  EXPECT_EQ(words("push of slip angle", stands),
            "the wheel does not travel, so that a slip angle does not push it");
  EXPECT_EQ(words("push of camber", stands),
            "leans its top to the right by 2.865°; it does not roll, and the run tells how it is "
            "pushed");
}

TEST(PushWords, OfATravelThatTurnsBack) {
  const std::vector<std::string> turns =
      joined(solid, {"motion.speed=[[0, 5], [0.02, -5]]", "motion.slip_angle=0.02",
                     "motion.angular_velocity=[[0, 16], [0.02, -16]]"});
  EXPECT_EQ(words("push of slip angle", turns),
            "turned by 1.146° to the left and to the right of its velocity: the ground pushes it "
            "against its motion to the side, force_lateral < 0 while it moves to the right");
}

TEST(PushWords, OfARimWithoutTravelOrWithATorqueThatChangesItsSign) {
  const std::string rim = plane + "[rim]\nfree = [\"angular_velocity\"]\ninertia = 0.1\n";
  EXPECT_EQ(words("push of torque", {"rim.torque=[[0, 10], [0.02, -10]]"}, rim),
            "rim.torque changes its sign: > 0 pushes the wheel towards +x, force_x > 0, once its "
            "spin has settled");
  const std::vector<std::string> stands{"motion.speed=0", "motion.angular_velocity=0"};
  EXPECT_EQ(words("push of torque", joined(stands, {"rim.torque=-10"}), rim),
            "turned by rim.torque: the ground pushes it towards -x, force_x < 0, once its spin has "
            "settled");
  EXPECT_EQ(words("push of the brake", joined(stands, {"rim.brake=10"}), rim),
            "rim.brake acts against the spin: the ground pushes the wheel against its travel");
}

TEST(FreeRadii, GrowWithTheDeflection) {
  const FreeRadii plane_wheel = radii({});  // pressed in by 6 mm
  EXPECT_NEAR(plane_wheel.least, 0.3 * (1.0 - 0.35 * std::sqrt(0.02)), 1e-9);
  EXPECT_NEAR(plane_wheel.largest, 0.3 * (1.0 + 0.35 * std::sqrt(0.02)), 1e-9);
  const FreeRadii deep = radii({"motion.height=[[0, 0.3], [0.01, 0.255]]"});
  EXPECT_NEAR(deep.least, 0.255, 1e-9);        // the height of the axle
  EXPECT_NEAR(deep.largest, 0.3 * 1.3, 1e-9);  // 0.045 m of the wall of 0.15 m
  const FreeRadii over_a_step =
      radii({"ground.profile=[[-10, 0], [1, 0], [1.1, 0.002], [10, 0.002]]"});
  EXPECT_LT(over_a_step.least, plane_wheel.least);
}

TEST(FreeRadii, OfAHeightThatForcesFind) {
  const FreeRadii found =
      radii({"rim.free=[\"height\"]", "rim.mass=1", "rim.force_y=-1000", "motion.height=0.3"});
  EXPECT_NEAR(found.least, 0.3 * (1.0 - 0.35 * std::sqrt(0.1)), 1e-9);
  EXPECT_NEAR(found.largest, 0.3 * 1.2, 1e-9);
}

TEST(FreeRadii, OfAWheelThatLeansItsSideIsNearerToTheAxle) {
  const FreeRadii straight = radii(solid), leans = radii(joined(solid, {"motion.camber=0.1"}));
  const double deflection = 0.3 * std::cos(0.1) + 0.05 * std::sin(0.1) - 0.294;
  EXPECT_NEAR(
      leans.least,
      0.3 * std::pow(std::cos(0.1), 2) - 0.05 * std::sin(0.1) - 0.35 * std::sqrt(0.3 * deflection),
      1e-9);
  EXPECT_GT(leans.largest, straight.largest);
}

}  // namespace
}  // namespace rondo::study::test::push_words_test
