// SPDX-License-Identifier: BSD-3-Clause
/// V10, long times: a million steps without damping, by both operators.
#include "support/spin_up.hpp"

namespace v10_spin_up_long {

using namespace rondo;
using namespace rondo::dynamics;

namespace {
class SpinUpLong : public testing::TestWithParam<StiffnessOperator> {};
}  // namespace

TEST_P(SpinUpLong, OscillatesAboutTheStationarySpinForEver) {
  test::expect_oscillation_for_ever(GetParam(), 1000000);
}

INSTANTIATE_TEST_SUITE_P(Both, SpinUpLong, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });

}  // namespace v10_spin_up_long
