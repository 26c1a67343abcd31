// SPDX-License-Identifier: BSD-3-Clause
/// Numbers in other units than SI, and other senses: what is warned of, and that a usual case is
/// not.
#include <gtest/gtest.h>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/plausible/number_range.hpp"
#include "rondo/analysis/registry.hpp"
#include "rondo/analysis/steady/scheme_power.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::test::plausible_test {
namespace {

const std::string wheel = R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 3
circumferential = 40
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[damping]
stiffness = 2.0e-5
[motion]
angular_velocity = 33.333333
speed = 10.0
height = 0.29
[ground]
profile = "flat"
)";
const std::vector<std::string> moving{"time.end=0.02", "output.snapshots=2",
                                      "motion.height=[[0, 0.3], [0.004, 0.29]]"};
const std::vector<std::string> rolling{"analysis.kind=steady-rolling"};
const std::vector<std::string> loaded{"analysis.kind=steady-rolling", "analysis.load=1e5",
                                      "analysis.torque=0"};
const std::vector<std::string> solid{"disk.width=0.1", "disk.mesh.axial=2",
                                     "analysis.kind=steady-rolling"};

/// All warnings of `rondo check`, empty where there is none.
std::string warned(std::vector<std::string> settings, const std::string& more = {}) {
  if (!more.empty()) settings.push_back(more);
  std::string all;
  for (const std::string& text : check_case(read_text(wheel, settings), {}).warnings)
    all += text + '\n';
  return all;
}

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << part << "\" is not in \"" << text << "\"";
}

TEST(Plausible, AUsualCaseIsNotWarnedOf) {
  EXPECT_EQ(warned(moving), "");
  EXPECT_EQ(warned(rolling), "");
  EXPECT_EQ(warned(loaded), "");
  EXPECT_EQ(warned(solid), "");
  EXPECT_EQ(warned(loaded, "load.pressure=[{curve = 'tread', value = 2.2e5}]"), "");
}

TEST(Plausible, AHeightInMillimetres) {
  const std::string told = warned(moving, "motion.height=290");
  EXPECT_TRUE(has(told, "motion.height: the center comes no nearer to the ground than 290 m"));
  EXPECT_TRUE(has(told, "in m, not in mm"));
  EXPECT_TRUE(has(warned(rolling, "motion.height=290"), "nothing touches"));
  EXPECT_EQ(warned(moving, "motion.height=0.59"), "");  // it may be meant to spin in the air
  EXPECT_TRUE(has(warned(moving, "motion.height=0.61"), "stays 0.31 m above it"));
}

TEST(Plausible, AFreeHeightInMillimetres) {
  const std::vector<std::string> borne{
      "time.end=0.02", "output.snapshots=2",
      "rim={free = ['height'], mass = 10, inertia = 1, force_y = -1e5}"};
  EXPECT_TRUE(has(warned(borne, "motion.height=290"), "starts 289.7 m above the ground"));
  EXPECT_FALSE(has(warned(borne, "motion.height=3.2"), "motion.height"));  // it is dropped
}

/// Contact nodes are 47 mm apart.
TEST(Plausible, GroundThatIsSmallBesideTheElements) {
  const auto over = [](const std::string& profile, const std::string& fillet) {
    std::vector<std::string> settings = moving;
    settings.push_back("ground.profile=" + profile);
    return warned(settings, "ground.fillet=" + fillet);
  };
  const std::string ledge = "[[-9, 0], [2, 0], [2, 0.1], [9, 0.1]]";
  const std::string told = over(ledge, "0.02");
  EXPECT_TRUE(has(told, "ground.fillet: the radius of 0.02 m is below the 0.0471 m between"));
  EXPECT_TRUE(has(told, "give a fillet of at least 0.0471 m"));
  EXPECT_EQ(over(ledge, "0.05"), "");
  EXPECT_EQ(over(ledge, "0"), "");  // a sharp corner is meant
  const auto post = [&](const std::string& end) {
    return over("[[-9, 0], [2, 0], [2, 0.02], [" + end + ", 0.02], [" + end + ", 0], [9, 0]]", "0");
  };
  EXPECT_TRUE(has(post("2.02"), "ground.profile: the obstacle 0.02 m high at (2"));
  EXPECT_EQ(post("2.1"), "");
}

