// SPDX-License-Identifier: BSD-3-Clause
/// V17: ν = 0.4999. Full integration locks in bending, B-bar does not; and B-bar of the spinning
/// annulus. Both against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <cmath>

#include "rondo/fem/stress.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "support/models.hpp"
#include "support/spinning_annulus.hpp"

namespace v17_near_incompressible {

using namespace rondo;
using fem::Integration;

namespace {

constexpr double length = 4.0, curvature = 1e-3;

fem::Material rubber(double nu, Integration integration) {
  return {5e6, nu, 1100.0, fem::Plane::strain, integration};
}

/// Each quadrilateral by the same diagonal, the worst that a mesh of triangles can do.
void halve(mesh::Mesh& mesh) {
  std::vector<mesh::Cell> halves;
  for (const auto& [a, b, c, d] : mesh.cells)
    halves.insert(halves.end(), {{a, b, c, -1}, {a, c, d, -1}});
  mesh.cells = std::move(halves);
}

/// Half of a beam of length 8 and height 1 in pure bending, symmetric about x = 0. Inner nodes may
/// be moved to and fro by a fifth of an edge, row by row; quadrilaterals may be halved.
class Beam {
 public:
  Beam(int layers, bool distorted, bool triangles = false) : layers_(layers), columns_(4 * layers) {
    const double edge = 1.0 / layers;
    for (int i = 0; i <= columns_; ++i)
      for (int j = 0; j <= layers; ++j) {
        const bool moved = distorted && i > 0 && i < columns_;
        const double shift = moved ? 0.2 * edge * (j % 2 == 0 ? -1.0 : 1.0) : 0.0;
        mesh_.coordinates.push_back({edge * i + shift, edge * j - 0.5});
      }
    for (int i = 0; i < columns_; ++i)
      for (int j = 0; j < layers; ++j)
        mesh_.cells.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    if (triangles) halve(mesh_);
  }

  /// Of the deflection at the end, relative to -L²κ/2: with ε_xx = κy and no stress but
  /// σ_xx = E/(1-ν²) κy, u_y(x, 0) = -κx²/2.
  [[nodiscard]] double error(const fem::Material& m) const {
    Eigen::SparseMatrix<double> k =
        fem::free_matrix(fem::assemble_stiffness(mesh_, {&m, 1}), fem::free_nodes(mesh_));
    const double modulus = m.youngs_modulus / (1.0 - m.poissons_ratio * m.poissons_ratio);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(k.rows());
    const double edge = 1.0 / layers_;
    for (int j = 0; j < layers_; ++j) {  // ∫ N σ_xx, exactly
      const double low = edge * j - 0.5, high = low + edge;
      load[x_of(columns_, j)] += modulus * curvature * edge * (2.0 * low + high) / 6.0;
      load[x_of(columns_, j + 1)] += modulus * curvature * edge * (low + 2.0 * high) / 6.0;
    }
    std::vector<char> held(static_cast<std::size_t>(k.rows()), 0);
    for (int j = 0; j <= layers_; ++j) held[static_cast<std::size_t>(x_of(0, j))] = 1;
    held[static_cast<std::size_t>(x_of(0, layers_ / 2)) + 1] = 1;
    k.prune([&](Eigen::Index row, Eigen::Index column, double) {
      return row == column ||
             !(held[static_cast<std::size_t>(row)] || held[static_cast<std::size_t>(column)]);
    });
    for (Eigen::Index i = 0; i < load.size(); ++i)
      if (held[static_cast<std::size_t>(i)]) load[i] = 0.0;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(k);
    const Eigen::VectorXd u = solver.solve(load);
    const double exact = -0.5 * curvature * length * length;
    return u[x_of(columns_, layers_ / 2) + 1] / exact - 1.0;
  }

 private:
  [[nodiscard]] int node(int i, int j) const { return i * (layers_ + 1) + j; }
  [[nodiscard]] Eigen::Index x_of(int i, int j) const { return 2 * node(i, j); }

