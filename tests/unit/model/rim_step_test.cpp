// SPDX-License-Identifier: BSD-3-Clause
/// The critical step with a rim that forces move, against dense eigenvalues of the coupled system.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/stiffness_product.hpp"
#include "rondo/model/stability/rim_step.hpp"
#include "support/rings.hpp"

namespace rim_step_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

const fem::Material material{2.0e7, 0.3, 1100.0, fem::Plane::strain};

struct Body {
  mesh::Mesh mesh;
  std::vector<double> mass;
  std::vector<int> free;
  fem::BlockCsr k;
  double bonded_mass = 0.0, bonded_inertia = 0.0;  ///< [kg/m], [kg·m]
};

Body body_of(mesh::Mesh mesh) {
  Body b{mesh, fem::lumped_mass(mesh, {&material, 1}), fem::free_nodes(mesh),
         fem::assemble_stiffness(mesh, {&material, 1})};
  for (const int node : mesh.clamped) {
    const auto i = static_cast<std::size_t>(node);
    b.bonded_mass += b.mass[i];
    b.bonded_inertia += b.mass[i] * dot(mesh.coordinates[i], mesh.coordinates[i]);
  }
  return b;
}

Body disk_of(int radial, int circumferential) {
  mesh::Disk disk;
  disk.radial = radial, disk.circumferential = circumferential;
  return body_of(mesh::make_disk(disk));
}

/// ω̂² of u, x, y and θ, u relative to the rim: its kinetic energy is of the absolute velocities.
double dense_square(const Body& b, const RimDofs& rim) {
  const auto n = static_cast<Eigen::Index>(2 * b.free.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n + 3, n + 3), mass = stiffness;
  stiffness.topLeftCorner(n, n) = fem::free_matrix(b.k, b.free);
  for (int d = 0; d < 2; ++d) stiffness(n + d, n + d) = rim.spring[static_cast<std::size_t>(d)];
  Eigen::MatrixXd velocity = Eigen::MatrixXd::Identity(n, n + 3);  // absolute, of the free nodes
  Eigen::VectorXd m(n);
  for (Eigen::Index i = 0; i < n / 2; ++i) {
    const auto node = static_cast<std::size_t>(b.free[static_cast<std::size_t>(i)]);
    const Vec2 x = b.mesh.coordinates[node];
    velocity(2 * i, n) = velocity(2 * i + 1, n + 1) = 1.0;
    velocity(2 * i, n + 2) = -x.y;
    velocity(2 * i + 1, n + 2) = x.x;
    m[2 * i] = m[2 * i + 1] = b.mass[node];
  }
  mass = velocity.transpose() * m.asDiagonal() * velocity;
  std::vector<Eigen::Index> moving;
  for (Eigen::Index i = 0; i < n; ++i) moving.push_back(i);
  for (int d = 0; d < 3; ++d) {
    const double inertia = rim.inertia[static_cast<std::size_t>(d)];
    if (!std::isfinite(inertia)) continue;
    mass(n + d, n + d) += inertia;
    moving.push_back(n + d);
  }
  const Eigen::MatrixXd k = stiffness(moving, moving), of_moving = mass(moving, moving);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(k, of_moving,
                                                                        Eigen::EigenvaluesOnly);
  return dense.eigenvalues().maxCoeff();
}

CriticalStep held_step(const Body& b, LaggedDamping damping = {}) {
  return critical_step(fem::assemble_sector(b.mesh, {&material, 1}), b.mass, damping,
                       fem::sector_eigenvalue_bound(b.mesh, {&material, 1}));
}

RimFrequencies frequencies(const Body& b, const RimDofs& rim) {
  const auto product = [&](std::span<const Vec2> u, std::span<Vec2> out) {
    fem::apply(b.k, u, out, 1);
  };
  return rim_frequencies(product, b.mass, b.mesh.coordinates, b.free, rim);
}

double by_harmonics(const Body& b, const RimDofs& rim) {
  return with_rim(held_step(b), fem::assemble_sector(b.mesh, {&material, 1}), b.mass,
                  frequencies(b, rim), {})
      .omega;
}

double on_any_mesh(const Body& b, const RimDofs& rim) {
  return with_rim(held_step(b), frequencies(b, rim), {}).omega;
}

/// What is free of x, y and θ; the lightest rim there is: bonded nodes alone.
RimDofs rim_of(const Body& b, bool x, bool y, bool spin, double mass = 0.0, double inertia = 0.0) {
  RimDofs rim;
  if (x) rim.inertia[0] = b.bonded_mass + mass;
  if (y) rim.inertia[1] = b.bonded_mass + mass;
  if (spin) rim.inertia[2] = b.bonded_inertia + inertia;
  return rim;
}

}  // namespace

