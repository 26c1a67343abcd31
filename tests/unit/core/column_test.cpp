// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/column.hpp"

#include <gtest/gtest.h>

namespace rondo::column_test {
namespace {

TEST(Units, OfABodyAreNotPerMetreOfItsWidth) {
  for (const auto& [plane, solid] : {std::pair{"N/m", "N"},
                                     {"N·m/m", "N·m"},
                                     {"J/m", "J"},
                                     {"kg/m", "kg"},
                                     {"kg m", "kg m2"},
                                     {"N/m2", "N/m"},
                                     {"m/s", "m/s"},
                                     {"Pa", "Pa"},
                                     {"1", "1"}}) {
    EXPECT_EQ(unit_of(plane, true), solid);
    EXPECT_EQ(unit_of(plane, false), plane);
  }
}

}  // namespace
}  // namespace rondo::column_test
