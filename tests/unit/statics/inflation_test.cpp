// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "rondo/core/index.hpp"
#include "rondo/mesh/gmsh_reader.hpp"
#include "rondo/statics/inflation/inflation.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;
using fem::Rubber;
using fem::RubberLaw;
using fem::finite::Cords;
using fem::finite::SectorEnergy;
using fem::finite::SectorLoads;
using fem::finite::SectorState;
using fem::finite::SweptSection;

constexpr double pi = std::numbers::pi;

Rubber neo_hooke(double shear, double bulk) {
  Rubber r;
  r.c10 = 0.5 * shear;
  r.bulk_modulus = bulk;
  return r;
}
double bulk_of(double shear, double poisson) {
  return 2.0 * shear * (1.0 + poisson) / (3.0 * (1.0 - 2.0 * poisson));
}

/// A tube of `layers` elements through its wall and one along the axle.
SweptSection tube(double inner, double outer, double length, int layers, int n_sectors) {
  SweptSection s;
  s.n_sectors = n_sectors;
  for (int i = 0; i <= layers; ++i)
    for (const double z : {0.0, length})
      s.place.push_back({inner + (outer - inner) * i / layers, z});
  for (int i = 0; i < layers; ++i) s.quads.push_back({{2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2}, 0});
  s.densities = {1000.0};
  s.liner = {{0, 1}};
  s.held.assign(3 * s.place.size(), 0);
  return s;
}

/// No node moves along the axle or around it.
void hold_all_but_radius(SweptSection& s) {
  for (std::size_t a = 0; a < s.place.size(); ++a) s.held[3 * a + 1] = s.held[3 * a + 2] = 1;
}

/// Two plies at ± an angle in the inner line of a thin tube of soft rubber, with flat caps.
SweptSection netting(double degrees) {
  SweptSection s = tube(0.1, 0.102, 0.1, 1, 24);
  s.rubbers = {neo_hooke(0.01, 0.05)};
  for (const double sign : {1.0, -1.0}) {
    Cords ply;
    ply.law.stiffness = 1000.0;
    ply.angle = sign * degrees * pi / 180.0;
    ply.spacing = 2e-3;
    ply.lines = {{0, 1}};
    s.cords.push_back(ply);
  }
  s.caps = {{0, -1.0}, {1, 1.0}};
  return s;
}

std::vector<Vec3> at_random(std::size_t n, double most) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> of(-most, most);
  std::vector<Vec3> v(n);
  for (Vec3& x : v) x = {of(generator), of(generator), of(generator)};
  return v;
}

/// Two layers of quadrilaterals, two plies, pressure, spin and caps: all there is at once.
SweptSection everything() {
  SweptSection s = tube(1.0, 1.2, 0.4, 2, 12);
  s.place[2] = {1.12, 0.03};
  s.place[3] = {1.09, 0.38};
  Rubber yeoh = neo_hooke(1.0, 8.0);
  yeoh.law = RubberLaw::yeoh;
  yeoh.c20 = 0.1;
  yeoh.c30 = 0.05;
  s.rubbers = {neo_hooke(1.0, 10.0), yeoh};
  s.densities = {1.0, 1.2};
  s.quads[1].rubber = 1;
  std::swap(s.quads[1].corner[1], s.quads[1].corner[3]);  // in the other sense
  Cords ply;
  ply.law = {2.0, 0.01, 1.0};
  ply.angle = 0.38;
  ply.spacing = 0.05;
  ply.lines = {{2, 3}};
  ply.excess_mass = {0.01};
  s.cords = {ply, ply};
  s.cords[1].law = {3.0, -0.02, 0.5};
  s.cords[1].angle = -0.9;
  s.cords[1].spacing_radius = 1.1;
  s.caps = {{0, -1.0}, {1, 1.0}};
  return s;
}

double potential(const SectorEnergy& wheel, std::span<const Vec3> u, const SectorLoads& loads) {
  const SectorState s = wheel.state(u, loads);
  double spin = 0.0;
  for (std::size_t a = 0; a < u.size(); ++a)
    spin += wheel.mass()[a] * (std::pow(wheel.section().place[a].x + u[a].x, 2) + u[a].y * u[a].y);
  return s.energy - loads.pressure * s.volume - 0.5 * loads.spin_squared * spin;
}

