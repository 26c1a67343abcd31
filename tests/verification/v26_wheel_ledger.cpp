// SPDX-License-Identifier: BSD-3-Clause
/// V26: the energy ledger of a wheel whose rim forces move closes over 1e5 steps of each row of
/// V22 to V24, and momenta are kept in flight. Source: the identities themselves.
#include <gtest/gtest.h>

#include "support/traps.hpp"
#include "support/wheel_momenta.hpp"
#include "support/wheel_rows.hpp"

namespace v26_wheel_ledger {

using namespace rondo;

namespace {

constexpr long long many = 100000;  // steps
const test::Settings coarse{"disk.mesh.radial=6", "disk.mesh.circumferential=90", "time.end=10"};

class WheelLedger : public testing::TestWithParam<test::WheelRow> {};

}  // namespace

/// On a coarser mesh; what drives the launch goes when it has its speed.
TEST_P(WheelLedger, Closes) {
  test::Settings settings = test::with(coarse, GetParam().settings);
  if (GetParam().name == std::string("launch"))
    settings.emplace_back("rim.torque=[[0, 0], [0.05, 0], [0.06, 1e4], [0.5, 1e4], [0.6, 0]]");
  test::Wheel wheel(settings);
  const test::FloatingPointTraps traps;
  int touching = 0;
  wheel.run().advance(many, [&](const dynamics::StepReport& r) { touching += r.contact.nodes; });
  RecordProperty("relative", fmt::format("{:.2g}", wheel.run().balance().relative));
  EXPECT_GT(touching, 0);
  EXPECT_LT(wheel.run().balance().relative, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, WheelLedger, testing::ValuesIn(test::all_rows()),
                         [](const auto& p) { return p.param.name; });

/// All held, as without a [rim], with tables for all three: round-off does not add up.
TEST(WheelLedgerHeld, Closes) {
  test::Wheel wheel(test::with(
      coarse, {"rim.free=[]", "rim.force_y=0", "rim.support.y.damping=0", "motion.gravity=9.81",
               "motion.height=[[0, 0.3], [0.05, 0.292], [1.0, 0.2925], [1.5, 0.292]]",
               "motion.speed=[[0, 10], [0.5, 10], [1.5, 5]]",
               "motion.angular_velocity=[[0, 33.7], [0.5, 33.7], [1.5, 16.2]]"}));
  const test::FloatingPointTraps traps;
  wheel.run().advance(many);
  const dynamics::Balance& b = wheel.run().balance();
  RecordProperty("relative", fmt::format("{:.2g}", b.relative));
  EXPECT_NE(b.works.held, 0.0);
  const dynamics::FrameStep& f = wheel.run().report().frame;
  const dynamics::Motion& motion = wheel.run().model().motion;
  EXPECT_NEAR(f.angle, motion.angle(f.time), 1e-13 * std::abs(f.angle));  // where the tables say
  EXPECT_LT(norm(f.center - motion.center(f.time)), 1e-13 * norm(f.center));
  EXPECT_LT(b.relative, 1e-14);
}

/// Thrown with spin, both dampings on: nothing outside acts on it.
TEST(WheelLedgerFlight, MomentaAreKept) {
  for (const double load : {0.0, -2e3}) {
    test::Wheel wheel(
        test::with(coarse, {test::all_free, "motion.speed=0.5", "motion.angular_velocity=-20",
                            "initial.velocity=[0.3, -0.2]", "rim.support.y.damping=0",
                            fmt::format("rim.force_y=[[0, {0}], [0.01, {0}], [0.011, 0]]", load),
                            "ground.profile=[[-1, -1e4], [1, -1e4]]"}));
    const test::FloatingPointTraps traps;
    wheel.run().advance(load == 0.0 ? 1 : 1000);  // the load has gone
    const dynamics::Model& model = wheel.run().model();
    const test::WheelMomenta before = test::wheel_momenta(model, wheel.run().state());
    wheel.run().advance(many);
    const test::WheelMomenta after = test::wheel_momenta(model, wheel.run().state());
    const double linear = norm(after.linear - before.linear) / norm(before.linear);
    const double angular = std::abs(after.angular / before.angular - 1.0);
    RecordProperty(fmt::format("linear_{:.0f}", load), fmt::format("{:.2g}", linear));
    RecordProperty(fmt::format("angular_{:.0f}", load), fmt::format("{:.2g}", angular));
    EXPECT_LT(linear, 1e-12);
    EXPECT_LT(angular, 1e-12);
    EXPECT_GT(std::abs(wheel.run().report().frame.angle), 50.0);
    EXPECT_EQ(wheel.run().balance().works.contact, 0.0);
  }
}

}  // namespace v26_wheel_ledger
