// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/solid/solid_sector.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <tuple>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/harmonics.hpp"
#include "rondo/fem/solid/hexahedron.hpp"
#include "rondo/fem/solid/solid_stress.hpp"
#include "rondo/mesh/solid/face.hpp"
#include "rondo/mesh/solid/wheel.hpp"

namespace solid_sector_test {

using namespace rondo;
using mesh::Mesh;
using mesh::Wheel;

namespace {

const fem::Material material{2.0e7, 0.3, 1100.0};
const fem::Material b_bar{2.0e7, 0.45, 1100.0, fem::Plane::strain, fem::Integration::b_bar};

std::vector<Wheel> wheels() {
  Wheel smooth;
  smooth.width = 0.1;
  smooth.disk.radial = 3;
  smooth.disk.circumferential = 20;
  Wheel treaded = smooth;
  treaded.axial = 3;
  treaded.disk.tread = mesh::Tread{.pitches = 7, .layers = 2};
  return {smooth, treaded};
}

using Vectors = std::vector<Vec3>;

template <class Displacement>
Vectors field(const Mesh& m, const Displacement& displacement) {
  Vectors f(m.n_nodes());
  for (std::size_t i = 0; i < m.n_nodes(); ++i)
    f[i] = displacement(mesh::place_of(m, static_cast<int>(i)));
  return f;
}

/// Σ K_e u over all elements, every node counted.
Vectors by_elements(const Mesh& m, std::span<const fem::Material> of, const Vectors& f) {
  Vectors out(m.n_nodes());
  for (std::size_t e = 0; e < m.hexahedra.size(); ++e) {
    const mesh::Hexahedron& h = m.hexahedra[e];
    fem::HexahedronCorners x;
    Eigen::Matrix<double, 24, 1> u;
    for (std::size_t i = 0; i < 8; ++i) {
      x[i] = mesh::place_of(m, h[i]);
      const Vec3 v = f[static_cast<std::size_t>(h[i])];
      u.segment<3>(static_cast<Eigen::Index>(3 * i)) << v.x, v.y, v.z;
    }
    const Eigen::Matrix<double, 24, 1> force =
        fem::hexahedron_stiffness(x, fem::material_of(m, of, e)) * u;
    for (std::size_t i = 0; i < 8; ++i) {
      const auto at = static_cast<Eigen::Index>(3 * i);
      out[static_cast<std::size_t>(h[i])] += Vec3{force[at], force[at + 1], force[at + 2]};
    }
  }
  return out;
}

Vectors product(const Mesh& m, std::span<const fem::Material> of, const Vectors& f) {
  Vectors out(m.n_nodes());
  fem::apply(fem::assemble_solid_sector(m, of), f, out);
  return out;
}

}  // namespace

/// Any field, one material or two in layers: the blocks of one sector are the whole stiffness.
TEST(SolidSector, ProductIsThatOfTheElements) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-1.0, 1.0);
  for (const Wheel& wheel : wheels())
    for (const auto& of : std::vector<std::vector<fem::Material>>{{material}, {b_bar, material}}) {
      Mesh m = mesh::make_wheel(wheel);
      if (of.size() == 2)
        for (const mesh::Hexahedron& h : m.hexahedra)
          m.region.push_back(norm(m.coordinates[static_cast<std::size_t>(h[0])]) < 0.19 ? 0 : 1);
      const std::vector<char> clamped = mesh::clamped_flags(m);
      Vectors f = field(m, [&](Vec3) { return Vec3{x(random), x(random), x(random)}; });
      for (const int i : m.clamped) f[static_cast<std::size_t>(i)] = {};
      const Vectors expected = by_elements(m, of, f), found = product(m, of, f);
      double largest = 0.0, error = 0.0;
      for (std::size_t i = 0; i < m.n_nodes(); ++i) {
        const Vec3 e = clamped[i] ? Vec3{} : expected[i];
        largest = std::max(largest, norm(e));
        error = std::max(error, norm(e - found[i]));
      }
      EXPECT_GT(largest, 1e5);
      EXPECT_LT(error, 1e-13 * largest);
    }
}

