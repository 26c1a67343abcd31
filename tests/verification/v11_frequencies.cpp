// SPDX-License-Identifier: BSD-3-Clause
/// V11: frequencies of a spinning disk in the turning frame, backward and forward waves.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "rondo/fem/assembly.hpp"
#include "rondo/modal/modes.hpp"
#include "rondo/modal/residual.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "support/models.hpp"

namespace v11_frequencies {

using namespace rondo;
using modal::Wave;

namespace {

/// Lowest frequency of each (n, wave) [rad/s].
using Frequencies = std::map<std::pair<int, Wave>, double>;

Frequencies compute(int radial, bool stiffened) {
  const auto c = test::rubber_annulus(radial, 15 * radial);
  const mesh::Mesh mesh = mesh::make_disk(c.disk);
  const std::vector<double> mass = fem::lumped_mass(mesh, {&c.material, 1});
  fem::SectorStiffness k = fem::assemble_sector(mesh, {&c.material, 1});
  if (stiffened) {
    const auto prestress = statics::centrifugal_prestress(k, mass, mesh.coordinates, -50.0);
    EXPECT_EQ(prestress.status, statics::SpinStatus::solved);
    k = fem::assemble_sector(mesh, {&c.material, 1}, prestress.u);
  }
  const modal::Modes found = modal::cyclic_modes<2>({k, mass, mesh.coordinates}, -50.0, 16);
  EXPECT_TRUE(found.counted);
  EXPECT_EQ(found.unstable, 0);
  Frequencies lowest;
  for (const modal::Mode& mode : found.modes)
    lowest.try_emplace({mode.diameters, mode.wave}, mode.omega);
  return lowest;
}

/// Of an independent solution (docs/validation.md) [rad/s].
const Frequencies unstiffened{{{0, Wave::standing}, 475.447}, {{1, Wave::backward}, 550.560},
                              {{1, Wave::forward}, 523.625},  {{2, Wave::backward}, 706.775},
                              {{2, Wave::forward}, 653.541},  {{3, Wave::backward}, 879.893},
                              {{3, Wave::forward}, 803.108}};
const Frequencies stiffened{{{0, Wave::standing}, 485.400}, {{1, Wave::backward}, 559.592},
                            {{1, Wave::forward}, 532.692},  {{2, Wave::backward}, 714.488},
                            {{2, Wave::forward}, 661.333},  {{3, Wave::backward}, 887.129},
                            {{3, Wave::forward}, 810.455}};

void expect_convergence(const Frequencies& expected, bool with_stiffening) {
  std::map<int, Frequencies> found;
  for (const int radial : {16, 32, 64}) found[radial] = compute(radial, with_stiffening);
  for (const auto& [key, omega] : expected) {
    const double coarse = found[16].at(key), middle = found[32].at(key), fine = found[64].at(key);
    const double order = std::log2((middle - coarse) / (fine - middle));
    const double limit = fine + (fine - middle) / 3.0;
    const std::string name = fmt::format("n{}_{}", key.first, static_cast<int>(key.second));
    testing::Test::RecordProperty("order_" + name, fmt::format("{:.3f}", order));
    testing::Test::RecordProperty("limit_" + name, fmt::format("{:.5f}", limit));
    testing::Test::RecordProperty("error_16_" + name, fmt::format("{:.2e}", coarse / omega - 1.0));
    testing::Test::RecordProperty("error_64_" + name, fmt::format("{:.2e}", fine / omega - 1.0));
    EXPECT_NEAR(limit / omega, 1.0, 2e-5) << name;  // of the reference; ours is left with 1e-6
    // The errors along and across the layers have opposite signs; where they nearly cancel, with
    // n = 3, the h⁴ that is left disturbs the order, and the error is less than elsewhere.
    if (std::abs(coarse - limit) > 1e-4 * omega) {
      EXPECT_NEAR(order, 2.0, 0.02) << name;
    } else {
      EXPECT_LT(std::abs(fine - limit), 1e-5 * omega) << name;
    }
  }
}

}  // namespace

TEST(Frequencies, ConvergeToThoseOfTheSpinningDisk) {
  expect_convergence(unstiffened, false);
}

TEST(Frequencies, ConvergeWithTheStiffeningByTheStressOfTheSpin) {
  expect_convergence(stiffened, true);
}

TEST(Frequencies, TranslationOfAFreeDiskTurnsBackWithTheSpin) {
  auto c = test::rubber_annulus(6, 48);
  mesh::Mesh mesh = mesh::make_disk(c.disk);
  mesh.clamped.clear();
  const std::vector<double> mass = fem::lumped_mass(mesh, {&c.material, 1});
  const fem::SectorStiffness k = fem::assemble_sector(mesh, {&c.material, 1});
  const modal::Modes found = modal::cyclic_modes<2>({k, mass, mesh.coordinates}, -50.0, 4);
  int translations = 0;
  for (const modal::Mode& mode : found.modes) {
    if (mode.wave != Wave::rigid || mode.diameters != 1) continue;
    ++translations;
    EXPECT_NEAR(mode.omega, 50.0, 5e-4);  // a defective double root: 1e-5 of it
    EXPECT_LT(modal::residual<2>({k, mass, mesh.coordinates}, -50.0, mode), 1e-10);
  }
  EXPECT_EQ(translations, 2);
}

}  // namespace v11_frequencies