/// The tyre of tests/meshes as a section, its quadrilaterals' rubbers by name.
SweptSection tyre(int n_sectors) {
  const mesh::Mesh m = mesh::read_gmsh({.file = RONDO_TEST_MESHES "/tyre-205-55-r16.msh"}).mesh;
  const std::map<std::string, std::array<double, 2>> rubbers{
      {"liner", {0.9e6, 1150}}, {"carcass", {1.5e6, 1150}}, {"skim", {3e6, 1180}},
      {"base", {1.5e6, 1120}},  {"tread", {1.5e6, 1150}},   {"sidewall", {0.9e6, 1120}},
      {"apex", {8e6, 1180}}};
  SweptSection s;
  s.n_sectors = n_sectors;
  s.place = m.coordinates;
  for (std::size_t e = 0; e < m.cells.size(); ++e) s.quads.push_back({m.cells[e], m.region[e]});
  for (const std::string& name : m.region_names) {
    const auto [shear, density] = rubbers.at(name);
    s.rubbers.push_back(neo_hooke(shear, bulk_of(shear, 0.48)));
    s.densities.push_back(density);
  }
  s.held.assign(3 * s.place.size(), 0);
  const auto curve = [&](const std::string& name) {
    return std::ranges::find(m.curves, name, &mesh::Curve::name)->edges;
  };
  for (const char* name : {"rim-left", "rim-right"})
    for (const auto& edge : curve(name))
      for (const int a : edge)
        for (std::size_t c = 0; c < 3; ++c) s.held[3 * at(a) + c] = 1;
  s.liner = curve("liner");
  const auto add = [&](const char* name, double stiffness, double angle, double spacing,
                       double excess) {
    Cords c;
    c.name = name;
    c.law.stiffness = stiffness;
    c.angle = angle;
    c.spacing = spacing;
    c.lines = curve(name);
    c.excess_mass.assign(c.lines.size(), excess);
    s.cords.push_back(c);
  };
  add("carcass", 1900.0, 0.5 * pi, 1e-3, 8.74e-5);
  add("belt-1", 28300.0, 22.0 * pi / 180.0, 1.2e-3, 8.930824e-4);
  add("belt-2", 28300.0, -22.0 * pi / 180.0, 1.2e-3, 8.930824e-4);
  add("cap", 900.0, 0.0, 1e-3, 0.0);
  double middle = 1.0;  // the carcass where it is nearest to the middle
  for (const auto& line : s.cords[0].lines)
    for (const int a : line)
      if (std::abs(s.place[at(a)].y) < middle) {
        middle = std::abs(s.place[at(a)].y);
        s.cords[0].spacing_radius = s.place[at(a)].x;
      }
  return s;
}

/// Each bead 4 mm towards the middle.
std::vector<Vec3> mounting(const SweptSection& s) {
  std::vector<Vec3> u(s.place.size());
  for (std::size_t a = 0; a < u.size(); ++a)
    if (s.held[3 * a]) u[a].z = s.place[a].y < 0.0 ? 0.004 : -0.004;
  return u;
}

/// K(k) of free rows without spin, dense.
Eigen::MatrixXcd harmonic(const SectorState& state, int k, int n_sectors) {
  const std::complex<double> wave = std::polar(1.0, 2.0 * pi * k / n_sectors);
  const Eigen::MatrixXd next = state.next;
  return Eigen::MatrixXd(state.here).cast<std::complex<double>>() +
         wave * next.cast<std::complex<double>>() +
         std::conj(wave) * next.transpose().cast<std::complex<double>>();
}

}  // namespace