/// Patch test on the elements of a revolved sector, which are no bricks: a linear displacement
/// leaves no force inside, and its stress everywhere.
TEST(SolidSector, LinearDisplacementIsInBalanceInside) {
  const auto linear = [](Vec3 x) {
    return 1e-3 *
           Vec3{x.x - 2 * x.y + 0.5 * x.z, 0.3 * x.x + x.y - x.z, -x.x + 0.7 * x.y + 2 * x.z};
  };
  for (const Wheel& wheel : wheels())
    for (const fem::Material& of : {material, b_bar}) {
      Mesh m = mesh::make_wheel(wheel);
      std::vector<char> outside(m.n_nodes(), 0);
      for (const mesh::Surface& s : m.surfaces)
        for (const mesh::Face& face : s.faces)
          for (const int node : face) outside[static_cast<std::size_t>(node)] = 1;
      m.clamped.clear();
      const Vectors f = field(m, linear), force = product(m, {&of, 1}, f);
      fem::SolidStressRecovery recovery(m, {&of, 1});
      const auto stress = recovery(f);
      std::size_t inside = 0;
      for (std::size_t i = 0; i < m.n_nodes(); ++i) {
        for (std::size_t c = 0; c < 6; ++c)
          EXPECT_NEAR(stress[i][c], stress[0][c], 1e-10 * std::abs(stress[0][0]));
        if (outside[i] || norm(m.coordinates[i]) > 0.285) continue;  // the tread's grooves
        ++inside;
        EXPECT_LT(norm(force[i]), 1e-11 * of.youngs_modulus * 1e-3 * 1e-3);  // E ε h²
      }
      EXPECT_GT(inside, 80U);
      EXPECT_NEAR(stress[0][3], of.youngs_modulus / (2 * (1 + of.poissons_ratio)) * -1.7e-3, 1e-6);
    }
}

TEST(SolidSector, RigidMotionsOfAFreeBodyNeedNoForce) {
  const std::vector<Vec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Wheel& wheel : wheels()) {
    Mesh m = mesh::make_wheel(wheel);
    m.clamped.clear();
    for (const Vec3 axis : axes) {
      const Vectors shift = product(m, {&material, 1}, field(m, [&](Vec3) { return axis; }));
      const Vectors turn =
          product(m, {&material, 1}, field(m, [&](Vec3 x) { return cross(axis, x); }));
      for (std::size_t i = 0; i < m.n_nodes(); ++i) {
        EXPECT_LT(norm(shift[i]), 1e-13 * 2e7);
        EXPECT_LT(norm(turn[i]), 1e-13 * 2e7);
      }
    }
  }
}

TEST(SolidSector, IsSymmetricToTheLastBit) {
  for (const Wheel& wheel : wheels()) {
    const fem::SolidSector k = fem::assemble_solid_sector(mesh::make_wheel(wheel), {&b_bar, 1});
    std::map<std::tuple<std::size_t, std::size_t, int>, std::array<double, 9>> blocks;
    for (std::size_t a = 0; a < k.n_local(); ++a)
      for (const auto& e : k.row(a))
        blocks[{a, static_cast<std::size_t>(e.column), e.shift}] = e.block;
    EXPECT_EQ(blocks.size(), k.entries.size());
    for (const auto& [key, b] : blocks) {
      const auto& [row, column, shift] = key;
      const std::array<double, 9> t{b[0], b[3], b[6], b[1], b[4], b[7], b[2], b[5], b[8]};
      EXPECT_EQ((blocks.at({column, row, -shift})), t);
    }
  }
}

/// What lies before a smooth sector is the mirror image of what lies behind: forces and
/// displacements along the way around change their sign. To round-off: coordinates over the size of
/// an element.
TEST(SolidSector, SmoothSectorIsItsOwnMirrorImage) {
  const fem::SolidSector k = fem::assemble_solid_sector(mesh::make_wheel(wheels()[0]), {&b_bar, 1});
  std::map<std::tuple<std::size_t, int, int>, std::array<double, 9>> blocks;
  double largest = 0.0;
  for (std::size_t a = 0; a < k.n_local(); ++a)
    for (const auto& e : k.row(a)) {
      blocks[{a, e.column, e.shift}] = e.block;
      largest = std::max(largest, e.block[0]);
    }
  for (const auto& [key, b] : blocks) {
    const auto& [row, column, shift] = key;
    const std::array<double, 9>& other = blocks.at({row, column, -shift});
    for (std::size_t q = 0; q < 9; ++q) {  // component 0 is along the way around at -90°
      const double sign = (q % 3 == 0) == (q / 3 == 0) ? 1.0 : -1.0;
      EXPECT_NEAR(other[q], sign * b[q], 1e-14 * largest);
    }
  }
}

TEST(SolidSector, RowsGoOutwardsLayerByLayer) {
  const Mesh m = mesh::make_wheel(wheels()[1]);
  const fem::SolidSector k = fem::assemble_solid_sector(m, {&material, 1});
  double radius = 0.15;
  for (std::size_t a = 0; a < k.n_local(); ++a) {
    const double r = norm(m.coordinates[k.node(a, 0)]);
    EXPECT_GT(r, radius - 1e-12);
    radius = r;
  }
}

