// SPDX-License-Identifier: BSD-3-Clause
/// A start in steady rolling obeys the equation of motion, and contact holds in its first step.
#include "rondo/analysis/build/steady_start.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rondo/analysis/build/build.hpp"
#include "rondo/case/case_rules.hpp"
#include "rondo/integrators/start.hpp"
#include "unit/case/case_fixture.hpp"

namespace steady_start_test {

using namespace rondo;
using study::build;
using study::flat_ground_below;

namespace {

constexpr const char* text = R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 8
circumferential = 90
[material]
youngs_modulus = 2e7
poissons_ratio = 0.3
density = 1100.0
[damping]
mass = 200.0
stiffness = 2e-5
[motion]
angular_velocity = 33.3
speed = 10.0
height = 0.29
gravity = 300.0
[ground]
profile = "flat"
friction = 0.4
[load]
pressure = [{curve = "tread", value = 5e4}]
[initial]
state = "steady-rolling"
[time]
end = 1e-3
safety = 0.1
)";

const std::vector<std::string> motions[] = {
    {}, {"motion.angular_velocity=-33.3", "motion.speed=-10.3"}, {"motion.speed=9.5"}};

/// Neither the contact nodes nor those below, to which their mass is moved.
bool is_inside(const study::Setup& s, std::size_t node) {
  return norm(s.model.reference[node]) < 0.25;
}

double apart(const study::Setup& s, std::span<const Vec2> a, std::span<const Vec2> b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (is_inside(s, k)) sum += s.model.mass[k] * dot(a[k] - b[k], a[k] - b[k]);
  return std::sqrt(sum);
}

TEST(SteadyStart, HalfAStepIsTheEquationOfMotion) {
  for (const auto& settings : motions) {
    const study::Setup s = build(study::test::read_text(text, settings), 1);
    const dynamics::State state = dynamics::start(s.model, s.displacement, s.velocity);
    const double change = apart(s, state.v_next, s.velocity);
    EXPECT_GT(change, 0.0);
    EXPECT_LT(apart(s, s.half_velocity, state.v_next), 0.03 * change);
    // Given, it is what the steps begin with.
    const dynamics::State given =
        dynamics::start(s.model, s.displacement, s.velocity, s.half_velocity);
    EXPECT_EQ(apart(s, given.v_next, s.half_velocity), 0.0);
  }
}

TEST(SteadyStart, WhatTouchesIsInContactInTheFirstStep) {
  for (const auto& settings : motions) {
    const study::Setup s = build(study::test::read_text(text, settings), 1);
    const dynamics::Model& m = s.model;
    const Vec2 center = m.motion.center(0.0).plane(),
               next = center + m.motion.advance(0.0, m.dt).plane();
    const Complex turned = rotation(m.motion.turn(0.0, m.dt));
    int touching = 0;
    for (const int node : m.contact->nodes) {
      const auto k = static_cast<std::size_t>(node);
      const Vec2 arm = m.reference[k] + s.displacement.plane()[k];
      const double gap = (center + arm).y;
      EXPECT_GT(gap, -1e-10);
      if (gap > 1e-10) continue;
      ++touching;
      const double then = (next + turned * (arm + m.dt * s.half_velocity.plane()[k])).y;
      EXPECT_LE(then, 0.0);
      EXPECT_GT(then, -1e-11);
    }
    EXPECT_GE(touching, 3);
  }
}

TEST(SteadyStart, OtherSettingsOfInitialAreAdded) {
  const study::Setup s = build(study::test::read_text(text), 1),
                     pushed =
                         build(study::test::read_text(text, {"initial.velocity=[0, 0.25]"}), 1);
  const auto free = static_cast<std::size_t>(s.model.free.front());
  EXPECT_EQ(pushed.displacement, s.displacement);
  EXPECT_NEAR((pushed.velocity.plane()[free] - s.velocity.plane()[free]).y, 0.25, 1e-12);
  EXPECT_NEAR((pushed.half_velocity.plane()[free] - s.half_velocity.plane()[free]).y, 0.25, 1e-12);
}

TEST(SteadyStart, GroundIsFlatBelowTheBody) {
  const auto ground = [](const char* profile) {
    const study::Case c = study::test::read_text(
        text, {"initial.state=rest", std::string("ground.profile=") + profile});
    return flat_ground_below(c, c.disk.outer_radius);
  };
  EXPECT_EQ(ground("[[-1, 0.1], [1, 0.1]]"), 0.1);
  EXPECT_EQ(ground("[[0, 0], [0.3, 0], [0.3, 0.1], [1, 0.1]]"), 0.0);
  EXPECT_EQ(ground("[[-1, 0.1], [-0.3, 0.1], [-0.3, 0], [0.1, 0]]"), 0.0);
  EXPECT_EQ(ground("[[-1, 0], [0.2, 0], [0.2, -0.1], [1, -0.1]]"), std::nullopt);
  EXPECT_EQ(ground("[[-1, 0], [1, 0.01]]"), std::nullopt);
  EXPECT_EQ(ground("[[-1, 0], [-0.25, 0], [-0.2, 0.1], [1, 0.1]]"), std::nullopt);
}

}  // namespace

}  // namespace steady_start_test
