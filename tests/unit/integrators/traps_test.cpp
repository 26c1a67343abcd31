// SPDX-License-Identifier: BSD-3-Clause
/// The traps see what they are there for: without these tests traps that are off look like a step
/// that is right.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>

#include "integrator_cases.hpp"
#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace traps_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

/// Of a body with contact, by one thread or more; the last node's velocity is `v` at the start.
void make_two_steps(StiffnessOperator of, int threads, double v) {
  const test::Built b = test::build(test::everything("", 3, 150));
  Model model = test::model_with(b, of);
  model.threads = threads;
  State state = test::start_at_rest(model);
  state.v_next.plane()[static_cast<std::size_t>(model.free.back())].x = v;
  const auto integrator = make_integrator(model, state);
  std::array<StepReport, 2> reports;
  integrator->advance(reports);
}

constexpr double too_fast = 1e200;  // its energy is beyond the largest number

}  // namespace

class Traps : public testing::TestWithParam<StiffnessOperator> {};

TEST_P(Traps, ANumberThatOverflowsInAStepEndsTheProgram) {
  const auto trapped = [&](double v) {
    const test::FloatingPointTraps traps;
    make_two_steps(GetParam(), 1, v);
  };
  EXPECT_DEATH(trapped(too_fast), "");
  trapped(1.0);
}

/// 0/0, ∞ - ∞ and the like: here ∞ times 0, and its comparisons.
TEST_P(Traps, ANumberThatBecomesNoneInAStepEndsTheProgram) {
  const auto trapped = [&] {
    const test::FloatingPointTraps traps;
    make_two_steps(GetParam(), 1, std::numeric_limits<double>::infinity());
  };
  EXPECT_DEATH(trapped(), "");
}

#ifdef RONDO_TRAPS
TEST_P(Traps, AreInEveryThreadOfAStepWithoutBeingAskedFor) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (const int threads : {1, 2, 3}) {
    SCOPED_TRACE(threads);
    EXPECT_DEATH(make_two_steps(GetParam(), threads, too_fast), "");
    make_two_steps(GetParam(), threads, 1.0);
  }
}

TEST_P(Traps, AreLeftAsTheyWereInEachThread) {
  make_two_steps(GetParam(), 1, 1.0);
  EXPECT_EQ(fegetexcept(), 0);
  const test::NoStepTraps no_traps;
  make_two_steps(GetParam(), 2, too_fast);
}

TEST(StepTraps, AreInTheGeneralStep) {
  const test::Built b = test::build(test::everything("", 3, 21));
  State state = test::start_at_rest(b.model);
  state.v_next.plane()[static_cast<std::size_t>(b.model.free.back())].x = too_fast;
  GeneralIntegrator integrator(b.model, state);
  StepReport report;
  EXPECT_DEATH(integrator.advance({&report, 1}), "");
}
#endif

INSTANTIATE_TEST_SUITE_P(Both, Traps, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });

}  // namespace traps_test
