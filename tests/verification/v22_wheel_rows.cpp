// SPDX-License-Identifier: BSD-3-Clause
/// V22 to V24: wheels whose rim forces move: rolling under load, driven, braked to lock; free on an
/// incline, dropped, landing, launched; over a cleat. Expected: an independent program of the same
/// equations (docs/validation.md); the finest mesh is v22_wheel_rows_long.cpp's.
#include <tuple>

#include "support/traps.hpp"
#include "support/wheel_rows.hpp"

namespace v22_wheel_rows {

using namespace rondo;

namespace {
class Wheels : public testing::TestWithParam<std::tuple<test::WheelRow, test::Column>> {};
}  // namespace

TEST_P(Wheels, AreAsAnotherProgramHasThem) {
  const auto& [row, column] = GetParam();
  const test::FloatingPointTraps traps;
  test::expect_row(row, column);
}

INSTANTIATE_TEST_SUITE_P(All, Wheels,
                         testing::Combine(testing::ValuesIn(test::all_rows()),
                                          testing::Values(test::Column::full, test::Column::half)),
                         [](const auto& p) {
                           return fmt::format("{}_{}", std::get<0>(p.param).name,
                                              test::column_name(std::get<1>(p.param)));
                         });

}  // namespace v22_wheel_rows
