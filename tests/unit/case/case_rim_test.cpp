// SPDX-License-Identifier: BSD-3-Clause
/// [rim]: what is read, refused with key and line, and warned of.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::case_rim_test {
namespace {

using namespace test;

/// The base on flat ground, whose rim is of its own; the tests count its lines.
std::string with_rim(const std::string& rim) {
  return base + "[rim]\n" + rim;
}

const std::string wheel = with_rim(
    "free = ['height', 'angular_velocity']\n"
    "mass = 100\n"
    "inertia = 1\n"
    "force_y = [[0, 0], [0.01, -1.5e5]]\n"
    "torque = 10\n"
    "brake = [[0, 0], [0.1, 50]]\n"
    "[rim.support.y]\n"
    "damping = 6e4\n");
constexpr int rim_line = 39;  // of the first key

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool warned_of(const Case& c, const std::string& part) {
  return std::ranges::any_of(c.warnings, [&](const std::string& w) { return says(w, part); });
}

/// One fault, of this key, at this line, whose text has all the parts.
void expect_fault(const std::string& text, const std::string& key, int line,
                  const std::vector<std::string>& parts,
                  const std::vector<std::string>& settings = {}) {
  const auto faults = faults_of(text, settings);
  ASSERT_EQ(faults.size(), 1U) << (faults.empty() ? key : faults[1].key + faults[1].message);
  EXPECT_EQ(faults[0].key, key);
  EXPECT_EQ(faults[0].line, line);
  const std::string said = faults[0].message + " (allowed: " + faults[0].allowed + ")";
  for (const std::string& part : parts) EXPECT_TRUE(says(said, part)) << said;
}

TEST(CaseRim, IsReadAndWrittenToTheSameBits) {
  for (const std::vector<std::string>& settings : {std::vector<std::string>{},
                                                   {"rim.free=[]", "rim.force_y=0", "rim.torque=0",
                                                    "rim.brake=0", "rim.support.y.damping=0"}}) {
    const Case c = read_text(wheel, settings);
    const std::string text = write_case(c);
    EXPECT_EQ(write_case(read_text(text)), text);
  }
  const Case c = read_text(wheel);
  ASSERT_TRUE(c.rim.has_value());
  EXPECT_FALSE(c.rim->free_x);
  EXPECT_TRUE(c.rim->free_y);
  EXPECT_TRUE(c.rim->free_spin);
  EXPECT_EQ(c.rim->mass, 100.0);
  EXPECT_EQ(c.rim->force_y.at(0.005), -7.5e4);
  EXPECT_EQ(c.rim->support_y.damping, 6e4);
  EXPECT_TRUE(says(write_case(read_text(with_rim("free = []\n"))), "\nfree = []\n"));
  EXPECT_FALSE(says(write_case(read_text(base)), "rim.free"));
}

TEST(CaseRim, SupportsAreAtRestWhereTheCenterStarts) {
  EXPECT_EQ(read_text(wheel, {"rim.support.y.at=1"}).rim->support_y.at, 1.0);
  EXPECT_EQ(read_text(wheel).rim->support_y.at, 0.29);
  EXPECT_EQ(read_text(wheel).rim->support_x.at, -0.35);
}

TEST(CaseRim, FreeIsAListOfNames) {
  const auto refused = [](const std::string& free, const std::string& message) {
    expect_fault(with_rim("free = " + free + "\n"), "rim.free", rim_line,
                 {message, "[], or any of \"speed\", \"height\", \"angular_velocity\""});
  };
  refused("'height'", "must be an array of strings, not a string");
  refused("[1]", "must be a string, not an integer");
  refused("['spin']", "is not one of the choices");
  refused("['height', 'height']", "stands there twice");
  expect_fault(with_rim("mass = 1\n"), "rim.free", rim_line - 1, {"is missing"});
}

TEST(CaseRim, NoLoadOnWhatIsHeld) {
  const std::string head = "free = []\n";
  for (const auto& [line, key, dof] : std::vector<std::array<std::string, 3>>{
           {"force_x = 1", "rim.force_x", "speed"},
           {"force_y = [[0, 0], [1, -2]]", "rim.force_y", "height"},
           {"torque = -3", "rim.torque", "angular_velocity"},
           {"brake = 3", "rim.brake", "angular_velocity"},
           {"support.x.stiffness = 3", "rim.support.x.stiffness", "speed"},
           {"support.x.damping = 3", "rim.support.x.damping", "speed"},
           {"support.y.stiffness = 3", "rim.support.y.stiffness", "height"},
           {"support.y.damping = 3", "rim.support.y.damping", "height"},
           {"support.x.at = 0", "rim.support.x.at", "speed"},
           {"support.y.at = 0.3", "rim.support.y.at", "height"}})
    expect_fault(with_rim(head + line + "\n"), key, rim_line + 1,
                 {"has no effect, because motion." + dof + " is held", "rim.free with \"" + dof});
  EXPECT_TRUE(faults_of(with_rim(head + "force_x = 0.0\nbrake = 0\n")).empty());
}

TEST(CaseRim, NoTableOfWhatIsFree) {
  const std::string all =
      with_rim("free = ['speed', 'height', 'angular_velocity']\nmass = 1\ninertia = 1\n");
  const std::string table = " = [[0, 1], [1, 2]]";
  const std::array<std::string, 3> dofs{"angular_velocity", "speed", "height"};
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const int line = 19 + static_cast<int>(k);
    expect_fault(with_line(line, dofs[k] + table, all), "motion." + dofs[k], line,
                 {"is a table, but rim.free names it", "the value at t = 0", '"' + dofs[k] + '"'});
  }
  EXPECT_TRUE(faults_of(with_line(20, "speed = [[0, 1]]", all)).empty());
}

