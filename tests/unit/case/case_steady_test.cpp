// SPDX-License-Identifier: BSD-3-Clause
/// analysis.kind = "steady-rolling": what is read, and what is refused with key and line.
#include <gtest/gtest.h>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::case_steady_test {
namespace {

using namespace test;

/// The base on flat ground; the tests count its lines.
std::string rolling(const std::string& more = "") {
  return with_line(25, "profile = 'flat'", with_line(26, "")) +
         "[analysis]\nkind = 'steady-rolling'\n" + more;
}
constexpr int speed_line = 20, height_line = 21, first_line = 40;  ///< the last: of `more`

/// One fault, of this key, at this line, whose text has the part.
void expect_fault(const std::string& text, const std::string& key, int line,
                  const std::string& part, const std::vector<std::string>& settings = {}) {
  const auto faults = faults_of(text, settings);
  ASSERT_EQ(faults.size(), 1U) << (faults.empty() ? key : faults[1].key + faults[1].message);
  EXPECT_EQ(faults[0].key, key);
  EXPECT_EQ(faults[0].line, line);
  EXPECT_NE(faults[0].message.find(part), std::string::npos) << faults[0].message;
  EXPECT_FALSE(faults[0].allowed.empty());
}

TEST(CaseSteady, HasEightSamplesOrSixteenWithATread) {
  const Case c = read_text(rolling());
  EXPECT_EQ(c.analysis.samples_per_sector, 8);
  EXPECT_EQ(c.analysis.slip, RollingSlip::bdf2);
  EXPECT_TRUE(c.analysis.massless_contact);
  EXPECT_EQ(write_case(read_text(write_case(c))), write_case(c));
  const Case tread = read_text(treaded(), {"analysis.kind=steady-rolling", "ground.profile=flat"});
  EXPECT_EQ(tread.analysis.samples_per_sector, 16);
}

TEST(CaseSteady, TakesOneOfEachPair) {
  const std::string load = "load = 1.9e5\n", torque = "torque = 0\n";
  expect_fault(rolling(load), "analysis.load", first_line, "is given together with motion.height");
  expect_fault(rolling(torque), "analysis.torque", first_line,
               "is given together with motion.speed");
  expect_fault(rolling("traction = 0\n"), "analysis.traction", first_line,
               "is given together with motion.speed");
  expect_fault(with_line(height_line, "", rolling()), "motion.height", 18, "so is analysis.load");
  expect_fault(with_line(speed_line, "", rolling()), "motion.speed", 18,
               "so are analysis.traction and analysis.torque");
  expect_fault(with_line(speed_line, "", rolling(torque + "traction = 0\n")), "analysis.torque",
               first_line, "is given together with analysis.traction");
  const Case c =
      read_text(with_line(speed_line, "", with_line(height_line, "", rolling(load + torque))));
  EXPECT_EQ(c.analysis.load, 1.9e5);
  EXPECT_EQ(c.analysis.torque, 0.0);
  EXPECT_EQ(write_case(read_text(write_case(c))), write_case(c));
}

TEST(CaseSteady, RefusesWhatItIsNotMadeFor) {
  const std::string text = rolling();
  expect_fault(text, "motion.angular_velocity", 0, "does not turn", {"motion.angular_velocity=0"});
  for (const char* key : {"angular_velocity", "speed", "height", "gravity"})
    expect_fault(text, std::string("motion.") + key, 0, "is a table",
                 {std::string("motion.") + key + "=[[0, 1], [1, 2]]"});
  expect_fault(text, "motion.slope", 0, "does not support a slope", {"motion.slope=0.1"});
  expect_fault(text, "ground.profile", 0, "needs flat ground",
               {"ground.profile=[[-1, 0], [1, 0.1]]"});
  EXPECT_EQ(faults_of(text, {"disk.rim=free"}).size(), 5U);  // and four keys of the rim's motion
  expect_fault(text, "disk.mesh.radial", 0, "held by the rim", {"disk.mesh.radial=1"});
  expect_fault(text, "analysis.massless_contact", 0, "with 8 samples",
               {"analysis.massless_contact=false"});
  expect_fault(text, "rim", 0, "a rim that forces move", {"rim.free=[]"});
  expect_fault(text, "contact.between", 0, "with the ground only", {"contact.between=bodies"});
  expect_fault(text, "load.pressure[0].value", 0, "is a table",
               {"load.pressure=[{curve='tread', value=[[0, 1], [1, 2]]}]"});
  expect_fault(with_line(speed_line, "", with_line(height_line, "", text)), "analysis.traction", 0,
               "would slide", {"analysis.load=1e5", "analysis.traction=-30000"});
  expect_fault(base, "analysis.load", 0, "has no effect in a dynamic", {"analysis.load=1e5"});
}

TEST(CaseSteady, TakesATurnSlipOfAWheelAlone) {
  const std::string wheel = "disk.width=0.1", turns = "motion.turn_slip=0.05";
  const Case c = read_text(rolling(), {wheel, turns});
  EXPECT_EQ(c.analysis.turn_slip, 0.05);
  EXPECT_EQ(write_case(read_text(write_case(c))), write_case(c));
  expect_fault(rolling(), "motion.turn_slip", 0, "the body is plane", {turns});
  expect_fault(base, "motion.turn_slip", 0, "has no effect in a dynamic analysis", {wheel, turns});
  expect_fault(base, "motion.turn_slip", 0, "has no effect in a crush analysis",
               {wheel, turns, "analysis.kind=crush", "analysis.depth=0.01", "analysis.increments=2",
                "ground.profile=flat"});
  const auto faults = faults_of(base, {"motion.yaw_rate=0.1"});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].message.find("motion.turn_slip"), std::string::npos) << faults[0].message;
}

