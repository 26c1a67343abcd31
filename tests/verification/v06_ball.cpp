// SPDX-License-Identifier: BSD-3-Clause
/// V6: a ball, one node with restitution, dropped from 1 m (docs/validation.md). Expected: the
/// bounces of a point, apexes e^{2k} h, at rest at √(2h/g) (1 + e)/(1 - e).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace v06_ball {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr double gravity = 9.81, height = 1.0;

Model ball(double restitution, double dt) {
  Model m;
  m.reference = {{0.0, height}};
  m.mass = {2.0};
  m.free = {0};
  m.stiffness.row_start = {0, 0};
  m.motion.gravity = Table(gravity);
  m.contact.emplace(
      ContactModel{contact::Ground(contact::GroundShape{}), {0.0, restitution}, {0}, {1.0}});
  m.dt = dt;
  return m;
}

struct Row {
  const char* name;
  double restitution, rest;  ///< [-], time by which it is at rest [s]
  std::size_t apexes;        ///< that are compared
};

class Ball : public testing::TestWithParam<Row> {};

}  // namespace

TEST_P(Ball, BouncesAndComesToRest) {
  const double dt = 1e-5, e = GetParam().restitution;
  const Model model = ball(e, dt);
  const std::vector<Vec2> none(1);
  test::Stepping run(model, start(model, none, none));
  const test::FloatingPointTraps traps;
  double impact = 0.0, top = 0.0, last_move = 0.0, before = height;
  std::vector<double> apexes;
  bool flies = true;
  while (run.report().frame.time < GetParam().rest + 0.1) {
    const bool pressed = run.advance().nodes > 0;
    const double y = height + run.state().u.plane()[0].y, time = run.report().frame.time;
    if (pressed && impact == 0.0) impact = time;
    if (pressed && flies) apexes.push_back(top);  // the one before this bounce; first: the start
    top = pressed ? 0.0 : std::max(top, y);
    flies = !pressed;
    if (std::abs(y - before) > gravity * dt * dt) last_move = time;
    before = y;
  }
  EXPECT_GE(impact, 0.451524);
  EXPECT_LE(impact, 0.451524 + 1.001 * dt);  // seen at the next step
  // A ball that is seen late flies from up to |v| Δt under the ground, at each bounce anew, and
  // each bounce keeps e² of the height.
  const double late = std::sqrt(2.0 * gravity * height) * dt / (1.0 - e * e);
  ASSERT_GT(apexes.size(), GetParam().apexes);
  for (std::size_t k = 1; k <= GetParam().apexes; ++k)
    EXPECT_NEAR(apexes[k], std::pow(e, 2.0 * static_cast<double>(k)) * height, late) << k;
  // At rest by the time: the last bounces, shorter than a step, are not there. What is left, less
  // than gravity does in a step, changes sign and is e times as much at each, by Moreau's law.
  EXPECT_LE(last_move, GetParam().rest);
  EXPECT_GT(last_move, GetParam().rest - 50.0 * dt);
  RecordProperty("rest", fmt::format("{:.6f}", last_move));
  EXPECT_LT(norm(run.state().v.plane()[0]), 1e-300);
  // All the energy of the fall is lost in impacts, but for the depth that it rests at.
  EXPECT_NEAR(run.balance().works.loss_impact, 2.0 * gravity * height, 1e-8);
  EXPECT_LT(run.balance().relative, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(All, Ball,
                         testing::Values(Row{"half", 0.5, 1.354571, 5},
                                         Row{"nine_tenths", 0.9, 8.578949, 12}),
                         [](const auto& p) { return p.param.name; });

}  // namespace v06_ball
