// SPDX-License-Identifier: BSD-3-Clause
/// Linear viscoelasticity: the modulus over the frequency, branches that have a loss factor, and
/// what the branches of a part resist.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/fem/viscosity.hpp"
#include "rondo/mesh/solid/wheel.hpp"
#include "support/solid_wheel.hpp"

namespace rondo::fem::viscosity_test {
namespace {

using Branches = std::vector<ViscousBranch>;

mesh::Mesh wheel_of_two_regions() {
  mesh::Mesh mesh = mesh::make_wheel(test::box_wheel(2, 3, 12));
  mesh.region_names = {"", "tread"};
  for (std::size_t e = 0; e < mesh.hexahedra.size(); ++e)
    mesh.region.push_back(static_cast<int>(e % 2));
  return mesh;
}

std::vector<Material> materials() {
  Material first = test::box_rubber(), second = first;
  first.branches = {{0.5, 1e-3}, {0.2, 1e-2}};
  second.youngs_modulus = 5e7;
  second.branches = first.branches;
  return {first, second};
}

/// uᵀ V u for u = (x, y, z) x a matrix, on the free nodes, and its size for a unit of strain.
double energy_of(const SolidSector& v, const mesh::Mesh& mesh, auto&& displacement) {
  std::vector<Vec3> u(mesh.n_nodes()), force(mesh.n_nodes());
  for (std::size_t k = 0; k < u.size(); ++k)
    u[k] = displacement(Vec3(mesh.coordinates[k], mesh.axial[k]));
  apply(v, u, force);
  double sum = 0.0;
  for (std::size_t k = 0; k < u.size(); ++k) sum += dot(u[k], force[k]);
  return sum;
}

}  // namespace

TEST(ComplexModulus, IsThatOfTheStandardSolid) {
  const Branches one{{0.8, 0.02}};
  const std::complex<double> i{0.0, 1.0};
  for (const double omega : {0.0, 3.0, 50.0, -50.0, 1e6}) {
    const std::complex<double> expected = 0.8 * i * omega * 0.02 / (1.0 + i * omega * 0.02);
    EXPECT_NEAR(std::abs(branch_modulus(one, omega) - expected), 0.0, 1e-15) << omega;
  }
  EXPECT_NEAR(loss_factor(one, 50.0), 0.4 / 1.4, 1e-15);  // ωτ = 1
}

TEST(ComplexModulus, OfALossFactorIsNearlyConstantInItsBand) {
  for (const auto& [tangent, band, branches, bound] :
       {std::tuple{0.15, Band{1.0, 1e4}, 6U, 0.035}, std::tuple{0.3, Band{5.0, 500.0}, 4U, 0.025},
        std::tuple{0.05, Band{10.0, 100.0}, 3U, 0.005}}) {
    const Branches fitted = branches_of(tangent, band);
    EXPECT_EQ(fitted.size(), branches);
    EXPECT_LT(fit_error(fitted, tangent, band), bound) << tangent;
    for (const ViscousBranch& b : fitted) EXPECT_GT(b.relative_modulus, 0.0);
    const double middle = 2.0 * std::numbers::pi * std::sqrt(band.low * band.high);
    EXPECT_NEAR(loss_factor(fitted, middle), tangent, bound * tangent);
  }
}

TEST(ViscousParts, OfLinearMaterialsAddUpToTheStiffness) {
  const mesh::Mesh mesh = wheel_of_two_regions();
  const SolidSector k = assemble_solid_sector(mesh, materials());
  const auto parts = viscous_parts<SolidSector>(mesh, materials(), ViscousBy::material);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "material");
  EXPECT_EQ(parts[1].name, "tread");
  const auto joined = viscous_parts<SolidSector>(mesh, materials(), ViscousBy::branches);
  ASSERT_EQ(joined.size(), 1U);
  double largest = 0.0;
  for (std::size_t e = 0; e < k.entries.size(); ++e)
    for (std::size_t i = 0; i < 9; ++i) {
      const double sum =
          parts[0].stiffness.entries[e].block[i] + parts[1].stiffness.entries[e].block[i];
      const double whole = k.entries[e].block[i];
      largest = std::max(largest, std::abs(whole));
      EXPECT_NEAR(sum, whole, 1e-9 * 5e7);
      EXPECT_NEAR(joined[0].stiffness.entries[e].block[i], whole, 1e-9 * 5e7);
    }
  EXPECT_GT(largest, 1e5);
  const SolidSector at_once = with_branches<3>(k, parts);
  for (std::size_t e = 0; e < k.entries.size(); ++e)
    EXPECT_NEAR(at_once.entries[e].block[0], 1.7 * k.entries[e].block[0], 1e-8 * 5e7);
  EXPECT_NEAR(instantaneous(materials())[1].youngs_modulus, 1.7 * 5e7, 1.0);
}

/// A change of volume, the same everywhere, strains no branch of rubber, and one of shape does.
TEST(ViscousParts, OfRubberResistChangesOfShapeAlone) {
  mesh::Mesh mesh = wheel_of_two_regions();
  mesh.clamped.clear();
  std::vector<Material> all = materials();
  for (Material& m : all) {
    m.integration = Integration::b_bar;
    m.rubber.emplace();
    m.rubber->c10 = 1e6;
    m.rubber->bulk_modulus = 1e8;
    m.rubber->branches = m.branches;
  }
  all[1].rubber->branches.clear();
  const auto parts = viscous_parts<SolidSector>(mesh, all, ViscousBy::material);
  ASSERT_EQ(parts.size(), 1U);
  const double shape = energy_of(parts[0].stiffness, mesh, [](Vec3 x) {
    return Vec3{0.5 * x.y, 0.0, 0.0};
  });
  const double volume = energy_of(parts[0].stiffness, mesh, [](Vec3 x) { return x; });
  EXPECT_GT(shape, 1e3);
  EXPECT_LT(std::abs(volume), 1e-9 * shape);
}

}  // namespace rondo::fem::viscosity_test
