// SPDX-License-Identifier: BSD-3-Clause
/// Frequencies and damping of viscous bodies against all eigenvalues of their equations of motion.
#include "rondo/modal/viscous_mode.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "rondo/fem/stiffness_product.hpp"
#include "rondo/mesh/disk.hpp"

namespace viscous_mode_test {
namespace {

using namespace rondo;
using Eigen::Index;
using Eigen::MatrixXd;
using Parts = std::vector<fem::ViscousPart<fem::BlockCsr>>;

struct Body {
  mesh::Mesh mesh = mesh::make_disk({.outer_radius = 0.3,
                                     .inner_radius = 0.2,
                                     .radial = 2,
                                     .circumferential = 12,
                                     .grading = 1.0,
                                     .tread = {}});
  std::vector<fem::Material> materials;
  Parts parts;
  std::vector<double> mass;
  fem::BlockCsr stiffness;
  std::vector<int> free;

  /// @param second branches of the outer layer
  explicit Body(const std::vector<fem::ViscousBranch>& second)
      : materials(2, {1e6, 0.3, 1000.0, fem::Plane::strain}) {
    mesh.region_names = {"inner", "outer"};
    for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
      const Vec2 middle = mesh.coordinates[static_cast<std::size_t>(mesh.cells[e][0])];
      mesh.region.push_back(norm(middle) > 0.24 ? 1 : 0);
    }
    materials[0].branches = {{0.3, 2e-3}, {0.2, 1e-2}};
    materials[1].branches = second;
    parts = fem::viscous_parts<fem::BlockCsr>(mesh, materials, fem::ViscousBy::branches);
    mass = fem::lumped_mass(mesh, materials);
    stiffness = fem::assemble_stiffness(mesh, materials);
    free = fem::free_nodes(mesh);
  }

  [[nodiscard]] MatrixXd dense(const fem::BlockCsr& k) const {
    const Index n = 2 * std::ssize(free);
    MatrixXd all(n, n);
    for (Index c = 0; c < n; ++c) {
      std::vector<Vec2> u(mesh.n_nodes()), force(u.size());
      Vec2& at = u[static_cast<std::size_t>(free[static_cast<std::size_t>(c / 2)])];
      (c % 2 == 0 ? at.x : at.y) = 1.0;
      fem::apply(k, u, force, 1);
      for (Index r = 0; r < n; ++r) {
        const Vec2 f = force[static_cast<std::size_t>(free[static_cast<std::size_t>(r / 2)])];
        all(r, c) = r % 2 == 0 ? f.x : f.y;
      }
    }
    return all;
  }

  /// The eigenvalues of the linear system whose unknowns are u, v and the displacements of all
  /// branches.
  [[nodiscard]] Eigen::VectorXcd eigenvalues(double beta) const {
    const Index n = 2 * std::ssize(free);
    Index count = 2;
    for (const auto& part : parts) count += std::ssize(part.branches);
    MatrixXd system = MatrixXd::Zero(count * n, count * n);
    Eigen::VectorXd inverse(n);
    for (Index r = 0; r < n; ++r)
      inverse[r] = 1.0 / mass[static_cast<std::size_t>(free[static_cast<std::size_t>(r / 2)])];
    const MatrixXd k = dense(stiffness), minus = -MatrixXd(inverse.asDiagonal()),
                   unit = MatrixXd::Identity(n, n);
    system.block(0, n, n, n) = unit;
    system.block(n, 0, n, n) = minus * k;
    system.block(n, n, n, n) = beta * minus * k;
    Index at = 2 * n;
    for (const auto& part : parts)
      for (const fem::ViscousBranch& b : part.branches) {
        const MatrixXd v = -b.relative_modulus * minus * dense(part.stiffness);
        system.block(n, 0, n, n) -= v;
        system.block(n, at, n, n) = v;
        system.block(at, 0, n, n) = unit / b.time;
        system.block(at, at, n, n) = -unit / b.time;
        at += n;
      }
    return system.eigenvalues();
  }
};

/// The largest relative distance of the lowest modes from an eigenvalue.
double worst(const Body& body, double beta) {
  const Eigen::VectorXcd all = body.eigenvalues(beta);
  modal::Modes found = modal::mesh_modes({body.mesh, body.stiffness, body.mass}, 0.0, 10);
  double largest = 0.0;
  for (modal::Mode& mode : found.modes) {
    const double slow = mode.omega;
    const double ratio =
        modal::take_branches<fem::BlockCsr>(body.parts, body.mass, 0.0, {0.0, beta}, mode);
    EXPECT_GT(mode.omega, 1.02 * slow);
    EXPECT_GT(ratio, 0.01);
    const double size = mode.omega;
    const std::complex<double> root{-ratio * size, size * std::sqrt(1.0 - ratio * ratio)};
    double nearest = size;
    for (const std::complex<double>& value : all)
      nearest = std::min(nearest, std::abs(value - root));
    largest = std::max(largest, nearest / size);
  }
  return largest;
}

}  // namespace

TEST(ViscousModes, AreExactWhereAllOfTheBodyHasTheSameBranches) {
  EXPECT_LT(worst(Body({{0.3, 2e-3}, {0.2, 1e-2}}), 1e-5), 1e-10);
}

TEST(ViscousModes, AreOfSecondOrderInTheLossElsewhere) {
  const double large = worst(Body({{0.1, 2e-3}}), 0.0);
  EXPECT_LT(large, 0.02);
  EXPECT_GT(large, 1e-6);
}

TEST(ViscousModes, WithoutBranchesHaveTheRatioOfTheDampingAlone) {
  const Body body({});
  modal::Modes found = modal::mesh_modes({body.mesh, body.stiffness, body.mass}, 0.0, 4);
  for (modal::Mode& mode : found.modes) {
    const double omega = mode.omega;
    const double expected = modal::damping_ratio(body.mass, 0.0, mode, {1.0, 1e-5});
    const double ratio =
        modal::take_branches<fem::BlockCsr>(Parts{}, body.mass, 0.0, {1.0, 1e-5}, mode);
    EXPECT_NEAR(ratio, expected, 1e-10);
    EXPECT_NEAR(mode.omega, omega, 1e-9 * omega);
  }
}

TEST(ViscousModes, ThatAreOverdampedStay) {
  const Body body({{0.3, 2e-3}});
  modal::Modes found = modal::mesh_modes({body.mesh, body.stiffness, body.mass}, 0.0, 1);
  modal::Mode& mode = found.modes.front();
  const double omega = mode.omega;
  EXPECT_TRUE(std::isnan(
      modal::take_branches<fem::BlockCsr>(body.parts, body.mass, 0.0, {10.0 * omega, 0.0}, mode)));
  EXPECT_EQ(mode.omega, omega);
}

}  // namespace viscous_mode_test