TEST(CaseRim, WhatIsFreeHasAMass) {
  expect_fault(with_rim("free = ['speed']\n"), "rim.mass", rim_line - 1,
               {"is missing: rim.free has \"speed\"", ">= 0"});
  expect_fault(with_rim("free = ['height']\n"), "rim.mass", rim_line - 1, {"has \"height\""});
  expect_fault(with_rim("free = ['angular_velocity']\n"), "rim.inertia", rim_line - 1,
               {"has \"angular_velocity\""});
  EXPECT_TRUE(faults_of(with_rim("free = ['speed']\nmass = 0\n")).empty()) << "bonded nodes have";
}

TEST(CaseRim, NothingIsNegative) {
  for (const std::string line :
       {"mass = -1", "inertia = -1", "brake = -1", "support.y.stiffness = -1",
        "support.y.damping = -1", "support.x.stiffness = -1", "support.x.damping = -1"}) {
    const std::string key = "rim." + line.substr(0, line.find(' '));
    const auto faults =
        faults_of(with_rim("free = ['height', 'angular_velocity']\n" + line + '\n'));
    const auto found = std::ranges::find(faults, key, &Fault::key);
    ASSERT_NE(found, faults.end()) << key;
    EXPECT_EQ(found->message, "is out of bounds");
    EXPECT_EQ(found->line, rim_line + 1);
    EXPECT_TRUE(says(found->allowed, ">= 0")) << found->allowed;
  }
  expect_fault(wheel, "rim.brake", 0, {"the value is out of bounds", "values >= 0"},
               {"rim.brake=[[0, 1], [1, -1], [2, 0]]"});
}

TEST(CaseRim, NeedsARimAndItsStep) {
  expect_fault(wheel, "time.scheme", 0, {"forces move", "\"symplectic\""},
               {"time.scheme=as-printed"});
  const auto faults = faults_of(wheel, {"disk.rim=free"});
  EXPECT_NE(std::ranges::find(faults, "disk.rim", &Fault::key), faults.end());
  const auto crush = faults_of(wheel, {"analysis.kind=crush", "analysis.depth=0.01",
                                       "analysis.increments=3", "ground.profile=flat"});
  ASSERT_EQ(crush.size(), 1U);
  EXPECT_EQ(crush[0].key, "rim");
  EXPECT_EQ(crush[0].line, rim_line - 1);
  const std::string mesh = R"(schema = 1
time.end = 0.2
[rim]
free = []
[mesh]
file = "/folder/two.msh"
[material]
youngs_modulus = 5e6
poissons_ratio = 0.3
density = 1100
)";
  expect_fault(mesh, "mesh.clamped", 5, {"a body is free", "or no [rim]"});
}

TEST(CaseRim, FaultsComeAllAtOnce) {
  const auto faults = faults_of(with_rim("free = ['height']\ntorque = 1\ninertia = -1\n"),
                                {"motion.height=[[0, 1], [1, 2]]", "motion.slope=1.6"});
  std::set<std::string> keys;
  for (const Fault& fault : faults) keys.insert(fault.key);
  EXPECT_EQ(keys, (std::set<std::string>{"rim.torque", "rim.inertia", "rim.mass", "motion.height",
                                         "motion.slope"}));
}

TEST(CaseRim, WarnsWhereNothingPresses) {
  const std::string part = "nothing presses the wheel";
  EXPECT_FALSE(warned_of(read_text(wheel), part));
  EXPECT_TRUE(warned_of(read_text(wheel, {"rim.force_y=0"}), part));
  EXPECT_TRUE(warned_of(read_text(wheel, {"rim.force_y=[[0, 0], [1, 5]]"}), part));
  EXPECT_FALSE(warned_of(read_text(wheel, {"rim.force_y=0", "motion.gravity=9.81"}), part));
  EXPECT_FALSE(warned_of(read_text(wheel, {"rim.force_y=0", "rim.support.y.stiffness=1e5"}), part));
}

TEST(CaseRim, WarnsOfTheStiffnessOfAnotherSpin) {
  const std::vector<std::string> stiffened{"material.stress_stiffening=centrifugal"};
  EXPECT_TRUE(warned_of(read_text(wheel, stiffened), "that of the spin at t = 0"));
  EXPECT_FALSE(warned_of(read_text(with_rim("free = []\n"), stiffened), "spin at t = 0"));
}

}  // namespace
}  // namespace rondo::study::case_rim_test
