// SPDX-License-Identifier: BSD-3-Clause
/// Modes of a wheel in three dimensions, free of the ground and held by it, against dense solutions
/// that use no symmetry.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/mesh/solid/wheel.hpp"
#include "rondo/modal/held_modes.hpp"
#include "rondo/modal/modes.hpp"
#include "rondo/modal/residual.hpp"

namespace solid_modes_test {
using namespace rondo;
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Two layers, of which the inner one is held, and a load at no place of symmetry.
struct SmallWheel {
  mesh::Mesh mesh;
  fem::SolidSector sector;
  std::vector<double> mass;
  std::vector<std::size_t> nodes;  ///< that are not clamped
  MatrixXd stiffness;              ///< M^-½ K M^-½ of these

  SmallWheel() {
    const fem::Material material{5.0e6, 0.4, 1100.0, fem::Plane::strain};
    mesh::Wheel wheel;
    wheel.disk = {.outer_radius = 0.3,
                  .inner_radius = 0.2,
                  .radial = 2,
                  .circumferential = 9,
                  .grading = 1.0,
                  .tread = {}};
    wheel.width = 0.1;
    wheel.axial = 1;
    mesh = mesh::make_wheel(wheel);
    sector = fem::assemble_solid_sector(mesh, {&material, 1});
    mass = fem::solid_mass(mesh, {&material, 1});
    for (std::size_t j = 0; j < sector.turn.size(); ++j)
      for (std::size_t a = 0; a < sector.n_local(); ++a) nodes.push_back(sector.node(a, j));
    const auto n = static_cast<Index>(3 * nodes.size());
    stiffness.resize(n, n);
    for (Index column = 0; column < n; ++column) {
      std::vector<Vec3> u(mesh.n_nodes()), ku(mesh.n_nodes());
      Vec3& of = u[nodes[static_cast<std::size_t>(column / 3)]];
      (column % 3 == 0 ? of.x : column % 3 == 1 ? of.y : of.z) = 1.0;
      fem::apply(sector, u, ku);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double scale =
            std::sqrt(mass[nodes[i]] * mass[nodes[static_cast<std::size_t>(column / 3)]]);
        const Vec3 f = ku[nodes[i]];
        stiffness.col(column).segment<3>(static_cast<Index>(3 * i)) =
            Eigen::Vector3d(f.x, f.y, f.z) / scale;
      }
    }
  }

  [[nodiscard]] modal::CyclicBody<3> cyclic() const { return {sector, mass, mesh.coordinates}; }
};

std::vector<double> dense_frequencies(const SmallWheel& w, double spin) {
  const Index n = w.stiffness.rows();
  MatrixXd companion = MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n).setIdentity();
  companion.bottomLeftCorner(n, n) = -w.stiffness;
  for (Index k = 0; k < n; k += 3) {
    companion(n + k, k) += spin * spin;
    companion(n + k + 1, k + 1) += spin * spin;
    companion(n + k, n + k + 1) = 2.0 * spin;
    companion(n + k + 1, n + k) = -2.0 * spin;
  }
  const Eigen::VectorXcd lambda = Eigen::EigenSolver<MatrixXd>(companion, false).eigenvalues();
  std::vector<double> omega;
  for (Index k = 0; k < lambda.size(); ++k)
    if (lambda[k].imag() > 0.0) omega.push_back(lambda[k].imag());
  std::ranges::sort(omega);
  return omega;
}

/// On the space that the held directions leave.
std::vector<double> dense_held(const SmallWheel& w,
                               const std::vector<modal::HeldDirection<3>>& held) {
  const Index n = w.stiffness.rows();
  MatrixXd h = MatrixXd::Zero(n, static_cast<Index>(held.size()));
  for (std::size_t k = 0; k < held.size(); ++k) {
    const auto at = std::ranges::find(w.nodes, held[k].node) - w.nodes.begin();
    const Vec3 d = held[k].direction;
    h.col(static_cast<Index>(k)).segment<3>(3 * at) =
        Eigen::Vector3d(d.x, d.y, d.z) / std::sqrt(w.mass[held[k].node]);
  }
  const MatrixXd q = Eigen::HouseholderQR<MatrixXd>(h).householderQ();
  const MatrixXd free = q.rightCols(n - h.cols());
  const VectorXd squares =
      Eigen::SelfAdjointEigenSolver<MatrixXd>(free.transpose() * w.stiffness * free).eigenvalues();
  std::vector<double> omega;
  for (const double s : squares) omega.push_back(std::sqrt(s));
  return omega;
}