TEST(SectorEnergy, ForcesAndStiffnessAreDerivativesOfThePotential) {
  const SectorEnergy wheel(everything());
  const std::vector<Vec3> u = at_random(wheel.n_nodes(), 0.02);
  const SectorLoads loads{0.3, 0.16};
  const SectorState here = wheel.state(u, loads);
  ASSERT_GT(here.least, 0.5);
  Eigen::MatrixXd k = harmonic(here, 0, 12).real();
  for (std::size_t a = 0; a < u.size(); ++a)
    for (std::size_t c = 0; c < 2; ++c) {
      const auto i = static_cast<Index>(3 * a + c);
      k(i, i) -= loads.spin_squared * wheel.mass()[a];
    }
  std::array<double, 2> force{}, stiffness{};
  for (std::size_t fine = 0; fine < 2; ++fine) {
    const double h = fine == 0 ? 1e-4 : 1e-5;
    for (std::size_t i = 0; i < 3 * u.size(); ++i) {
      std::vector<Vec3> more = u, less = u;
      const auto component = [&](std::vector<Vec3>& v) -> double& {
        return i % 3 == 0 ? v[i / 3].x : i % 3 == 1 ? v[i / 3].y : v[i / 3].z;
      };
      component(more) += h;
      component(less) -= h;
      const auto row = static_cast<Index>(i);
      force[fine] = std::max(
          force[fine],
          std::abs((potential(wheel, more, loads) - potential(wheel, less, loads)) / (2.0 * h) -
                   here.force[row]));
      const Eigen::VectorXd difference =
          wheel.state(more, loads).force - wheel.state(less, loads).force;
      stiffness[fine] =
          std::max(stiffness[fine], (difference / (2.0 * h) - k.col(row)).cwiseAbs().maxCoeff());
    }
  }
  const double most = here.force.cwiseAbs().maxCoeff(), stiffest = k.cwiseAbs().maxCoeff();
  EXPECT_LT(force[1], 1e-6 * most);
  EXPECT_LT(stiffness[1], 1e-6 * stiffest);
  EXPECT_LT(force[1], 0.02 * force[0]);  // second order
  EXPECT_LT(stiffness[1], 0.02 * stiffness[0]);
  EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-15 * stiffest);
}

/// A ring that is nowhere held, in a fluid under pressure, feels no translation.
TEST(SectorEnergy, BlocksKnowTheirNeighbours) {
  SweptSection section = everything();
  section.caps.clear();
  section.liner = {{0, 1}, {1, 3}, {3, 5}, {5, 4}, {4, 2}, {2, 0}};
  const SectorEnergy wheel(section);
  const std::vector<Vec3> u = at_random(wheel.n_nodes(), 0.02);
  const SectorState s = wheel.state(u, {0.3, 0.0});
  const double angle = 2.0 * pi / 12.0;
  const auto moved = [&](int sector) {  // by one along x, in the frame of a sector
    Eigen::VectorXd v = Eigen::VectorXd::Zero(s.force.size());
    for (Index i = 0; i < v.size(); i += 3)
      v.segment<2>(i) << std::cos(sector * angle), -std::sin(sector * angle);
    return v;
  };
  const Eigen::VectorXd f = s.here * moved(0) + s.next * moved(1) + s.next.transpose() * moved(-1);
  EXPECT_LT(f.cwiseAbs().maxCoeff(), 1e-13 * s.here.coeffs().abs().maxCoeff());
}

/// A netting of cords over a prism of 24 sides, its ends held and its radius free: closed form.
TEST(Inflation, ANettingOfTwoPliesWithHeldEnds) {
  struct Row {
    double degrees, length, radius, force;
  };
  for (const auto& [degrees, length, radius, force] :
       {Row{25.0, 1.0, 1.014854938, -1848.10738}, Row{35.26438968, 1.0, 1.022560696, -141.72013},
        Row{45.0, 1.0, 1.040066659, 2851.96229}, Row{60.0, 1.0, 1.156367210, 14481.90352},
        Row{60.0, 1.02, 1.105964853, 15588.90426}}) {
    SCOPED_TRACE(degrees);
    SweptSection section = netting(degrees);
    hold_all_but_radius(section);
    const SectorEnergy wheel(section);
    InflationLoads loads{{1e5, 0.0}, std::vector<Vec3>(4)};
    loads.mounting[1].z = loads.mounting[3].z = 0.1 * (length - 1.0);
    const Inflation out = inflate(wheel, loads);
    ASSERT_TRUE(out.found);
    EXPECT_NEAR(1.0 + out.u[0].x / 0.1, radius, 2e-9);
    // What holds the end: along +z pulls. The rubber's share is far below the last digit.
    const double held = 24.0 * (out.state.force[3 * 1 + 2] + out.state.force[3 * 3 + 2]);
    EXPECT_NEAR(held, force, 1e-3);
  }
}

