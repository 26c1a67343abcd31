// SPDX-License-Identifier: BSD-3-Clause
/// V4 with steps near the critical one, over 200 periods: how much energy impacts then bring
/// (docs/reliability.md, "Step near the critical one, with contact", whose table is printed here).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "support/bars.hpp"

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr std::array shares{0.95, 0.97, 0.98, 0.985, 0.99, 0.992, 0.995, 0.997, 0.999};

struct Growth {
  double energy = 0.0;    ///< largest, over that at the start
  double relative = 0.0;  ///< residual of the ledger
};

/// @param share of the critical step, which damping makes shorter (docs/theory.md, 3.8)
/// @param damping ratio of the highest wave, β ω_max/2 with ω_max = 2c/h
Growth growth(int elements, double share, double damping) {
  const test::Bar bar{.youngs_modulus = 1.0,
                      .density = 1.0,
                      .length = 1.0,
                      .gap = -1e-9,
                      .elements = elements,
                      .courant = share * (std::hypot(1.0, damping) - damping),
                      .held = true};
  Model model = test::bar_model(bar);
  model.stiffness_damping = damping * bar.element() / bar.wave_speed();
  std::vector<Vec2> u(model.n_nodes());
  for (std::size_t k = 0; k < u.size(); ++k) u[k].y = 0.5 * (1.0 - model.reference[k].y);
  test::Stepping run(model, start(model, u, std::vector<Vec2>(u.size())));
  const test::BarCourse course = test::course_of(bar, run, 600.0);
  const double most = *std::max_element(course.energy.begin(), course.energy.end());
  return {most / course.energy.front(), course.relative};
}

}  // namespace

TEST(RodLong, EnergyFromImpactsNearTheCriticalStep) {
  for (const int n : {50, 100, 200}) {
    std::map<double, double> energy;
    std::string row;
    for (const double share : shares) {
      const Growth found = growth(n, share, 0.0);
      EXPECT_LT(found.relative, 1e-12) << n << ' ' << share;
      energy[share] = found.energy;
      row += fmt::format(" {:10.3g}", found.energy);
    }
    fmt::print("N = {:3}:{}\n", n, row);
    // Up to where the program begins to warn nothing grows; above it, it does on every mesh.
    for (const auto& [share, most] : energy) {
      if (share <= 0.985) {
        EXPECT_LT(most, 1.0 + 1e-9) << n << ' ' << share;
      }
    }
    EXPECT_GT(energy[0.997], 5.0) << n;
    EXPECT_GT(energy[0.999], 100.0) << n;
  }
}

/// What the warning advises: of the highest wave 0.005 of the critical damping.
TEST(RodLong, DampingOfTheHighestWaveHoldsIt) {
  for (const int n : {50, 100, 200})
    for (const double share : {0.985, 0.99, 0.995, 0.999}) {
      const Growth found = growth(n, share, 0.005);
      EXPECT_LT(found.energy, 1.0 + 1e-9) << n << ' ' << share;
      EXPECT_LT(found.relative, 1e-9) << n << ' ' << share;
    }
}
