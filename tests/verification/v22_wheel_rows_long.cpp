// SPDX-License-Identifier: BSD-3-Clause
/// V22 to V24 on the finest mesh: the rows of which the other program's figures there are known.
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/wheel_rows.hpp"

namespace v22_wheel_rows_long {

using namespace rondo;

namespace {
class WheelsLong : public testing::TestWithParam<test::WheelRow> {};

std::vector<test::WheelRow> known_rows() {
  std::vector<test::WheelRow> rows = test::all_rows();
  std::erase_if(rows, [](const test::WheelRow& row) {
    return std::ranges::all_of(row.figures, [](const auto& f) { return std::isnan(f.fine); });
  });
  return rows;
}
}  // namespace

TEST_P(WheelsLong, AreAsAnotherProgramHasThem) {
  test::expect_row(GetParam(), test::Column::fine);
}

INSTANTIATE_TEST_SUITE_P(All, WheelsLong, testing::ValuesIn(known_rows()),
                         [](const auto& p) { return p.param.name; });

}  // namespace v22_wheel_rows_long
