// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/harmonics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <random>

#include "rondo/fem/assembly.hpp"
#include "support/rings.hpp"

namespace harmonics_test {

using namespace rondo;

namespace {

const fem::Material material{2.0e7, 0.3, 1100.0, fem::Plane::strain};

std::vector<double> eigenvalues(const Eigen::MatrixXcd& lower) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(lower, Eigen::EigenvaluesOnly);
  return {solver.eigenvalues().begin(), solver.eigenvalues().end()};
}

/// Of M^-½ K M^-½, by the assembled stiffness.
std::vector<double> assembled_eigenvalues(const mesh::Mesh& mesh, std::span<const double> mass) {
  const std::vector<int> free = fem::free_nodes(mesh);
  Eigen::MatrixXd a = fem::free_matrix(fem::assemble_stiffness(mesh, {&material, 1}), free);
  const auto root = [&](Eigen::Index i) {
    return std::sqrt(mass[static_cast<std::size_t>(free[static_cast<std::size_t>(i / 2)])]);
  };
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) a(i, j) /= root(i) * root(j);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, Eigen::EigenvaluesOnly);
  return {solver.eigenvalues().begin(), solver.eigenvalues().end()};
}

}  // namespace

TEST(Harmonics, TogetherHaveTheEigenvaluesOfTheAssembledStiffness) {
  for (const mesh::Disk& disk : test::cyclic_disks()) {
    const mesh::Mesh mesh = mesh::make_disk(disk);
    const std::vector<double> mass = fem::lumped_mass(mesh, {&material, 1});
    fem::Harmonics harmonics(fem::assemble_sector(mesh, {&material, 1}), mass);
    std::vector<double> found;
    for (int k = 0; k < harmonics.count(); ++k) {
      const bool twice = k > 0 && 2 * k < mesh.n_sectors;  // k and N - k
      for (const double value : eigenvalues(harmonics.lower(k, 1.0, 0.0)))
        found.insert(found.end(), twice ? 2 : 1, value);
    }
    std::sort(found.begin(), found.end());
    const std::vector<double> expected = assembled_eigenvalues(mesh, mass);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-13 * expected.back()) << i;
  }
}

/// With masses of 1 kg/m: a field that turns by κ from sector to sector is mapped to one that does.
TEST(Harmonics, ProductIsThatOfTheWholeMesh) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-1.0, 1.0);
  for (const mesh::Disk& disk : test::cyclic_disks()) {
    const mesh::Mesh mesh = mesh::make_disk(disk);
    const fem::SectorStiffness sector = fem::assemble_sector(mesh, {&material, 1});
    fem::Harmonics harmonics(sector, std::vector<double>(mesh.n_nodes(), 1.0));
    const auto on_mesh = [&](const Eigen::VectorXcd& polar, int k) {
      std::vector<Vec2> u(mesh.n_nodes());
      for (std::size_t j = 0; j < sector.turn.size(); ++j)
        for (std::size_t a = 0; a < sector.n_local(); ++a) {
          const double kappa = 2.0 * std::numbers::pi * k / sector.n_sectors;
          const auto phase = std::polar(1.0, kappa * static_cast<double>(j));
          const auto at = static_cast<Eigen::Index>(2 * a);
          u[sector.node(a, j)] =
              sector.turn[j] * Vec2{(phase * polar[at]).real(), (phase * polar[at + 1]).real()};
        }
      return u;
    };
    for (int k = 0; k < harmonics.count(); k += 1 + k / 3) {
      Eigen::VectorXcd polar(harmonics.size());
      for (auto& value : polar) value = {x(random), x(random)};
      const Eigen::VectorXcd product =
          harmonics.lower(k, 1.0, 0.0).selfadjointView<Eigen::Lower>() * polar;
      std::vector<Vec2> expected(mesh.n_nodes());
      fem::apply(sector, on_mesh(polar, k), expected);
      const std::vector<Vec2> found = on_mesh(product, k);
      double largest = 0.0, error = 0.0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        largest = std::max(largest, norm(expected[i]));
        error = std::max(error, norm(found[i] - expected[i]));
      }
      EXPECT_GT(largest, 1e6);
      EXPECT_LT(error, 1e-13 * largest) << k;
    }
  }
}

TEST(Harmonics, FactorAndShift) {
  const fem::SectorStiffness ring = test::ring(8, 1);
  fem::Harmonics harmonics(ring, std::vector<double>(8, 4.0));  // a quarter of the eigenvalues
  EXPECT_EQ(harmonics.root_mass(), Eigen::Vector2d(2.0, 2.0));
  for (int k = 0; k < 5; ++k) {
    const double kappa = k * std::numbers::pi / 4.0, angle = std::numbers::pi / 4.0;
    std::vector<double> expected{2.5e5 * (5.0 + 2.0 * std::cos(kappa + angle)),
                                 2.5e5 * (5.0 + 2.0 * std::cos(kappa - angle))};
    for (double& value : expected) value = 3e6 - 0.5 * value;
    std::sort(expected.begin(), expected.end());
    const std::vector<double> found = eigenvalues(harmonics.lower(k, -0.5, 3e6));
    EXPECT_NEAR(found[0], expected[0], 1e-9 * expected[0]);
    EXPECT_NEAR(found[1], expected[1], 1e-9 * expected[1]);
  }
}

TEST(Assembly, ElementBoundOfASectorIsThatOfTheMesh) {
  for (const mesh::Disk& disk : test::cyclic_disks()) {
    const mesh::Mesh mesh = mesh::make_disk(disk);
    const double expected = fem::element_eigenvalue_bound(mesh, {&material, 1});
    EXPECT_NEAR(fem::sector_eigenvalue_bound(mesh, {&material, 1}), expected, 1e-12 * expected);
  }
}

}  // namespace harmonics_test