/// Three nodes of the tread of different sectors; one of them may slide.
std::vector<modal::HeldDirection<3>> some_held(const SmallWheel& w) {
  const std::size_t last = w.sector.n_local() - 1;
  const Vec3 normal{0.6, 0.8, 0.0};
  return {{w.sector.node(last, 2), {1.0, 0.0, 0.0}},
          {w.sector.node(last, 2), {0.0, 1.0, 0.0}},
          {w.sector.node(last, 2), {0.0, 0.0, 1.0}},
          {w.sector.node(last - 1, 2), normal},
          {w.sector.node(last, 3), normal}};
}

}  // namespace

TEST(SolidModes, AreThoseOfTheWholeWheel) {
  const SmallWheel w;
  for (const double spin : {0.0, -40.0}) {
    const modal::Modes found = modal::cyclic_modes(w.cyclic(), spin, 24);
    const std::vector<double> exact = dense_frequencies(w, spin);
    ASSERT_GE(found.modes.size(), 24U);
    EXPECT_TRUE(found.counted);
    for (std::size_t k = 0; k < found.modes.size(); ++k) {
      EXPECT_NEAR(found.modes[k].omega / exact[k], 1.0, 1e-8) << spin << " " << k;
      EXPECT_LT(modal::residual(w.cyclic(), spin, found.modes[k]), 1e-8) << spin << " " << k;
    }
  }
}

TEST(SolidModes, HeldByTheGroundAreThoseOfTheConstrainedWheel) {
  const SmallWheel w;
  const std::vector<modal::HeldDirection<3>> held = some_held(w);
  const auto found = modal::held_modes<3>(w.cyclic(), held, 20);
  const std::vector<double> exact = dense_held(w, held);
  ASSERT_GE(found.modes.size(), 20U);
  EXPECT_TRUE(found.counted);
  for (std::size_t k = 0; k < found.modes.size(); ++k) {
    EXPECT_NEAR(found.modes[k].omega / exact[k], 1.0, 1e-8) << k;
    EXPECT_LT(modal::residual<3>(w.cyclic(), held, found.modes[k]), 1e-8) << k;
  }
  for (const int count : {1, 2, 3, 5, 8, 12}) {
    const auto few = modal::held_modes<3>(w.cyclic(), held, count);
    EXPECT_TRUE(few.counted) << count;
    EXPECT_EQ(few.modes.size(), static_cast<std::size_t>(count));
  }
  const auto loose = modal::held_modes<3>(w.cyclic(), {}, 20);
  EXPECT_LT(loose.modes[0].omega, found.modes[0].omega);
  EXPECT_NEAR(loose.modes[0].omega / dense_frequencies(w, 0.0)[0], 1.0, 1e-8);
}

/// A mode that moves along a held direction is none.
TEST(SolidModes, AResidualSeesAHeldNodeThatMoves) {
  const SmallWheel w;
  const modal::Modes found = modal::held_modes<3>(w.cyclic(), {}, 1);
  EXPECT_GT(modal::residual<3>(w.cyclic(), some_held(w), found.modes[0]), 1e-3);
}

/// (α/ω + βω)/2 at rest; in spin that of the damped equation by dense matrices, to second order.
TEST(SolidModes, DecayAsTheDampedEquationSays) {
  const SmallWheel w;
  const modal::Damping damping{3.0, 2e-5};
  const modal::Mode rest = modal::cyclic_modes(w.cyclic(), 0.0, 1).modes[0];
  EXPECT_NEAR(modal::damping_ratio(w.mass, 0.0, rest, damping),
              0.5 * (damping.mass / rest.omega + damping.stiffness * rest.omega), 1e-12);
  const double spin = -40.0;
  const Index n = w.stiffness.rows();
  MatrixXd companion = MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n).setIdentity();
  companion.bottomLeftCorner(n, n) = -w.stiffness;
  companion.bottomRightCorner(n, n) =
      -damping.mass * MatrixXd::Identity(n, n) - damping.stiffness * w.stiffness;
  for (Index k = 0; k < n; k += 3) {
    companion(n + k, k) += spin * spin;
    companion(n + k + 1, k + 1) += spin * spin;
    companion(n + k, n + k + 1) += 2.0 * spin;
    companion(n + k + 1, n + k) -= 2.0 * spin;
  }
  const Eigen::VectorXcd lambda = Eigen::EigenSolver<MatrixXd>(companion, false).eigenvalues();
  for (const modal::Mode& mode : modal::cyclic_modes(w.cyclic(), spin, 6).modes) {
    std::complex<double> nearest;
    for (Index k = 0; k < lambda.size(); ++k)
      if (std::abs(lambda[k].imag() - mode.omega) < std::abs(nearest.imag() - mode.omega))
        nearest = lambda[k];
    const double exact = -nearest.real() / std::abs(nearest.imag());
    EXPECT_NEAR(modal::damping_ratio(w.mass, spin, mode, damping) / exact, 1.0, 1e-3);
  }
}

}  // namespace solid_modes_test