  int layers_, columns_;
  mesh::Mesh mesh_;
};

void record(const char* what, int n, double value) {
  testing::Test::RecordProperty(fmt::format("{}_{}", what, n), fmt::format("{:.3e}", value));
}

}  // namespace

/// In a full quadrilateral bending needs volume: nine tenths of the deflection are missing where
/// B-bar, on the same mesh, is right to a percent.
TEST(NearlyIncompressible, FullIntegrationLocks) {
  const double full = Beam(8, false).error(rubber(0.4999, Integration::full));
  const double b_bar = Beam(8, false).error(rubber(0.4999, Integration::b_bar));
  EXPECT_LT(full, -0.9);
  EXPECT_LT(std::abs(b_bar), 0.01);
  EXPECT_LT(std::abs(Beam(8, false).error(rubber(0.3, Integration::full))), 0.01);
}

TEST(NearlyIncompressible, BendingByBBarIsSecondOrder) {
  for (const bool distorted : {false, true}) {
    double before = 0.0;
    for (const int n : {4, 8, 16, 32}) {
      const Beam beam(n, distorted);
      const double full = beam.error(rubber(0.4999, Integration::full));
      const double error = beam.error(rubber(0.4999, Integration::b_bar));
      record(distorted ? "full_distorted" : "full", n, full);
      record(distorted ? "b_bar_distorted" : "b_bar", n, error);
      EXPECT_LT(full, -0.5) << n;
      EXPECT_LT(std::abs(error), 0.03) << n;
      if (before > 0.0) {
        EXPECT_NEAR(std::log2(before / error), 2.0, 0.15) << n;
      }
      before = error;
    }
  }
}

/// Two triangles for each quadrilateral lock as it does; with a mean at the nodes they do not.
TEST(NearlyIncompressible, BendingByTrianglesIsSecondOrder) {
  double before = 0.0;
  for (const int n : {4, 8, 16, 32}) {
    const Beam beam(n, false, true);
    const double full = beam.error(rubber(0.4999, Integration::full));
    const double error = beam.error(rubber(0.4999, Integration::b_bar));
    record("full_triangles", n, full);
    record("b_bar_triangles", n, error);
    EXPECT_LT(full, -0.7) << n;
    EXPECT_LT(std::abs(error), 2.0 / (n * n)) << n;
    if (before != 0.0 && n > 8) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.05) << n;
    }
    before = error;
  }
}

/// V9 with ν = 0.4999. Its motion is along the rows of cells and needs no volume: not even full
/// integration locks. What B-bar gains is stress: that of a node between cells.
TEST(NearlyIncompressible, TheSpinningAnnulusByBBar) {
  double before = 0.0, before_r = 0.0;
  for (const int n : {4, 8, 16, 32}) {
    const fem::Material m = rubber(0.4999, Integration::b_bar);
    const mesh::Mesh mesh = mesh::make_disk(test::rubber_annulus(n, 15 * n).disk);
    const test::SpinningAnnulus exact(m, 0.2, 0.3, 50.0);
    const auto spin =
        statics::stationary_spin(fem::assemble_sector(mesh, {&m, 1}),
                                 fem::lumped_mass(mesh, {&m, 1}), mesh.coordinates, 50.0);
    ASSERT_EQ(spin.status, statics::SpinStatus::solved);
    const auto outer = static_cast<std::size_t>(n);
    const double error = -spin.u.plane()[outer].y / exact.displacement(0.3) - 1.0;
    fem::StressRecovery recovery(mesh, {&m, 1});
    const fem::Stress middle = recovery(spin.u)[outer / 2];  // at r = 0.25, below the center
    const double radial = middle[1] / exact.radial_stress(0.25) - 1.0;
    const double hoop = middle[0] / exact.hoop_stress(0.25) - 1.0;
    record("displacement", n, error);
    record("radial_stress", n, radial);
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.02) << n;
      EXPECT_NEAR(std::log2(before_r / radial), 2.0, 0.02) << n;
    }
    EXPECT_LT(std::abs(hoop), 1e-4 / (n * n));  // the pressure, nearly all of it, is 4e-6 at n = 4
    before = error;
    before_r = radial;
  }
}

/// The same by triangles: stress at every node, of rim and outer surface too.
TEST(NearlyIncompressible, TheSpinningAnnulusByTriangles) {
  double before = 0.0, before_r = 0.0;
  for (const int n : {4, 8, 16}) {
    const fem::Material m = rubber(0.4999, Integration::b_bar);
    mesh::Mesh mesh = mesh::make_disk(test::rubber_annulus(n, 15 * n).disk);
    halve(mesh);
    const test::SpinningAnnulus exact(m, 0.2, 0.3, 50.0);
    const auto spin = statics::stationary_spin(fem::assemble_stiffness(mesh, {&m, 1}),
                                               fem::lumped_mass(mesh, {&m, 1}), mesh.coordinates,
                                               fem::free_nodes(mesh), 50.0);
    ASSERT_EQ(spin.status, statics::SpinStatus::solved);
    const double error = -spin.u.plane()[static_cast<std::size_t>(n)].y / exact.displacement(0.3) -
                         1.0;  // below the center
    fem::StressRecovery recovery(mesh, {&m, 1});
    const std::span<const fem::Stress> stress = recovery(spin.u);
    double radial = 0.0;
    for (std::size_t i = 0; i < mesh.n_nodes(); ++i) {
      const double r = norm(mesh.coordinates[i]);
      const Vec2 e = mesh.coordinates[i] / r;
      const auto& [xx, yy, zz, xy] = stress[i];
      const double found = xx * e.x * e.x + yy * e.y * e.y + 2.0 * xy * e.x * e.y;
      radial = std::max(radial, std::abs(found - exact.radial_stress(r)));
    }
    radial /= std::abs(exact.radial_stress(0.2));
    record("displacement_triangles", n, error);
    record("radial_stress_triangles", n, radial);
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.05) << n;
      EXPECT_NEAR(std::log2(before_r / radial), 2.0, 0.2) << n;
    }
    EXPECT_LT(radial, 0.25 / (n * n)) << n;
    before = error;
    before_r = radial;
  }
}

}  // namespace v17_near_incompressible