TEST(Plausible, APressureInBar) {
  for (const auto& kind : {moving, rolling, loaded}) {
    const std::string told = warned(kind, "load.pressure=[{curve = 'tread', value = 2.2}]");
    EXPECT_TRUE(has(told, "load.pressure[0].value reaches 2.2 Pa at most"));
    EXPECT_TRUE(has(told, "not in bar or kPa"));
  }
  EXPECT_EQ(warned(moving, "load.pressure=[{curve = 'tread', value = 0}]"), "");
}

/// The body has 232 kg/m.
TEST(Plausible, ALoadInKilonewton) {
  const std::string told = warned(loaded, "analysis.load=190");
  EXPECT_TRUE(
      has(told, "analysis.load of 190 N/m is 0.083 times the weight of the body (232 kg/m"));
  EXPECT_TRUE(has(told, "not in kN/m"));
  const std::string rim = "rim={free = ['height'], mass = 10, inertia = 1, force_y = -190}";
  std::vector<std::string> borne{"time.end=0.02", "output.snapshots=2"};
  EXPECT_TRUE(has(warned(borne, rim), "rim.force_y of 190 N/m"));
  std::vector<std::string> weighing = borne;
  weighing.emplace_back("motion.gravity=9.81");
  EXPECT_FALSE(has(warned(weighing, rim), "rim.force_y"));
}

TEST(Plausible, AnAngleInDegrees) {
  EXPECT_TRUE(has(warned(solid, "motion.slip_angle=0.5"), "motion.slip_angle reaches 0.5 rad"));
  EXPECT_TRUE(has(warned(solid, "motion.camber=-0.5"), "28.6 degrees"));
  EXPECT_EQ(warned(solid, "motion.slip_angle=0.2"), "");
}

TEST(Plausible, ATurnSlipThatIsARadius) {
  const std::vector<std::string> wheel{"analysis.kind=steady-rolling", "ground.profile=flat",
                                       "disk.width=0.1"};
  const std::string told = warned(wheel, "motion.turn_slip=-50");
  EXPECT_TRUE(has(told, "motion.turn_slip: the path has a radius of 0.02 m")) << told;
  EXPECT_TRUE(has(told, "one over it"));
  EXPECT_EQ(warned(wheel, "motion.turn_slip=0.5"), "");
}

TEST(Plausible, ADepthThatIsNoDepth) {
  const std::string crush = "analysis={kind = 'crush', increments = 2, depth = 1e-5}";
  EXPECT_TRUE(has(warned({}, crush), "analysis.depth: the body is pressed in by 1e-05 m"));
}

TEST(Plausible, AboveTheCriticalSpinInThreeDimensions) {
  EXPECT_TRUE(has(warned(solid, "motion.angular_velocity=600"), "above the critical spin"));
}

TEST(NumberRange, NamesTheKeyThatIsFurthestFromAnyBody) {
  const auto key = [](const std::string& setting) {
    return furthest_key(read_text(wheel, {"time.end=0.02", setting}));
  };
  EXPECT_EQ(key("material.density=1e200"), "material.density");
  EXPECT_EQ(key("damping.mass=1e305"), "damping.mass");
  EXPECT_EQ(key("damping.stiffness=1e300"), "damping.stiffness");
  EXPECT_EQ(key("motion.angular_velocity=-1e160"), "motion.angular_velocity");
  EXPECT_EQ(key("material.youngs_modulus=1e-320"), "material.youngs_modulus");
}

/// A share above the bound is refused only where the power counts beside load times speed.
TEST(SchemePower, IsRefusedWhereItCounts) {
  const Case c = read_text(wheel, rolling);
  statics::RollingPower power;
  power.scheme_share = 0.5;
  power.scheme_over_load = 1.1e-4;
  EXPECT_NE(scheme_trouble(c, power).find("bound 25 %"), std::string::npos);
  power.scheme_over_load = 0.9e-4;
  EXPECT_EQ(scheme_trouble(c, power), "");
  EXPECT_NE(scheme_warning(c, power).find("50 %"), std::string::npos);
  power.scheme_over_load = 1.1e-4;
  power.scheme_share = 0.2;
  EXPECT_EQ(scheme_trouble(c, power), "");
  power.scheme_share = 0.04;
  EXPECT_EQ(scheme_warning(c, power), "");
}

}  // namespace
}  // namespace rondo::study::test::plausible_test
