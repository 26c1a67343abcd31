// SPDX-License-Identifier: BSD-3-Clause
/// V11: frequencies of a spinning disk in the turning frame, backward and forward waves.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "rondo/fem/assembly.hpp"
#include "rondo/modal/modes.hpp"
#include "support/models.hpp"

using namespace rondo;
using modal::Wave;

namespace {

/// Lowest frequency of each (n, wave) [rad/s].
using Frequencies = std::map<std::pair<int, Wave>, double>;

Frequencies compute(int radial) {
  const auto c = test::rubber_annulus(radial, 15 * radial);
  const mesh::Mesh mesh = mesh::make_disk(c.disk);
  const std::vector<double> mass = fem::lumped_mass(mesh, c.material.density);
  const fem::SectorStiffness k = fem::assemble_sector(mesh, c.material);
  const modal::Modes found = modal::cyclic_modes({k, mass, mesh.coordinates}, -50.0, 16);
  EXPECT_TRUE(found.counted);
  EXPECT_EQ(found.unstable, 0);
  Frequencies lowest;
  for (const modal::Mode& mode : found.modes)
    lowest.try_emplace({mode.diameters, mode.wave}, mode.omega);
  return lowest;
}

/// Of an independent solution (docs/validation.md), without stiffening [rad/s].
const Frequencies expected{
    {{0, Wave::standing}, 475.447}, {{1, Wave::backward}, 550.560}, {{1, Wave::forward}, 523.625},
    {{2, Wave::backward}, 706.775}, {{2, Wave::forward}, 653.541},  {{3, Wave::backward}, 879.893},
    {{3, Wave::forward}, 803.108}};

}  // namespace

TEST(Frequencies, ConvergeToThoseOfTheSpinningDisk) {
  std::map<int, Frequencies> found;
  for (const int radial : {8, 16, 32}) found[radial] = compute(radial);
  for (const auto& [key, omega] : expected) {
    const double coarse = found[8].at(key), middle = found[16].at(key), fine = found[32].at(key);
    const double order = std::log2((middle - coarse) / (fine - middle));
    const double limit = fine + (fine - middle) / 3.0;
    const std::string name =
        "n" + std::to_string(key.first) + "_" + std::to_string(static_cast<int>(key.second));
    RecordProperty("order_" + name, std::to_string(order));
    RecordProperty("limit_" + name, std::to_string(limit));
    RecordProperty("error_" + name, std::to_string(fine / omega - 1.0));
    EXPECT_NEAR(order, 2.0, 0.1) << name;
    EXPECT_NEAR(limit / omega, 1.0, 2e-5) << name;  // the digits given, and what is left of h⁴
    printf("%s %.6f %.6f %.6f order %.3f limit %.5f rel %.2e\n", name.c_str(), coarse, middle, fine, order, limit, limit/omega-1);
  }
}
