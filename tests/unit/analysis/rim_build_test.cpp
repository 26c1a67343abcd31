// SPDX-License-Identifier: BSD-3-Clause
/// A case with [rim] to its model: masses, step, figures, what only the mesh tells is wrong.
#include <gtest/gtest.h>

#include "rondo/analysis/build/build.hpp"
#include "support/wheel.hpp"
#include "unit/analysis/mesh_fixture.hpp"

namespace rondo::study::test::rim_build_test {
namespace {

const std::string& wheel = rondo::test::wheel_text;

std::string figure(const study::Setup& s, const std::string& name) {
  for (const auto& [what, value] : s.figures)
    if (what == name) return value;
  return {};
}

Fault refusal(const Case& c) {
  try {
    build(c, 1);
  } catch (const InputError& error) {
    return error.faults().front();
  }
  return {};
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// By an eigen-solve of another program: 1.989712e-5 s, without mass damping 1.993297e-5 s.
TEST(RimBuild, StepOfTheWheel) {
  EXPECT_NEAR(build(read_text(wheel), 1).model.dt, 1.989712e-5, 2e-11);
  EXPECT_NEAR(build(read_text(wheel, {"damping.mass=0"}), 1).model.dt, 1.993297e-5, 2e-11);
  const study::Setup stiff = build(read_text(wheel, {"rim.support.y.stiffness=1e12"}), 1);
  EXPECT_LT(stiff.model.dt, 1.6e-5);
  EXPECT_TRUE(stiff.critical.proven);
  EXPECT_GE(stiff.critical.element_bound, stiff.critical.omega);
}

TEST(RimBuild, MassesAreWithTheBondedNodes) {
  const study::Setup s = build(read_text(wheel), 1);
  const dynamics::RimBody& rim = s.model.rim.value();
  double bonded = 0.0;
  for (const int node : s.mesh.clamped) bonded += s.model.mass[static_cast<std::size_t>(node)];
  EXPECT_GT(bonded, 6.0);
  EXPECT_DOUBLE_EQ(rim.mass, 100.0 + bonded);
  EXPECT_NEAR(rim.inertia, 1.0 + 0.0225 * bonded, 1e-12);
  EXPECT_EQ(rim.force_y.at(1.0), -1.5e5);
  EXPECT_EQ(rim.support_y.at, 0.3);
  EXPECT_EQ(build(read_text(wheel, {"motion.slope=0.1"}), 1).model.motion.slope, 0.1);
}

/// Loads are of the run, masses and what is free of the body.
TEST(RimBuild, RunsShareTheBody) {
  SharedBody shared;
  const study::Setup first = build(read_text(wheel), 1, &shared);
  const std::string key = shared.key;
  for (const char* setting :
       {"rim.force_y=-1e5", "rim.torque=[[0, 0], [1, 2]]", "rim.brake=3", "rim.support.y.damping=1",
        "rim.support.y.at=0.2", "motion.height=0.31"}) {
    const Case c = read_text(wheel, {setting});
    const study::Setup s = build(c, 1, &shared);
    EXPECT_EQ(shared.key, key) << setting;
    EXPECT_EQ(s.model.rim->mass, first.model.rim->mass);
    EXPECT_EQ(s.model.rim->force_y.points(), c.rim->force_y.points());
    EXPECT_EQ(s.model.rim->torque.points(), c.rim->torque.points());
    EXPECT_EQ(s.model.rim->support_y.at, c.rim->support_y.at);
  }
  for (const char* setting : {"rim.mass=1", "rim.inertia=2", "rim.free=['height']",
                              "rim.support.y.stiffness=1e5", "damping.mass=100"})
    EXPECT_NE(body_key(read_text(wheel, {setting})), body_key(read_text(wheel))) << setting;
}

TEST(RimBuild, TellsTheRim) {
  const study::Setup s = build(read_text(wheel, {"motion.gravity=9.81"}), 1);
  EXPECT_EQ(figure(s, "rim"), "free height, angular_velocity; held speed");
  EXPECT_EQ(figure(s, "rim mass"), "106.478 kg/m, of which 6.47822 of bonded nodes");
  EXPECT_EQ(figure(s, "rim inertia"), "1.14576 kg m, of which 0.14576 of bonded nodes");
  EXPECT_TRUE(says(figure(s, "load at the end"), "force_y -150000 N/m, torque 0 N, brake 0 N"));
  EXPECT_TRUE(says(figure(s, "load at the end"), "weight (0, -3268.85) N/m"));
  EXPECT_TRUE(says(figure(s, "support along y"), "dashpot 60000 N s/m2"));
  EXPECT_EQ(figure(s, "deflection"), "");
  EXPECT_EQ(figure(s, "slip ratio"), "");
  EXPECT_EQ(figure(s, "slip at t = 0"), "0.0109");
  EXPECT_TRUE(s.warnings.empty());
}

TEST(RimBuild, NoWideTurnsInAStep) {
  const Fault fault = refusal(read_text(wheel, {"motion.angular_velocity=2e4"}));
  EXPECT_EQ(fault.key, "motion.angular_velocity");
  EXPECT_TRUE(says(fault.message, "at most 0.3 rad")) << fault.message;
  EXPECT_TRUE(says(fault.allowed, "time.step of at most 1.5e-05")) << fault.allowed;
}

const std::string held_squares =
    squares + "[motion]\nspeed = 0\nheight = 0\nangular_velocity = 0\n[rim]\nfree = []\n";

TEST(RimBuild, BondedNodesAreBalancedAboutTheOrigin) {
  const MeshCaseFile file(held_squares);
  const Fault fault = refusal(file.read({"mesh.clamped=foot"}));
  EXPECT_EQ(fault.key, "mesh.clamped");
  EXPECT_TRUE(says(fault.message, "center of mass of the nodes bonded to the rim is (1.05, 0) m"))
      << fault.message;
  EXPECT_TRUE(says(fault.allowed, "balanced about the origin")) << fault.allowed;
}

/// The foot of the right square is no foot any more, and nothing holds it.
TEST(RimBuild, NoBodyIsFree) {
  const MeshCaseFile file(held_squares);
  std::string mesh = two_squares(0.1);
  for (const std::string line : {" 1 2 1 1 10 11", " 1 2 1 1 11 12"})
    mesh.replace(mesh.find(line), line.size(), " 1 2 3 3" + line.substr(8));
  std::ofstream(file.mesh(), std::ios::binary) << mesh;
  const Fault fault = refusal(file.read({"mesh.clamped=foot"}));
  EXPECT_EQ(fault.key, "mesh.clamped");
  EXPECT_TRUE(says(fault.message, "a body is free: a [rim] moves bodies that it holds"))
      << fault.message;
  EXPECT_TRUE(says(fault.allowed, "mesh.clamped that holds every body")) << fault.allowed;
}

}  // namespace
}  // namespace rondo::study::test::rim_build_test
