// SPDX-License-Identifier: BSD-3-Clause
/// V4 with steps near the critical one, over 200 periods: how much energy impacts then bring
/// (docs/reliability.md, "Step near the critical one, with contact", whose table is printed here).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "support/bars.hpp"

namespace v04_rod_long {

using namespace rondo;

namespace {

constexpr std::array shares{0.95, 0.97, 0.98, 0.985, 0.99, 0.992, 0.995, 0.997, 0.999};

}  // namespace

TEST(RodLong, EnergyFromImpactsNearTheCriticalStep) {
  for (const int n : {50, 100, 200}) {
    std::map<double, double> energy;
    std::string row;
    for (const double share : shares) {
      const test::EnergyGrowth found = test::energy_growth(n, share, 0.0);
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
      const test::EnergyGrowth found = test::energy_growth(n, share, 0.005);
      EXPECT_LT(found.energy, 1.0 + 1e-9) << n << ' ' << share;
      EXPECT_LT(found.relative, 1e-9) << n << ' ' << share;
    }
}

}  // namespace v04_rod_long
