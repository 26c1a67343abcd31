// SPDX-License-Identifier: BSD-3-Clause
/// The same as v42_transient_rolling.cpp over one and a half contact lengths (docs/validation.md,
/// V42).
#include <gtest/gtest.h>

#include "support/start_of_rolling.hpp"

namespace v42_transient_rolling_long {

using namespace rondo;

TEST(TransientRollingLong, TwoSpheresCreepAsInContact) {
  test::expect_creeps_of_contact(test::start_of_rolling(41));
}

}  // namespace v42_transient_rolling_long