TEST(SolidSector, MassesSumToTheVolume) {
  const Mesh m = mesh::make_wheel(wheels()[0]);
  const std::vector<double> mass = fem::solid_mass(m, {&material, 1});
  const double area =
      0.5 * 20 * std::sin(2.0 * std::numbers::pi / 20) * (0.30 * 0.30 - 0.15 * 0.15);
  EXPECT_NEAR(std::accumulate(mass.begin(), mass.end(), 0.0), 1100.0 * 0.1 * area, 1e-12);
  for (const double value : mass) EXPECT_GT(value, 0.0);
}

/// One element wide, no node moving along the axle: both faces together are the plane disk.
TEST(SolidSector, PlanePartIsThePlaneDisk) {
  Wheel wheel = wheels()[0];
  wheel.axial = 1;
  const Mesh solid = mesh::make_wheel(wheel), plane = mesh::make_disk(wheel.disk);
  const fem::SectorStiffness k = plane_part(fem::assemble_solid_sector(solid, {&material, 1}));
  const fem::SectorStiffness expected = fem::assemble_sector(plane, {&material, 1});
  std::map<std::tuple<int, int, int>, std::array<double, 4>> sum;
  for (std::size_t a = 0; a < k.n_local(); ++a)
    for (const auto& e : k.row(a)) {
      auto& block = sum[{static_cast<int>(a) / 2, e.column / 2, e.shift}];
      for (std::size_t q = 0; q < 4; ++q) block[q] += e.block[q];
    }
  EXPECT_EQ(sum.size(), expected.entries.size());
  for (std::size_t a = 0; a < expected.n_local(); ++a)
    for (const auto& e : expected.row(a))
      for (std::size_t q = 0; q < 4; ++q)
        EXPECT_NEAR((sum.at({static_cast<int>(a), e.column, e.shift})[q]), 0.1 * e.block[q],
                    1e-13 * 2e6);
  const std::vector<double> mass = fem::solid_mass(solid, {&material, 1}),
                            area = fem::lumped_mass(plane, {&material, 1});
  for (std::size_t i = 0; i < plane.n_nodes(); ++i)
    EXPECT_NEAR(mass[2 * i] + mass[2 * i + 1], 0.1 * area[i], 1e-13 * area[i]);
}

TEST(SolidSector, PressureAllAroundHasNoResultantAndInflates) {
  const Mesh m = mesh::make_wheel(wheels()[0]);
  const fem::SolidSector k = fem::assemble_solid_sector(m, {&material, 1});
  for (const mesh::Surface& s : m.surfaces) {
    if (s.name == "rim") continue;
    Vec3 sum;
    for (const Vec3 f : fem::sector_pressure(m, k, s.faces)) sum += f;
    const double side = 0.5 * std::sin(2.0 * std::numbers::pi / 20) * (0.09 - 0.0225);
    const double chord = 2.0 * 0.30 * std::sin(std::numbers::pi / 20);
    if (s.name == "tread") {  // of a sector straight down: up, in the mean of its two chords
      EXPECT_NEAR(sum.x, 0.0, 1e-16);
      EXPECT_NEAR(sum.y, 0.1 * chord * std::cos(std::numbers::pi / 20), 1e-15);
    } else {  // without the rim's share
      EXPECT_GT(s.name == "left" ? sum.z : -sum.z, 0.6 * side);
      EXPECT_LT(s.name == "left" ? sum.z : -sum.z, side);
    }
  }
}