TEST(CaseSteady, TakesAStepOfTheSlipOfAWheelAlone) {
  const std::string wheel = "disk.width=0.1", upwind = "analysis.slip=upwind",
                    turns = "analysis.slip_angle_step=0.01",
                    slips = "analysis.slip_ratio_step=0.01", far = "analysis.step_distance=2";
  const Case c = read_text(rolling(), {wheel, upwind, turns, far});
  EXPECT_EQ(c.analysis.slip_angle_step, 0.01);
  EXPECT_EQ(c.analysis.slip_ratio_step, std::nullopt);
  EXPECT_EQ(c.analysis.step_distance, 2.0);
  EXPECT_EQ(write_case(read_text(write_case(c))), write_case(c));
  constexpr int table_line = 38;
  expect_fault(rolling(), "analysis.step_distance", table_line, "is missing",
               {wheel, upwind, slips});
  expect_fault(rolling(), "analysis.step_distance", 0, "without a step", {wheel, upwind, far});
  expect_fault(rolling(), "analysis.slip_ratio_step", 0, "together with analysis.slip_angle_step",
               {wheel, upwind, turns, slips, far});
  expect_fault(rolling(), "analysis.slip", table_line, "its ways from one sample before",
               {wheel, turns, far});
  expect_fault(rolling(), "analysis.slip_angle_step", 0, "this body is plane",
               {upwind, turns, far});
  expect_fault(rolling(), "analysis.slip_angle_step", 0, "is 0: nothing changes",
               {wheel, upwind, "analysis.slip_angle_step=0", far});
  expect_fault(rolling(), "analysis.slip_angle_step", 0, "a slip angle of 1.5 rad or more",
               {wheel, upwind, "motion.slip_angle=0.77", "analysis.slip_angle_step=0.77", far});
  expect_fault(with_line(speed_line, "", rolling()), "analysis.slip_ratio_step", 0,
               "follows from the traction or the torque",
               {wheel, upwind, slips, far, "analysis.torque=0"});
  expect_fault(base, "analysis.step_distance", 0, "has no effect in a dynamic", {wheel, far});
}

TEST(CaseSteady, TakesOneSampleWithMass) {
  const Case c =
      read_text(rolling("samples_per_sector = 1\nmassless_contact = false\nslip = 'upwind'\n"),
                {"disk.mesh.radial=1"});
  EXPECT_FALSE(c.analysis.massless_contact);
  EXPECT_EQ(c.analysis.slip, RollingSlip::upwind);
}

TEST(CaseSteady, IsOfADisk) {
  const std::string text = R"(schema = 1
[mesh]
file = "ring.msh"
clamped = "rim"
contact = "tread"
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[motion]
angular_velocity = 33
speed = 10
height = 0.29
[ground]
profile = "flat"
[analysis]
kind = "steady-rolling"
)";
  expect_fault(text, "mesh", 2, "equal sectors");
}

}  // namespace
}  // namespace rondo::study::case_steady_test
