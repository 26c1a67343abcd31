// SPDX-License-Identifier: BSD-3-Clause
/// The coefficient of friction as an object, and the table of its laws.
#include "rondo/contact/friction_laws.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string_view>

namespace rondo::contact::friction_test {
namespace {

TEST(Friction, AConstantIsTheSameAtEveryContact) {
  const Friction friction = make_friction("constant", std::array{0.3});
  EXPECT_TRUE(friction.is_constant());
  EXPECT_EQ(friction.constant(), 0.3);
  EXPECT_EQ(friction.coefficient({{1.0, 2.0, 3.0}, 4.0, 5.0}), 0.3);
  EXPECT_EQ(Friction().constant(), 0.0);
}

TEST(Friction, ALawIsAskedWithTheStateOfTheContact) {
  const Friction friction(
      [](const SlidingState& s) { return s.place.x + 10.0 * s.slip + 100.0 * s.pressure; });
  EXPECT_FALSE(friction.is_constant());
  EXPECT_EQ(friction.coefficient({{1.0, 7.0, 7.0}, 2.0, 3.0}), 321.0);
  EXPECT_DEATH((void)friction.constant(), "is_constant");  // NOLINT: it does not return
}

TEST(Friction, LawsHaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const FrictionLaw& law : friction_laws()) EXPECT_TRUE(names.insert(law.name).second);
  EXPECT_TRUE(names.contains("constant"));
  EXPECT_DEATH((void)make_friction("sticky", {}), "sticky");
  EXPECT_DEATH((void)make_friction("constant", {}), "parameters.size");
}

}  // namespace
}  // namespace rondo::contact::friction_test
