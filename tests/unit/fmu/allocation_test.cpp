// SPDX-License-Identifier: BSD-3-Clause
/// A communication step of a wheel of an FMU, led in all directions, allocates nothing.
#include <gtest/gtest.h>

#include <string>

#include "rondo/case/case.hpp"
#include "rondo/fmu/wheel.hpp"
#include "support/allocations.hpp"

namespace rondo::fmu {
namespace {

study::Case box(const std::string& of_space) {
  return study::read_case_text("box.toml", R"(
schema = 1
title = "box"
[disk]
outer_radius = 0.30
inner_radius = 0.15
)" + of_space + R"(
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = 33.8
speed = 10.0
height = 0.30
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.1
)");
}

/// Leads the wheel to its steps up to `last`, down to the ground and then along it.
void lead(Wheel& wheel, Values& values, int first, int last) {
  constexpr double length = 4e-4;
  for (int k = first; k < last; ++k) {
    values.hub_velocity_up = k < 60 ? -0.4 : 0.0;
    values.hub_velocity_left = k % 2 == 0 ? 0.1 : 0.12;
    values.yaw_rate = k % 3 == 0 ? 0.5 : 0.4;
    values.camber_rate = k % 2 == 0 ? 0.05 : -0.05;
    ASSERT_EQ(wheel.refuse(values, length, 1e-12), "");
    ASSERT_EQ(wheel.go_on(values, length), "");
  }
}

void allocates_nothing(const study::Case& c) {
  Wheel wheel(c, {});
  Values values = start_values(c, 2e-4);
  wheel.begin(values);
  lead(wheel, values, 0, 200);
  ASSERT_GT(values.contact_force_up, 1e3);
  const long before = test::allocations();
  lead(wheel, values, 200, 400);
  EXPECT_EQ(test::allocations() - before, 0);
  EXPECT_TRUE(wheel.take_warnings().empty());
}

TEST(Allocations, OfAPlaneWheelThatIsLed) {
  allocates_nothing(box("[disk.mesh]\nradial = 4\ncircumferential = 90\n"));
}

TEST(Allocations, OfAWheelInThreeDimensionsThatIsLed) {
  allocates_nothing(box("width = 0.1\n[disk.mesh]\nradial = 3\ncircumferential = 90\naxial = 4\n"));
}

}  // namespace
}  // namespace rondo::fmu