/// The length at which nothing need hold the ends, of three angles: the cords turn to 54.7356° from
/// the axle.
TEST(Inflation, ANettingTurnsToItsAngle) {
  struct Row {
    double degrees, radius, length;
  };
  for (const auto& [degrees, radius, length] :
       {Row{25.0, 0.916270884, 1.389428940}, Row{35.26438968, 1.015331169, 1.015331169},
        Row{42.0, 1.116271995, 0.876632555}}) {
    SCOPED_TRACE(degrees);
    SweptSection section = netting(degrees);
    hold_all_but_radius(section);
    const SectorEnergy wheel(section);
    Inflation out;
    const auto held = [&](double l) {
      InflationLoads loads{{1e5, 0.0}, std::vector<Vec3>(4)};
      loads.mounting[1].z = loads.mounting[3].z = 0.1 * (l - 1.0);
      out = inflate(wheel, loads);
      EXPECT_TRUE(out.found);
      return out.state.force[3 * 1 + 2] + out.state.force[3 * 3 + 2];
    };
    double before = length - 0.003, now = length + 0.002, by = held(before);
    for (int i = 0; i < 12 && now != before; ++i) {
      const double f = held(now), next = now - f * (now - before) / (f - by);
      before = now;
      by = f;
      now = std::abs(next - now) < 1e-13 ? before : next;
    }
    EXPECT_NEAR(now, length, 2e-9);
    EXPECT_NEAR(1.0 + out.u[0].x / 0.1, radius, 2e-9);
    for (const auto& p : wheel.cords(0, out.u))
      EXPECT_NEAR(p.angle * 180.0 / pi, 90.0 - 54.7356, 5e-5);
  }
}

/// A thick tube of almost incompressible rubber whose inner radius grows by half.
TEST(Inflation, AThickTubeOfNeoHookeanRubber) {
  std::vector<double> radius;
  for (const int layers : {4, 8, 16}) {
    SweptSection section = tube(1.0, 2.0, 0.5, layers, 15 * layers);
    section.rubbers = {neo_hooke(1.0, 1e4)};
    section.caps = {{0, -1.0}, {1, 1.0}};
    hold_all_but_radius(section);
    const Inflation out = inflate(SectorEnergy(section), {{0.4282284091, 0.0}, {}});
    ASSERT_TRUE(out.found);
    radius.push_back(1.0 + out.u[0].x);
  }
  EXPECT_NEAR(radius[0], 1.498621, 1e-6);
  EXPECT_NEAR(radius[1], 1.499689, 1e-6);
  EXPECT_NEAR(radius[2], 1.499952, 1e-6);  // 1.5, and 2e-5 by what is compressed
  EXPECT_NEAR((radius[1] - radius[0]) / (radius[2] - radius[1]), 4.0, 0.1);
}

/// A string around a circle under pressure: frequencies of its waves in closed form.
TEST(Inflation, AStringUnderPressureHasItsFrequencies) {
  struct Row {
    int waves;
    double closed, coarse;
  };
  const double angle = 2.0 * pi / 60.0;
  SweptSection section;
  section.n_sectors = 60;
  section.place = {{0.3, 0.0}, {0.3, 0.01}};
  section.held = {0, 0, 1, 0, 0, 1};
  section.caps = {{0, -1.0}, {1, 1.0}};
  Cords hoop;
  hoop.law.stiffness = 1e4;
  hoop.spacing = 1e-3;
  hoop.lines = {{0, 1}};
  hoop.excess_mass = {3e-3 * (0.5 * angle) / std::sin(0.5 * angle)};  // of the circle
  section.cords = {hoop};
  section.liner = {{1, 0}};
  const SectorEnergy wheel(section);
  const Inflation out = inflate(wheel, {{2e5, 0.0}, {}});
  ASSERT_TRUE(out.found);
  EXPECT_NEAR(0.3 + out.u[0].x, 0.30180837, 1e-8);
  for (const auto& [waves, closed, coarse] :
       {Row{2, 116.1884, 116.0928}, Row{5, 360.3764, 356.7354}}) {
    const Eigen::MatrixXcd k = harmonic(out.state, waves, 60);
    const Eigen::MatrixXcd both =
        (k.block<2, 2>(0, 0) + k.block<2, 2>(0, 3) + k.block<2, 2>(3, 0) + k.block<2, 2>(3, 3)) /
        (2.0 * wheel.mass()[0]);  // the two nodes move alike
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> modes(both, Eigen::EigenvaluesOnly);
    const double frequency = std::sqrt(modes.eigenvalues()[0]) / (2.0 * pi);
    EXPECT_NEAR(frequency, coarse, 2e-4) << waves;
    EXPECT_LT(std::abs(frequency / closed - 1.0), 0.011) << waves;
  }
}

