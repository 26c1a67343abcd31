// SPDX-License-Identifier: BSD-3-Clause
/// V36: wheels in three dimensions in stationary spin, and their frequencies: with no motion along
/// the axle those of the plane disk, without force along it those of plane stress, and between
/// these a wheel that is bonded to its rim.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <map>

#include "rondo/fem/harmonics.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/mesh/solid/wheel.hpp"
#include "rondo/modal/modes.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "support/spinning_annulus.hpp"

namespace v36_wheel_statics {

using namespace rondo;
using modal::Wave;

namespace {

const fem::Material strain{5e6, 0.45, 1100.0, fem::Plane::strain};
const fem::Material stress{5e6, 0.45, 1100.0, fem::Plane::stress};
constexpr double spin = -50.0;

/// The annulus of the plane, 12 columns to a layer.
mesh::Wheel annulus(int radial, int axial, double width) {
  mesh::Wheel wheel;
  wheel.disk = {.outer_radius = 0.3,
                .inner_radius = 0.2,
                .radial = radial,
                .circumferential = 12 * radial,
                .grading = 1.0,
                .tread = {}};
  wheel.width = width;
  wheel.axial = axial;
  return wheel;
}

/// A wheel one element wide of which no node moves along the axle, and both faces move as one.
struct Held {
  fem::SectorStiffness k;
  std::vector<double> mass;
  std::vector<Vec2> reference;
};

Held hold(int radial) {
  const mesh::Mesh m = mesh::make_wheel(annulus(radial, 1, 0.1));
  const fem::SectorStiffness faces = plane_part(fem::assemble_solid_sector(m, {&strain, 1}));
  const std::vector<double> mass = fem::solid_mass(m, {&strain, 1});
  Held held;
  held.k.n_sectors = faces.n_sectors;
  held.k.nodes_per_sector = faces.nodes_per_sector / 2;
  held.k.turn = faces.turn;
  held.k.row_start = {0};
  for (std::size_t a = 0; a < faces.n_local(); a += 2) {
    held.k.nodes.push_back(faces.nodes[a] / 2);
    // Face with itself, face with the other: two terms each, so that K stays symmetric to the last
    // bit.
    std::map<std::pair<int, int>, std::array<std::array<double, 4>, 2>> row;
    for (const std::size_t face : {a, a + 1})
      for (const auto& e : faces.row(face)) {
        const bool other = (static_cast<int>(face) - e.column) % 2 != 0;
        for (std::size_t q = 0; q < 4; ++q)
          row[{e.column / 2, e.shift}][other ? 1 : 0][q] += e.block[q];
      }
    for (const auto& [place, sum] : row) {
      std::array<double, 4> block{};
      for (std::size_t q = 0; q < 4; ++q) block[q] = sum[0][q] + sum[1][q];
      held.k.entries.push_back({place.first, place.second, block});
    }
    held.k.row_start.push_back(held.k.entries.size());
  }
  for (std::size_t i = 0; i < m.n_nodes(); i += 2) {
    held.mass.push_back(mass[i] + mass[i + 1]);
    held.reference.push_back(m.coordinates[i]);
  }
  return held;
}

/// Of the top, straight down.
double held_displacement(int radial) {
  const Held held = hold(radial);
  const auto s = statics::stationary_spin(held.k, held.mass, held.reference, spin);
  EXPECT_EQ(s.status, statics::SpinStatus::solved);
  return -s.u.plane()[static_cast<std::size_t>(radial)].y;
}

/// Outward displacement of the top across the width; (K - s²MP) u = s² M P X with a rim that holds
/// the radial and tangential components alone.
std::vector<double> free_along_the_axle(const mesh::Wheel& wheel) {
  mesh::Mesh m = mesh::make_wheel(wheel);
  const std::vector<char> rim = mesh::clamped_flags(m);
  m.clamped.clear();
  const fem::SolidSector k = fem::assemble_solid_sector(m, {&strain, 1});
  const std::vector<double> mass = fem::solid_mass(m, {&strain, 1});
  const std::vector<double> ones(m.n_nodes(), 1.0);
  fem::Harmonics harmonics(k, ones);
  Eigen::SparseMatrix<double> a = harmonics.lower(0, 1.0, 0.0).real();
  Eigen::VectorXd load = Eigen::VectorXd::Zero(a.rows());
  const auto held = [&](Eigen::Index i) {  // and one node along the axle, where nothing pulls
    const std::size_t node = k.node(static_cast<std::size_t>(i / 3), 0);
    return i % 3 == 2 ? i == 2 : rim[node] != 0;
  };
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const std::size_t node = k.node(static_cast<std::size_t>(i / 3), 0);
    const Vec2 x = m.coordinates[node];
    if (i % 3 == 2 || held(i)) continue;
    a.coeffRef(i, i) -= spin * spin * mass[node];
    load[i] = spin * spin * mass[node] * (i % 3 == 0 ? x.x : x.y);
  }
  a.prune([&](Eigen::Index i, Eigen::Index j, double) { return i == j || !(held(i) || held(j)); });
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor(a);
  const Eigen::VectorXd u = factor.solve(load);
  std::vector<double> top;
  for (Eigen::Index j = wheel.axial; j >= 0; --j) top.push_back(-u[a.rows() - 3 * (j + 1) + 1]);
  return top;
}

/// Mean over the width of equal elements.
double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) sum += 0.5 * (values[i] + values[i + 1]);
  return sum / static_cast<double>(values.size() - 1);
}

}  // namespace

