// SPDX-License-Identifier: BSD-3-Clause
/// The step of a reduced wheel allocates nothing.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <utility>

#include "rolling_box.hpp"
#include "rolling_wheel.hpp"
#include "rondo/contact/friction_table.hpp"
#include "support/allocations.hpp"

namespace rondo::rom::rolling_wheel {

class Steps : public testing::TestWithParam<std::tuple<bool, bool, bool, bool>> {};

TEST_P(Steps, OfAWheelAllocateNothing) {
  const auto [whole, changes, viscous, of_table] = GetParam();
  const OneBlasThread one;
  const Disk d(4, 60, whole);
  Rolling run{.modes = 40};
  if (viscous) run.branches = {{0.2, 1e-3}, {0.1, 1e-2}};
  if (of_table) {
    run.friction = contact::friction_of({.coefficient = 0.4,
                                         .slip = {{0.0, 0.8}, {1.0, 1.2}},
                                         .pressure_exponent = -0.15,
                                         .patches = {}});
    run.lengths.assign(whole ? 60 : 1, 0.03);
  }
  if (changes) run.spins = dynamics::Table({{0.0, 25.0}, {1.0, 35.0}});
  Wheel w(d, run);
  int n = 0, contacts = 0;
  const auto pressed = [&](int until) {
    for (; n < until; ++n)
      contacts += static_cast<int>(w.wheel.step(w.motion.at(n)).contacts.size());
  };
  pressed(100);
  const long before = test::allocations();
  contacts = 0;
  pressed(200);
  EXPECT_EQ(test::allocations() - before, 0);
  EXPECT_GT(contacts, 100);
  const long counted = test::allocations();
  const Eigen::VectorXd something = Eigen::VectorXd::Constant(10, static_cast<double>(before));
  EXPECT_EQ(test::allocations() - counted, 1) << something[0];  // the counter counts
}
INSTANTIATE_TEST_SUITE_P(Wheels, Steps,
                         testing::Combine(testing::Bool(), testing::Bool(), testing::Bool(),
                                          testing::Bool()),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param) ? "mesh" : "ring") +
                                  (std::get<1>(info.param) ? "_changing_spin" : "_constant_spin") +
                                  (std::get<2>(info.param) ? "_viscous" : "") +
                                  (std::get<3>(info.param) ? "_table_of_friction" : "");
                         });

TEST(SolidSteps, AllocateNothing) {
  const OneBlasThread one;
  const WheelViscosity elastic{{}, 2e-5}, viscous{{{0.2, 1e-3}, {0.1, 1e-2}}, 2e-5};
  for (const auto& [loss, spin_rate] : {std::pair{elastic, 0.0}, std::pair{elastic, 50.0},
                                        std::pair{viscous, 0.0}, std::pair{viscous, 50.0}}) {
    const rolling_box::RollingBox rolling(loss, spin_rate);
    SolidWheel wheel = rolling.wheel();
    wheel.start(rolling.start());
    std::size_t contacts = 0;
    long before = 0;
    for (int n = 0; n < 90; ++n) {
      if (n == 60) before = test::allocations();
      contacts = wheel.step(rolling.motion(n)).contacts.size();
    }
    EXPECT_EQ(test::allocations() - before, 0) << loss.branches.size() << " " << spin_rate;
    EXPECT_GT(contacts, 10U);
  }
}

}  // namespace rondo::rom::rolling_wheel
