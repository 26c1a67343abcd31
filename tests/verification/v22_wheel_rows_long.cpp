// SPDX-License-Identifier: BSD-3-Clause
/// V22 to V24 on the finest mesh.
#include "support/wheel_rows.hpp"

using namespace rondo;

namespace {
class WheelsLong : public testing::TestWithParam<test::WheelRow> {};
}  // namespace

TEST_P(WheelsLong, AreAsAnotherProgramHasThem) {
  test::expect_row(GetParam(), test::Column::fine);
}

INSTANTIATE_TEST_SUITE_P(All, WheelsLong, testing::ValuesIn(test::all_rows()),
                         [](const auto& p) { return p.param.name; });