TEST(RimStep, IsABoundOfTheCoupledSystemAndNear) {
  struct Disk {
    int radial, circumferential;
    double near;
  };
  for (const auto& [radial, circumferential, near] :
       {Disk{1, 12, 1.3}, Disk{2, 24, 1.3}, Disk{6, 90, 1.01}}) {
    const Body b = disk_of(radial, circumferential);
    for (const double mass : {0.0, 1.0, 100.0})
      for (int dofs = 1; dofs < 8; ++dofs) {
        if (radial == 6 && (dofs != 7 || mass == 1.0)) continue;  // of a thousand unknowns
        const RimDofs rim =
            rim_of(b, (dofs & 1) != 0, (dofs & 2) != 0, (dofs & 4) != 0, mass, 0.02 * mass);
        const double omega = std::sqrt(dense_square(b, rim));
        SCOPED_TRACE(testing::Message() << radial << " layers, dofs " << dofs << ", " << mass);
        EXPECT_GE(by_harmonics(b, rim), omega * (1.0 - 1e-14));
        EXPECT_LE(by_harmonics(b, rim), omega * near);
        EXPECT_GE(on_any_mesh(b, rim), by_harmonics(b, rim));
      }
  }
}

/// Lighter than its bonded nodes, so that it vibrates faster than the mesh.
TEST(RimStep, ALightRimSetsTheStep) {
  const Body b = disk_of(2, 24);
  for (std::size_t dof = 0; dof < 3; ++dof) {
    RimDofs rim;
    rim.inertia[dof] = 0.02 * (dof < 2 ? b.bonded_mass : b.bonded_inertia);
    const double omega = std::sqrt(dense_square(b, rim));
    EXPECT_GT(omega, 1.1 * held_step(b).omega) << dof;
    EXPECT_GE(by_harmonics(b, rim), omega) << dof;
    EXPECT_LE(by_harmonics(b, rim), 1.5 * omega) << dof;
  }
}

/// A spring that is stiffer than the mesh sets the step.
TEST(RimStep, SpringsCount) {
  const Body b = disk_of(2, 24);
  RimDofs rim = rim_of(b, true, true, false, 1.0);
  for (const double stiffness : {1e7, 1e10}) {
    rim.spring = {0.0, stiffness};
    const double omega = std::sqrt(dense_square(b, rim));
    EXPECT_GE(by_harmonics(b, rim), omega);
    EXPECT_LE(by_harmonics(b, rim), 1.3 * omega);
  }
  EXPECT_GT(by_harmonics(b, rim), 3.0 * held_step(b).omega);
}

/// Without symmetry x, y and θ couple: the largest of the three alone would be no bound.
TEST(RimStep, IsABoundOnAMeshWithoutSectors) {
  mesh::Mesh half = mesh::make_disk([] {
    mesh::Disk disk;
    disk.radial = 1, disk.circumferential = 12;
    return disk;
  }());
  for (Vec2& x : half.coordinates) x = {x.x * (1.0 + x.x), 1.7 * x.y + 0.8 * x.x};
  const Body b = body_of(half);
  const CriticalStep held =
      critical_step(b.k, b.mass, b.free, {}, fem::element_eigenvalue_bound(b.mesh, {&material, 1}));
  for (const double mass : {0.0, 30.0}) {
    const RimDofs rim = rim_of(b, true, true, true, mass, 0.001);
    const RimFrequencies f = frequencies(b, rim);
    const RimValues& k = f.stiffness;
    EXPECT_GT(k.largest, std::max(k.translation, k.rotation));
    const double omega = std::sqrt(dense_square(b, rim));
    EXPECT_GE(with_rim(held, f, {}).omega, omega);
    EXPECT_LE(with_rim(held, f, {}).omega, 1.5 * omega);
  }
}

TEST(RimStep, HeldItIsTheStepOfTheBody) {
  const Body b = disk_of(2, 24);
  const LaggedDamping damping{2e-5, 200.0};
  const CriticalStep held = held_step(b, damping);
  const RimFrequencies f = frequencies(b, {});
  EXPECT_EQ(f.stiffness.largest, 0.0);
  EXPECT_EQ(f.mass.largest, 0.0);
  EXPECT_EQ(with_rim(held, f, damping).step, held.step);
  EXPECT_EQ(with_rim(held, fem::assemble_sector(b.mesh, {&material, 1}), b.mass, f, damping).step,
            held.step);
}

/// All harmonics together have the largest of the body; one alone is below the dense one.
TEST(RimStep, BoundsOfHarmonicsEncloseTheBody) {
  for (const mesh::Disk& disk : test::cyclic_disks()) {
    const mesh::Mesh mesh = mesh::make_disk(disk);
    const Body b = body_of(mesh);
    const double bound = fem::sector_eigenvalue_bound(b.mesh, {&material, 1});
    const fem::SectorStiffness k = fem::assemble_sector(b.mesh, {&material, 1});
    double largest = 0.0;
    for (int j = 0; j <= mesh.n_sectors / 2; ++j)
      largest = std::max(largest, harmonic_eigenvalue_bound(k, b.mass, j, bound));
    const double omega = held_step(b).omega;
    EXPECT_NEAR(largest, omega * omega, 3e-6 * largest);
  }
}

}  // namespace rim_step_test
