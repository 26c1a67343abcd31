// SPDX-License-Identifier: BSD-3-Clause
/// V5: a slow impact of a steel bar (docs/validation.md). Expected: d'Alembert's solution.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/bars.hpp"
#include "support/traps.hpp"

namespace v05_steel_bar {

using namespace rondo;
using namespace rondo::dynamics;

TEST(SteelBar, HitsAWall) {
  const double section = 3.14e-4, speed = 0.1;
  for (const int n : {100, 200, 400}) {
    const test::Bar bar{.youngs_modulus = 210e9,
                        .density = 7800.0,
                        .length = 1.0,
                        .gap = 5e-5,
                        .elements = n,
                        .courant = 1.0};
    const Model model = test::bar_model(bar);
    const std::vector<Vec2> none(model.n_nodes()), v(model.n_nodes(), Vec2{0.0, -speed});
    test::Stepping run(model, start(model, none, v));
    const test::FloatingPointTraps traps;
    const test::BarCourse course = test::course_of(bar, run, 1.2e-3);
    const auto contacts = test::phases(course, 1e-4);
    ASSERT_EQ(contacts.size(), 1u);
    const auto [first, last] = contacts[0];
    EXPECT_NEAR(course.time[first], 5e-4, 1.001 * bar.step());  // seen at the next step
    // 2N steps in all: one more may be made of round-off.
    EXPECT_NEAR(course.time[last] - course.time[first], 3.8545e-4, 1.001 * bar.step());
    // From the second step on, when the foot has been stopped; the figures that are given, and
    // round-off, which grows linearly at a Courant number of 1.
    const double force = section * course.pressure[first + 1];
    EXPECT_NEAR(force, 1270.83, 5e-3);
    for (std::size_t i = first + 1; i < first + static_cast<std::size_t>(2 * n); ++i)
      ASSERT_NEAR(section * course.pressure[i], force, 1e-8 * force) << i - first;
    EXPECT_LT(course.relative, 1e-12);
  }
}

}  // namespace v05_steel_bar
