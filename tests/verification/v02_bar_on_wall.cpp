// SPDX-License-Identifier: BSD-3-Clause
/// V2: a free bar hits a wall (docs/validation.md). Expected: d'Alembert's solution; the loss of
/// the first impact is that of the mass of the foot, the rebound that of an independent program of
/// the same scheme in one dimension.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/bars.hpp"
#include "support/traps.hpp"

namespace v02_bar_on_wall {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr double speed = 10.0, mass = 10.0;             // of the fall; per unit area
constexpr double energy = 0.5 * mass * speed * speed;   // the same
constexpr double touch = 0.5, leave = 0.5 + 2.0 / 3.0;  // gap/v, and 2L/c later

struct Hit {
  test::BarCourse course;
  std::vector<test::Phase> contacts;
  double rebound = 0.0;  ///< velocity of the center of mass after it [m/s]
};

Hit hit(const test::Bar& bar) {
  const Model model = test::bar_model(bar);
  const std::vector<Vec2> none(model.n_nodes()), v(model.n_nodes(), Vec2{0.0, -speed});
  test::Stepping run(model, start(model, none, v));
  const test::FloatingPointTraps traps;
  Hit h;
  h.course = test::course_of(bar, run, 1.5);
  h.contacts = test::phases(h.course, 0.1);
  h.rebound = test::momentum(model, run.state()).linear.y / bar.mass();
  return h;
}

struct Row {
  int elements;
  double rebound;  ///< at a Courant number of 0.9 [m/s]
  fem::Plane plane;
};

class BarOnWall : public testing::TestWithParam<Row> {};

}  // namespace

TEST_P(BarOnWall, ReboundsAsTheSchemeHasItInOneDimension) {
  const test::Bar bar{.elements = GetParam().elements, .plane = GetParam().plane};
  const Hit h = hit(bar);
  RecordProperty("rebound", fmt::format("{:.6f}", h.rebound));
  EXPECT_NEAR(h.rebound, GetParam().rebound, 5e-5);  // the figures that are given
  ASSERT_EQ(h.contacts.size(), 1u);
  const test::Phase& contact = h.contacts[0];
  EXPECT_NEAR(h.course.time[contact.first], touch, 1.001 * bar.step());  // seen at the next step
  EXPECT_NEAR(h.course.time[contact.last], leave, 0.5 * test::front_spread(bar));
  // The foot alone is stopped: ½ m_c v², its mass half of an element's.
  EXPECT_NEAR(h.course.lost[contact.first + 1] / (energy / (2.0 * bar.elements)), 1.0, 1e-12);
  EXPECT_LT(h.course.relative, 1e-12);
}

/// At a Courant number of 1 the scheme has no dispersion: a wave goes on by an element a step.
TEST_P(BarOnWall, IsExactWhereTheStepIsCritical) {
  const test::Bar bar{.elements = GetParam().elements, .courant = 1.0, .plane = GetParam().plane};
  const Hit h = hit(bar);
  ASSERT_EQ(h.contacts.size(), 1u);
  const test::Phase& contact = h.contacts[0];
  const auto& p = h.course.pressure;
  // The first impulse stops the foot, half a node; then ρcv for as long as the wave is on its way,
  // there and back: 2N steps. Round-off of alternating modes, whose growth is linear at this step,
  // reaches 1e-9 of it at most; a last step may be made of it alone.
  const double full = 300.0, steps = 2.0 * bar.elements;
  EXPECT_NEAR(p[contact.first], 0.5 * full, 1e-8 * full);
  for (std::size_t i = contact.first + 1; i < contact.first + static_cast<std::size_t>(steps); ++i)
    ASSERT_NEAR(p[i], full, 1e-8 * full) << i - contact.first;
  for (std::size_t i = contact.first + static_cast<std::size_t>(steps); i < p.size(); ++i)
    ASSERT_NEAR(p[i], 0.0, 1e-8 * full) << i - contact.first;
  EXPECT_NEAR(h.course.time[contact.first], touch, 1.001 * bar.step());
  // So much momentum gives back the velocity, but for that of the foot.
  EXPECT_NEAR(h.rebound, speed * (1.0 - 1.0 / steps), 1e-9);
  EXPECT_NEAR(h.course.lost.back() / (energy / steps), 1.0, 1e-9);
  EXPECT_LT(h.course.relative, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, BarOnWall,
                         testing::Values(Row{100, 9.9155, fem::Plane::stress},
                                         Row{200, 9.9505, fem::Plane::strain},
                                         Row{400, 9.9688, fem::Plane::stress}),
                         [](const auto& p) { return fmt::format("N{}", p.param.elements); });

}  // namespace v02_bar_on_wall