/// Numbers of an independent implementation of the same tyre, to their digits.
TEST(Inflation, ATyreOfRubberAndCords) {
  const SectorEnergy wheel(tyre(120));
  double mass = 0.0;
  for (const double m : wheel.mass()) mass += 120.0 * m;
  EXPECT_NEAR(mass, 8.192, 5e-4);
  const Inflation out = inflate(wheel, {{2.2e5, 0.0}, mounting(wheel.section())});
  ASSERT_TRUE(out.found);
  EXPECT_LE(std::accumulate(out.turns.begin(), out.turns.end(), 0), 25) << "24 there";
  EXPECT_LT(out.residual, 1e-10);
  EXPECT_NEAR(out.state.least, 0.9676, 5e-5);
  EXPECT_NEAR(120.0 * out.state.volume, 0.0392005, 5e-8);
  double radius = 0.0, wide = 0.0, twist = 0.0;
  for (std::size_t a = 0; a < out.u.size(); ++a) {
    const Vec2 place = wheel.section().place[a];
    radius = std::max(radius, std::hypot(place.x + out.u[a].x, out.u[a].y));
    wide = std::max(wide, std::abs(place.y + out.u[a].z));
    twist = std::max(twist, std::abs(out.u[a].y));
  }
  EXPECT_NEAR(radius, 0.315968, 5e-7);
  EXPECT_NEAR(2.0 * wide, 0.20186, 5e-6);
  EXPECT_NEAR(twist, 2.855e-4, 5e-8);
  const auto expect_forces = [&](std::size_t layer, double most, double least) {
    double high = -1e300, low = 1e300;
    for (const auto& p : wheel.cords(layer, out.u)) {
      high = std::max(high, p.state.force);
      low = std::min(low, p.state.force);
    }
    EXPECT_NEAR(high, most, 0.006) << layer;
    EXPECT_NEAR(low, least, 0.06) << layer;
  };
  expect_forces(0, 14.87, -0.83);
  expect_forces(1, 46.52, -20.2);
  expect_forces(2, 46.12, 1.7);
  EXPECT_EQ(unstable_harmonic(wheel, out.state, 0.0), std::nullopt);
}

/// The tread grows with the spin, and the belts mirrored twist the other way.
TEST(Inflation, SpinAndMirroredBelts) {
  SweptSection section = tyre(60);
  const auto crown = [](const SectorEnergy& wheel, const Inflation& out) {
    double radius = 0.0;
    for (std::size_t a = 0; a < out.u.size(); ++a)
      radius = std::max(radius, wheel.section().place[a].x + out.u[a].x);
    return radius;
  };
  const SectorEnergy wheel(section);
  const std::vector<Vec3> mounted = mounting(section);
  for (const auto& [spin, radius] :
       {std::pair{50.0, 0.316037}, std::pair{100.0, 0.316210}, std::pair{150.0, 0.316500}}) {
    const Inflation out = inflate(wheel, {{2.2e5, spin * spin}, mounted});
    ASSERT_TRUE(out.found);
    EXPECT_NEAR(crown(wheel, out), radius, 1.5e-6) << spin;
  }
  const Inflation still = inflate(wheel, {{2.2e5, 0.0}, mounted});
  std::swap(section.cords[1].angle, section.cords[2].angle);
  const Inflation mirrored = inflate(SectorEnergy(section), {{2.2e5, 0.0}, mounted});
  ASSERT_TRUE(still.found && mirrored.found);
  double most = 0.0, apart = 0.0;
  for (std::size_t a = 0; a < still.u.size(); ++a) {
    most = std::max(most, std::abs(still.u[a].y));
    apart = std::max(apart, norm(mirrored.u[a] - Vec3{still.u[a].x, -still.u[a].y, still.u[a].z}));
  }
  EXPECT_GT(most, 2e-4);
  EXPECT_LT(apart, 1e-10);
}

