// SPDX-License-Identifier: BSD-3-Clause
/// V18: forces of the ground on the smooth disk in steady rolling, for four coefficients of
/// friction, by both operators. Expected: an independent code of the same scheme on the same mesh
/// (docs/validation.md).
#include <gtest/gtest.h>

#include <tuple>

#include "support/models.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace v18_rolling_friction {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

struct Row {
  const char* name;
  double friction, force_x, force_y;
};

class Rolling : public testing::TestWithParam<std::tuple<Row, StiffnessOperator>> {};

}  // namespace

TEST_P(Rolling, MeanForces) {
  const auto& [row, of] = GetParam();
  auto b = test::build(test::rolling_disk(12, 180));
  test::add_ground(b, test::ledge(), {row.friction, 0.0});
  test::Stepping run(b, of);
  const test::FloatingPointTraps traps;
  Vec2 impulse;
  double time = 0.0, scale = 0.0, residual = 0.0;
  run.advance_to(0.12, [&](const StepReport& step) {
    scale = std::max(scale, step.contact.free_velocity);
    residual = std::max(residual, step.contact.residual);
    if (step.frame.time <= 0.095) return;
    impulse += step.contact.impulse.plane();
    time += b.model.dt;
  });
  // 0.5 % of the normal force: the reference's own scatter with the step and the start.
  EXPECT_NEAR(impulse.y / time, row.force_y, 0.005 * row.force_y);
  EXPECT_NEAR(impulse.x / time, row.force_x, 0.005 * std::abs(row.force_x) + 1e-9);
  EXPECT_LT(run.balance().relative, 1e-13);
  EXPECT_LT(residual, 1e-14 * scale);
}

INSTANTIATE_TEST_SUITE_P(
    All, Rolling,
    testing::Combine(testing::Values(Row{"frictionless", 0.0, 0.0, 1.8944e5},
                                     Row{"friction_2", 0.2, -1.824e4, 1.8968e5},
                                     Row{"friction_4", 0.4, -2.189e4, 1.8983e5},
                                     Row{"friction_6", 0.6, -2.308e4, 1.9000e5}),
                     testing::ValuesIn(test::both_operators)),
    [](const auto& p) { return test::name(std::get<0>(p.param).name, std::get<1>(p.param)); });

}  // namespace v18_rolling_friction
