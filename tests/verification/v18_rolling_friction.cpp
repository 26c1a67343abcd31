// SPDX-License-Identifier: BSD-3-Clause
/// V18: forces of the ground on the smooth disk in steady rolling, for four coefficients of
/// friction. Expected: an independent code of the same scheme on the same mesh
/// (docs/validation.md).
#include <gtest/gtest.h>

#include "support/models.hpp"
#include "support/traps.hpp"

using namespace rondo;
using namespace rondo::dynamics;

namespace {

struct Row {
  double friction, force_x, force_y;
};

class Rolling : public testing::TestWithParam<Row> {};

}  // namespace

TEST_P(Rolling, MeanForces) {
  const Row row = GetParam();
  auto b = test::build(test::rolling_disk(12, 180));
  test::add_ground(b, test::ledge(), {row.friction, 0.0});
  State state = test::start_at_rest(b.model);
  Ledger ledger;
  const test::FloatingPointTraps traps;
  Vec2 impulse;
  double time = 0.0, scale = 0.0, residual = 0.0;
  while (state.frame.time < 0.12) {
    const ContactReport r = advance(b.model, state, ledger);
    scale = std::max(scale, r.free_velocity);
    residual = std::max(residual, r.residual);
    if (state.frame.time <= 0.095) continue;
    impulse += r.impulse;
    time += b.model.dt;
  }
  // 0.5 % of the normal force: the reference's own scatter with the step and the start.
  EXPECT_NEAR(impulse.y / time, row.force_y, 0.005 * row.force_y);
  EXPECT_NEAR(impulse.x / time, row.force_x, 0.005 * std::abs(row.force_x) + 1e-9);
  EXPECT_LT(ledger.last().relative, 1e-13);
  EXPECT_LT(residual, 1e-14 * scale);
}

INSTANTIATE_TEST_SUITE_P(All, Rolling,
                         testing::Values(Row{0.0, 0.0, 1.8944e5}, Row{0.2, -1.824e4, 1.8968e5},
                                         Row{0.4, -2.189e4, 1.8983e5},
                                         Row{0.6, -2.308e4, 1.9000e5}));
