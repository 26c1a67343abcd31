// SPDX-License-Identifier: BSD-3-Clause
/// V3: a bar falls and bounces under gravity (docs/validation.md). Expected: the periodic solution
/// of Doyen, Ern, Piperno, SIAM J. Sci. Comput. 33 (2011), section 4.2; the energy after a period
/// is that of an independent program of the same scheme in one dimension.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/bars.hpp"
#include "support/traps.hpp"

namespace v03_bouncing_bar {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr double gravity = 10.0, height = 5.0;                   // of the fall
constexpr double transit = 1.0 / 3.0;                            // L/c
constexpr double mass = 10.0, energy = mass * gravity * height;  // per unit area

struct Row {
  int elements;
  double left;  ///< of the energy, after a period
  fem::Plane plane;
};

class BouncingBar : public testing::TestWithParam<Row> {};

}  // namespace

TEST_P(BouncingBar, KeepsThePeriodAndLosesWhatItsFootLoses) {
  const test::Bar bar{.gap = height, .elements = GetParam().elements, .plane = GetParam().plane};
  Model model = test::bar_model(bar);
  model.motion.gravity = Table(gravity);
  const std::vector<Vec2> none(model.n_nodes());
  test::Stepping run(model, start(model, none, none));
  const test::FloatingPointTraps traps;
  const test::BarCourse course = test::course_of(bar, run, 16.0 * transit);
  // Contact while a wave goes up and comes back, after a fall of 3 L/c; the second flight, up and
  // down, is twice as long. Bounds: the front, spread in each of the two contacts.
  const auto contacts = test::phases(course, 0.5);
  ASSERT_EQ(contacts.size(), 2u);
  const double step = 1.001 * bar.step(), front = 0.5 * test::front_spread(bar);
  EXPECT_NEAR(course.time[contacts[0].first], 3.0 * transit, step);
  EXPECT_NEAR(course.time[contacts[0].last], 5.0 * transit, front);
  EXPECT_NEAR(course.time[contacts[1].first], 11.0 * transit, front);
  EXPECT_NEAR(course.time[contacts[1].last], 13.0 * transit, 2.0 * front);
  // All the energy at the half step: kinetic, strain, weight.
  double moment = 0.0;
  const State& s = run.state();
  for (std::size_t k = 0; k < model.n_nodes(); ++k)
    moment += model.mass[k] * (position(model, s, k).y - 0.5 * model.dt * s.v.plane()[k].y);
  const double weight = gravity * (moment / bar.width() - mass * 0.5 * bar.length);
  const double left = (course.energy.back() + weight) / energy;
  RecordProperty("left", fmt::format("{:.7f}", left));
  RecordProperty("height", fmt::format("{:.6f}", moment / bar.mass() - 0.5 * bar.length));
  EXPECT_NEAR(left, GetParam().left, 5e-6);  // the figures that are given
  // Nothing else than the impacts takes it: but for the start, half a step late, (g Δt)²/4.
  EXPECT_NEAR(left, 1.0 - course.lost.back() / energy, std::pow(0.5 * gravity * bar.step(), 2));
  EXPECT_LT(course.relative, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, BouncingBar,
                         testing::Values(Row{100, 0.99127, fem::Plane::stress},
                                         Row{200, 0.99608, fem::Plane::strain},
                                         Row{400, 0.99789, fem::Plane::stress}),
                         [](const auto& p) { return fmt::format("N{}", p.param.elements); });

}  // namespace v03_bouncing_bar
