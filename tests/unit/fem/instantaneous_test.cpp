// SPDX-License-Identifier: BSD-3-Clause
/// What rubber is at once, for critical steps: a linear material with the shear modulus of the law
/// and all branches, and the bulk modulus of the law.
#include <gtest/gtest.h>

#include "rondo/fem/elasticity.hpp"

namespace instantaneous_test {

using namespace rondo::fem;

namespace {

/// μ = 1e6, κ = 1e8 Pa.
Material rubber() {
  Rubber law;
  law.c10 = 0.4e6;
  law.c01 = 0.1e6;
  law.law = RubberLaw::mooney_rivlin;
  law.bulk_modulus = 1e8;
  Material m;
  m.poissons_ratio = 298.0 / 602.0;
  m.youngs_modulus = 2e6 * (1.0 + m.poissons_ratio);
  m.density = 1100.0;
  m.integration = Integration::b_bar;
  m.rubber = law;
  return m;
}

TEST(Instantaneous, HasTheModuliOfAllBranches) {
  std::vector<Material> materials{rubber(), Material{2e9, 0.3, 1100.0}};
  materials[0].rubber->branches = {{0.3, 1e-3}, {0.5, 1e-2}};
  EXPECT_TRUE(has_branches(materials));
  const std::vector<Material> at_once = instantaneous(materials);
  const Hooke hooke_at_once = hooke(at_once[0]);
  EXPECT_NEAR(hooke_at_once.d33, 1.8e6, 1e-8);                                // μ (1 + Σ g)
  EXPECT_NEAR(hooke_at_once.d12 + 2.0 / 3.0 * hooke_at_once.d33, 1e8, 1e-5);  // κ = λ + 2μ/3
  EXPECT_EQ(at_once[0].integration, Integration::b_bar);
  EXPECT_EQ(at_once[0].density, 1100.0);
  EXPECT_FALSE(has_rubber(at_once));
  EXPECT_EQ(at_once[1].youngs_modulus, 2e9);
}

TEST(Instantaneous, IsTheMaterialItselfWithoutBranches) {
  const std::vector<Material> materials{rubber()};
  EXPECT_TRUE(has_rubber(materials));
  EXPECT_FALSE(has_branches(materials));
  EXPECT_EQ(instantaneous(materials)[0].youngs_modulus, materials[0].youngs_modulus);
  EXPECT_EQ(instantaneous(materials)[0].poissons_ratio, materials[0].poissons_ratio);
}

}  // namespace

}  // namespace instantaneous_test