TEST(WheelStatics, HeldAlongTheAxleItIsThePlaneDisk) {
  const test::SpinningAnnulus exact(strain, 0.2, 0.3, -spin);
  EXPECT_NEAR(exact.displacement(0.3), 1.591599e-4, 5e-11);
  EXPECT_NEAR(held_displacement(16), 1.592785e-4, 5e-11);  // of an independent program
  double before = 0.0;
  for (const int radial : {4, 8, 16, 32}) {
    const double error = std::abs(held_displacement(radial) / exact.displacement(0.3) - 1.0);
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.1) << radial;
    }
    before = error;
  }
}

/// Two elements over 10 mm. Where the rim holds the layers but not their thickness the mean over
/// the width is that of plane stress.
TEST(WheelStatics, FreeAlongTheAxleItIsInPlaneStress) {
  const test::SpinningAnnulus exact(stress, 0.2, 0.3, -spin);
  EXPECT_NEAR(exact.displacement(0.3), 5.402389e-4, 5e-11);
  const std::map<int, double> expected{{8, 5.410479e-4}, {16, 5.404258e-4}, {24, 5.403196e-4}};
  std::map<int, double> error;
  for (const auto& [radial, value] : expected) {
    const double found = mean_of(free_along_the_axle(annulus(radial, 2, 0.01)));
    EXPECT_NEAR(found, value, 5e-11) << radial;  // of an independent program
    error[radial] = found - exact.displacement(0.3);
  }
  EXPECT_NEAR(std::log(error[8] / error[16]) / std::log(2.0), 2.0, 0.15);
  EXPECT_NEAR(std::log(error[16] / error[24]) / std::log(1.5), 2.0, 0.15);
}

TEST(WheelStatics, BondedToItsRimItBulgesInTheMiddle) {
  const mesh::Wheel wheel = annulus(16, 16, 0.1);
  const mesh::Mesh m = mesh::make_wheel(wheel);
  const auto s = statics::stationary_spin(fem::assemble_solid_sector(m, {&strain, 1}),
                                          fem::solid_mass(m, {&strain, 1}), m.coordinates, spin);
  ASSERT_EQ(s.status, statics::SpinStatus::solved);
  const std::size_t top = 16 * 17;
  const std::span<const Vec3> u = s.u.space();
  EXPECT_NEAR(-u[top + 8].y, 4.874e-4, 5e-8);  // of an independent program
  EXPECT_NEAR(-u[top].y, 4.031e-4, 5e-8);
  for (std::size_t j = 0; j < 17; ++j) {
    EXPECT_NEAR(u[top + j].y, u[top + 16 - j].y, 1e-15);
    EXPECT_NEAR(u[top + j].z, -u[top + 16 - j].z, 1e-15);
  }
}

/// On this mesh, of an independent program [rad/s].
TEST(WheelStatics, HeldAlongTheAxleItHasTheFrequenciesOfThePlaneDisk) {
  const std::map<std::pair<int, Wave>, double> expected{
      {{0, Wave::standing}, 475.433}, {{1, Wave::backward}, 550.527},
      {{1, Wave::forward}, 523.599},  {{2, Wave::backward}, 706.728},
      {{2, Wave::forward}, 653.511},  {{3, Wave::backward}, 879.892},
      {{3, Wave::forward}, 803.131}};
  const Held held = hold(32);
  const modal::Modes found = modal::cyclic_modes<2>({held.k, held.mass, held.reference}, spin, 16);
  EXPECT_TRUE(found.counted);
  std::map<std::pair<int, Wave>, double> lowest;
  for (const modal::Mode& mode : found.modes)
    lowest.try_emplace({mode.diameters, mode.wave}, mode.omega);
  for (const auto& [key, omega] : expected)
    EXPECT_NEAR(lowest.at(key), omega, 5.1e-4) << key.first << " " << static_cast<int>(key.second);
}

}  // namespace v36_wheel_statics