/// Thick ring under pressure from inside, held along the axle, nearly incompressible: with full
/// quadrature the elements, whose sides are turned towards each other, are too stiff by far.
TEST(SolidSector, NearlyIncompressibleRingDoesNotLockWithBBar) {
  constexpr double a = 0.15, b = 0.30, p = 1e4;
  for (const fem::Integration integration : {fem::Integration::b_bar, fem::Integration::full}) {
    const fem::Material of{2e7, 0.4999, 1100.0, fem::Plane::strain, integration};
    Wheel wheel = wheels()[0];
    wheel.disk.radial = 6;
    wheel.disk.circumferential = 40;
    wheel.axial = 2;
    Mesh m = mesh::make_wheel(wheel);
    m.clamped.clear();
    const fem::SolidSector k = fem::assemble_solid_sector(m, {&of, 1});
    const std::vector<double> ones(m.n_nodes(), 1.0);
    fem::Harmonics harmonics(k, ones);
    const Eigen::MatrixXcd lower = harmonics.lower(0, 1.0, 0.0);
    const auto n = static_cast<Eigen::Index>(k.n_local());
    Eigen::MatrixXd radial(n, n);  // component 1 of sector 0 points inwards
    Eigen::VectorXd load(n);
    const std::vector<Vec3> force = fem::sector_pressure(m, k, m.surfaces.front().faces);
    ASSERT_EQ(m.surfaces.front().name, "rim");
    for (Eigen::Index i = 0; i < n; ++i) {
      load[i] = p * force[static_cast<std::size_t>(i)].y;
      for (Eigen::Index j = 0; j <= i; ++j) radial(i, j) = lower(3 * i + 1, 3 * j + 1).real();
    }
    const Eigen::VectorXd inwards = radial.selfadjointView<Eigen::Lower>().llt().solve(load);
    Vectors f(m.n_nodes());
    for (Eigen::Index i = 0; i < n; ++i)
      for (std::size_t j = 0; j < 40; ++j)
        f[k.node(static_cast<std::size_t>(i), j)] = k.turn[j] * Vec2{0.0, inwards[i]};
    const double nu = of.poissons_ratio;
    const auto exact = [&](double r) {
      return p * a * a * (1 + nu) * ((1 - 2 * nu) * r + b * b / r) /
             (of.youngs_modulus * (b * b - a * a));
    };
    const double error = std::abs(-f[0].y / exact(a) - 1.0);
    if (integration == fem::Integration::full) {
      EXPECT_GT(error, 0.5);
      continue;
    }
    EXPECT_LT(error, 0.01);
    fem::SolidStressRecovery recovery(m, {&of, 1});
    const auto stress = recovery(f);
    for (std::size_t i = 3 * 3; i < 3 * 6; ++i) {  // straight down: y is the radius
      const double r = norm(m.coordinates[i]), ratio = a * a / (b * b - a * a);
      EXPECT_NEAR(stress[i][1], p * ratio * (1 - b * b / (r * r)), 0.02 * p);
      EXPECT_NEAR(stress[i][0], p * ratio * (1 + b * b / (r * r)), 0.02 * p);
      EXPECT_NEAR(stress[i][2], 2 * nu * p * ratio, 0.02 * p);
    }
  }
}

/// Element by element, on any field.
TEST(SolidStress, AtTheNodesIsTheMeanOfTheElementsAround) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-1e-3, 1e-3);
  for (const Wheel& wheel : wheels()) {
    const Mesh m = mesh::make_wheel(wheel);
    const Vectors f = field(m, [&](Vec3) { return Vec3{x(random), x(random), x(random)}; });
    std::vector<fem::SolidStress> sum(m.n_nodes());
    std::vector<double> weight(m.n_nodes(), 0.0);
    for (const mesh::Hexahedron& h : m.hexahedra) {
      fem::HexahedronCorners corners, u;
      for (std::size_t i = 0; i < 8; ++i) {
        corners[i] = mesh::place_of(m, h[i]);
        u[i] = f[static_cast<std::size_t>(h[i])];
      }
      const auto stress = fem::hexahedron_stress(corners, u, b_bar);
      const std::array<double, 8> volume = fem::hexahedron_volumes(corners);
      for (std::size_t i = 0; i < 8; ++i) {
        const auto node = static_cast<std::size_t>(h[i]);
        for (std::size_t c = 0; c < 6; ++c) sum[node][c] += volume[i] * stress[i][c];
        weight[node] += volume[i];
      }
    }
    const std::vector<fem::SolidStress> found = fem::solid_stress(m, {&b_bar, 1}, f);
    for (std::size_t i = 0; i < m.n_nodes(); ++i)
      for (std::size_t c = 0; c < 6; ++c)
        EXPECT_NEAR(found[i][c], sum[i][c] / weight[i], 1e-11 * b_bar.youngs_modulus * 1e-3);
  }
}

TEST(SolidStress, TurnsAboutTheAxle) {
  const fem::SolidStress s{3, -2, 5, 1, -4, 2};
  const Complex r = rotation(0.7);
  Eigen::Matrix3d tensor, turn;
  tensor << 3, 1, 2, 1, -2, -4, 2, -4, 5;
  turn << r.re, -r.im, 0, r.im, r.re, 0, 0, 0, 1;
  const Eigen::Matrix3d expected = turn * tensor * turn.transpose();
  const fem::SolidStress found = fem::turned(s, r);
  const std::array<double, 6> of{expected(0, 0), expected(1, 1), expected(2, 2),
                                 expected(0, 1), expected(1, 2), expected(2, 0)};
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(found[c], of[c], 1e-14);
  EXPECT_NEAR(fem::von_mises(found), fem::von_mises(s), 1e-14);
  EXPECT_DOUBLE_EQ(fem::von_mises({2, 0, 0, 0, 0, 0}), 2.0);
  EXPECT_DOUBLE_EQ(fem::von_mises({0, 0, 0, 0, 3, 0}), 3.0 * std::sqrt(3.0));
}

}  // namespace solid_sector_test
