// SPDX-License-Identifier: BSD-3-Clause
/// V4: a rod of unit data, held at its upper end, its foot over an obstacle that it just touches,
/// is compressed and let go (docs/validation.md). Expected: the solution of period 3 in contact for
/// t in [1, 2] with a pressure of 1/2, its energy 1/8 for ever; Doyen, Ern, Piperno (2011), 4.1.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/model/steps/step_table.hpp"
#include "support/bars.hpp"
#include "support/traps.hpp"

namespace v04_rod {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr double energy = 0.125;

struct Rod {
  test::Bar bar;
  test::BarCourse course;
  std::vector<test::Phase> contacts;
};

/// u0 = (1 - y)/2: half of its length is taken out of it. Where all comes back exactly the foot
/// would touch by round-off alone: it is 1e-9 deep.
Rod let_go(int elements, double courant, int periods) {
  Rod rod;
  rod.bar = {.youngs_modulus = 1.0,
             .density = 1.0,
             .length = 1.0,
             .gap = -1e-9,
             .elements = elements,
             .courant = courant,
             .held = true};
  const Model model = test::bar_model(rod.bar);
  EXPECT_EQ(step_of(model), StepKind::sparse);
  std::vector<Vec2> u(model.n_nodes());
  for (std::size_t k = 0; k < u.size(); ++k) u[k].y = 0.5 * (1.0 - model.reference[k].y);
  test::Stepping run(model, start(model, u, std::vector<Vec2>(u.size())));
  const test::FloatingPointTraps traps;
  rod.course = test::course_of(rod.bar, run, 3.0 * periods);
  rod.contacts = test::phases(rod.course, 1.0, 1e-6);
  return rod;
}

}  // namespace

/// No dispersion: all is exact but for the foot, which is stopped once and for all.
TEST(RodLetGo, IsPeriodicWhereTheStepIsCritical) {
  for (const int n : {50, 100}) {
    const Rod rod = let_go(n, 1.0, 10);
    ASSERT_EQ(rod.contacts.size(), 10u);
    const double step = rod.bar.step();
    for (std::size_t k = 0; k < 10; ++k) {
      const test::Phase& contact = rod.contacts[k];
      const double begin = 1.0 + 3.0 * static_cast<double>(k);
      EXPECT_NEAR(rod.course.time[contact.first], begin, 1.001 * step) << k;
      EXPECT_NEAR(rod.course.time[contact.last], begin + 1.0, 1.001 * step) << k;
      // Round-off of alternating modes grows linearly, and over the contacts.
      for (std::size_t i = contact.first + 1; i < contact.last; ++i)
        ASSERT_NEAR(rod.course.pressure[i], 0.5, 1e-6) << k;
    }
    const std::size_t after = rod.contacts[0].last + 2;
    for (std::size_t i = after; i < rod.course.energy.size(); ++i)
      ASSERT_NEAR(rod.course.energy[i] / energy, 1.0 - 1.0 / n, 1e-8) << i;
    EXPECT_LT(rod.course.relative, 1e-12);
  }
}

/// With dispersion each contact costs a little; what is not left is in the ledger, for 100 periods.
TEST(RodLetGo, LosesNothingButWhatImpactsTake) {
  double before = 0.0;
  for (const int n : {50, 100, 200}) {
    const Rod rod = let_go(n, 0.9, 100);
    ASSERT_EQ(rod.contacts.size(), 100u) << n;
    double gone = 0.0;
    for (std::size_t i = 0; i < rod.course.energy.size(); ++i)
      gone = std::max(gone,
                      std::abs(rod.course.energy[i] + rod.course.lost[i] - rod.course.energy[0]));
    EXPECT_LT(gone, 1e-12 * energy) << n;
    const auto ten = static_cast<std::size_t>(30.0 / rod.bar.step());
    RecordProperty(fmt::format("left_{}", n),
                   fmt::format("{:.5f} {:.5f}", rod.course.energy[ten] / energy,
                               rod.course.energy.back() / energy));
    // First order in h: the mass of the foot.
    const double loss = 1.0 - rod.course.energy[ten] / energy;
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / loss), 1.0, 0.15) << n;
    }
    before = loss;
    // The first contact: times, and the pressure in between.
    const test::Phase& contact = rod.contacts[0];
    EXPECT_NEAR(rod.course.time[contact.first], 1.0, test::front_spread(rod.bar));
    EXPECT_NEAR(rod.course.time[contact.last], 2.0, test::front_spread(rod.bar));
    for (std::size_t i = contact.first; i <= contact.last; ++i)
      if (std::abs(rod.course.time[i] - 1.5) < 0.4) {
        ASSERT_NEAR(rod.course.pressure[i], 0.5, 0.01);  // what oscillates behind the front
      }
  }
}

/// Where the program begins to warn (v04_rod_long.cpp has the table of it): at 0.985 of the
/// critical step impacts bring no energy, at 0.999 they do, and not with 0.005 of the critical
/// damping.
TEST(RodLetGo, NearTheCriticalStepImpactsBringEnergy) {
  for (const auto& [share, damping] : {std::pair{0.985, 0.0}, {0.999, 0.005}}) {
    const test::EnergyGrowth held = test::energy_growth(50, share, damping);
    EXPECT_LT(held.energy, 1.0 + 1e-9) << share;
    EXPECT_LT(held.relative, 1e-9) << share;
  }
  EXPECT_GT(test::energy_growth(50, 0.999, 0.0).energy, 100.0);
}

/// By the energy-safe law they bring none at any step, to round-off; with restitution neither does.
TEST(RodLetGo, EnergySafeImpactsNeverBringEnergy) {
  for (const double share : {0.99, 0.999})
    for (const double e : {0.0, 0.8}) {
      const test::EnergyGrowth rod =
          test::energy_growth(50, share, 0.0, {0.0, e, contact::Impact::energy_safe});
      EXPECT_LT(rod.energy, 1.0 + 1e-13) << share << ' ' << e;
      EXPECT_LT(rod.relative, 1e-12) << share << ' ' << e;
    }
}

/// What it takes more than Moreau's: shares left after 200 periods, and after 50 with restitution.
TEST(RodLetGo, EnergySafeImpactsTakeMore) {
  const auto left = [](double e, int periods, contact::Impact impact) {
    return test::energy_growth(50, 0.9, 0.0, {0.0, e, impact}, periods).left;
  };
  EXPECT_NEAR(left(0.0, 200, contact::Impact::moreau), 0.4946, 1e-4);
  EXPECT_NEAR(left(0.0, 200, contact::Impact::energy_safe), 0.2841, 1e-4);
  EXPECT_NEAR(left(0.8, 50, contact::Impact::moreau), 0.3448, 1e-4);
  EXPECT_NEAR(left(0.8, 50, contact::Impact::energy_safe), 0.0210, 1e-4);
}

}  // namespace v04_rod