/// A stiff ring on a soft layer that is held within, pressed from outside.
TEST(Inflation, WavesAroundTheWheelAreFound) {
  SweptSection section = tube(0.9, 1.05, 0.1, 3, 96);
  for (std::size_t a = 4; a < 8; ++a) section.place[a].x = a < 6 ? 1.0 : 1.05;
  section.place[2].x = section.place[3].x = 0.95;
  section.rubbers = {neo_hooke(0.01, 0.05), neo_hooke(100.0, 500.0)};
  section.densities = {1.0, 1.0};
  section.quads[2].rubber = 1;
  section.liner = {{6, 7}};
  section.caps = {{6, 1.0}, {7, -1.0}};  // the fluid is outside
  for (std::size_t a = 0; a < 8; ++a) section.held[3 * a + 2] = 1;
  for (std::size_t i = 0; i < 6; ++i) section.held[i] = 1;
  const SectorEnergy wheel(section);
  std::vector<Index> free;
  for (std::size_t i = 0; i < section.held.size(); ++i)
    if (!section.held[i]) free.push_back(static_cast<Index>(i));
  const auto expect_unstable = [&](double pressure, std::optional<int> expected) {
    const Inflation out = inflate(wheel, {{pressure, 0.0}, {}});
    ASSERT_TRUE(out.found);
    EXPECT_EQ(unstable_harmonic(wheel, out.state, 0.0), expected);
    for (int k = 0; k <= expected.value_or(48); ++k) {
      const Eigen::MatrixXcd all = harmonic(out.state, k, 96), of_free = all(free, free);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> modes(of_free, Eigen::EigenvaluesOnly);
      EXPECT_EQ(modes.eigenvalues()[0] < 0.0, k == expected) << k;
    }
  };
  expect_unstable(0.05, std::nullopt);
  expect_unstable(0.1, 4);
}

TEST(Inflation, TooMuchHasNoEquilibrium) {
  SweptSection section = tube(1.0, 1.1, 0.5, 1, 12);
  section.rubbers = {neo_hooke(1.0, 100.0)};
  hold_all_but_radius(section);
  section.caps = {{0, -1.0}, {1, 1.0}};
  const Inflation out = inflate(SectorEnergy(section), {{0.5, 0.0}, {}});
  EXPECT_FALSE(out.found);
  EXPECT_GT(out.share, 0.18);  // of a thin tube the most is μt/R = .095
  EXPECT_LT(out.share, 0.2);
}

TEST(Inflation, WithoutLoadsNothingMoves) {
  const SectorEnergy wheel(tyre(60));
  const Inflation out = inflate(wheel, {{0.0, 0.0}, {}});
  ASSERT_TRUE(out.found);
  for (const Vec3& u : out.u) EXPECT_LT(norm(u), 1e-12);
}

/// A layer that is drawn wider: its cords lean more, to the side that they lean to.
TEST(SectorEnergy, AnglesOfCordsHaveTheirSign) {
  SweptSection section = netting(0.0);
  const SectorEnergy wheel(section);
  for (const double lean : {1.0, -1.0}) {
    std::vector<Vec3> u(4);
    u[1].z = u[3].z = 0.02;  // wider: angles about the axle stay as they are
    EXPECT_NEAR(wheel.cords(0, u)[0].angle, 0.0, 1e-14);
    section.cords[0].angle = lean * 0.3;
    const SectorEnergy leaning(section);
    for (const auto& p : leaning.cords(0, u))
      EXPECT_NEAR(std::tan(p.angle), 1.2 * std::tan(lean * 0.3), 1e-12);
  }
}

}  // namespace rondo::statics
