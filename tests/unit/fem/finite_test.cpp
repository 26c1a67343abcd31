// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "rondo/fem/finite/cord_face.hpp"
#include "rondo/fem/finite/enclosed_volume.hpp"
#include "rondo/fem/finite/rubber_hexahedron.hpp"
#include "rondo/fem/finite/sector_energy.hpp"
#include "rondo/fem/finite/swept_forces.hpp"
#include "rondo/fem/finite/tangent_sector.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/mesh/solid/wheel.hpp"

namespace rondo::fem::finite {
namespace {

std::vector<Vec3> at_random(std::size_t n, double most, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> of(-most, most);
  std::vector<Vec3> v(n);
  for (Vec3& x : v) x = {of(generator), of(generator), of(generator)};
  return v;
}

double& component(Vec3& v, int c) {
  return c == 0 ? v.x : c == 1 ? v.y : v.z;
}

/// Largest errors of the force against differences of the energy, and of the stiffness against
/// differences of the force, over the largest entry of each.
template <std::size_t N, class Evaluate>
std::array<double, 2> errors(const std::array<Vec3, N>& at, double h, Evaluate&& evaluate) {
  const auto here = evaluate(at);
  std::array<double, 2> worst{};
  for (std::size_t a = 0; a < N; ++a)
    for (int c = 0; c < 3; ++c) {
      auto more = at, less = at;
      component(more[a], c) += h;
      component(less[a], c) -= h;
      const auto up = evaluate(more), down = evaluate(less);
      const auto i = static_cast<Eigen::Index>(3 * a) + c;
      worst[0] = std::max(worst[0], std::abs((up.value - down.value) / (2.0 * h) - here.force[i]));
      worst[1] = std::max(
          worst[1],
          ((up.force - down.force) / (2.0 * h) - here.stiffness.col(i)).cwiseAbs().maxCoeff());
    }
  return {worst[0] / here.force.cwiseAbs().maxCoeff(),
          worst[1] / here.stiffness.cwiseAbs().maxCoeff()};
}

/// Second order: a tenth of the difference has a hundredth of the error.
template <std::size_t N, class Evaluate>
void expect_derivatives(const std::array<Vec3, N>& at, double h, Evaluate&& evaluate) {
  const auto coarse = errors(at, h, evaluate), fine = errors(at, 0.1 * h, evaluate);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(fine[i], 1e-5) << i;
    EXPECT_LT(fine[i], 0.02 * coarse[i] + 1e-9) << i;
  }
}

HexahedronCorners block() {
  HexahedronCorners x{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  const auto off = at_random(8, 0.1, 1);
  for (std::size_t i = 0; i < 8; ++i) x[i] += off[i];
  return x;
}

HexahedronCorners moved(unsigned seed) {
  HexahedronCorners u;
  const auto v = at_random(8, 0.08, seed);
  std::copy(v.begin(), v.end(), u.begin());
  return u;
}

std::vector<Rubber> rubbers() {
  Rubber neo, mooney, yeoh, ogden;
  neo.c10 = 0.5;
  mooney.law = RubberLaw::mooney_rivlin;
  mooney.c10 = 0.3;
  mooney.c01 = 0.2;
  yeoh.law = RubberLaw::yeoh;
  yeoh.c10 = 0.5;
  yeoh.c20 = -0.05;
  yeoh.c30 = 0.02;
  ogden.law = RubberLaw::ogden;
  ogden.terms = {{0.6, 1.3}, {0.01, 5.0}, {-0.1, -2.0}};
  std::vector<Rubber> all{neo, mooney, yeoh, ogden};
  for (Rubber& r : all) r.bulk_modulus = 20.0;
  return all;
}

}  // namespace

TEST(FiniteRubber, ForcesAndStiffnessAreDerivativesOfTheEnergy) {
  const HexahedronPoints points = hexahedron_points(block());
  for (const Rubber& rubber : rubbers()) {
    SCOPED_TRACE(static_cast<int>(rubber.law));
    expect_derivatives(moved(2), 1e-4, [&](const HexahedronCorners& u) {
      return rubber_hexahedron(points, u, rubber);
    });
  }
}

/// At no deformation two principal stretches are the same, and all three.
TEST(FiniteRubber, OgdenOfExponentTwoIsNeoHooke) {
  const HexahedronPoints points = hexahedron_points(block());
  Rubber neo = rubbers()[0], ogden = rubbers()[3];
  ogden.terms = {{2.0 * neo.c10, 2.0}};
  HexahedronCorners pulled{};
  for (std::size_t i = 0; i < 8; ++i) pulled[i] = {0.0, 0.0, 0.2 * block()[i].z};
  for (const HexahedronCorners& u : {HexahedronCorners{}, pulled, moved(3)}) {
    const RubberEnergy a = rubber_hexahedron(points, u, neo),
                       b = rubber_hexahedron(points, u, ogden);
    EXPECT_NEAR(a.value, b.value, 1e-12);
    EXPECT_LT((a.force - b.force).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((a.stiffness - b.stiffness).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(FiniteRubber, SmallStrainIsTheHexahedronOfSmallStrain) {
  const HexahedronCorners x = block();
  Rubber rubber = rubbers()[1];
  const double mu = rubber.shear_modulus(), k = rubber.bulk_modulus;
  Material small;
  small.youngs_modulus = 9.0 * k * mu / (3.0 * k + mu);
  small.poissons_ratio = (3.0 * k - 2.0 * mu) / (2.0 * (3.0 * k + mu));
  small.integration = Integration::b_bar;
  const Eigen::Matrix<double, 24, 24> linear = hexahedron_stiffness(x, small);
  const RubberEnergy finite = rubber_hexahedron(hexahedron_points(x), {}, rubber);
  EXPECT_LT((finite.stiffness - linear).cwiseAbs().maxCoeff(),
            1e-12 * linear.cwiseAbs().maxCoeff());
  EXPECT_LT(finite.force.cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_EQ(finite.least, 1.0);
}

TEST(FiniteRubber, ATurnStoresNothing) {
  const HexahedronCorners x = block();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, 2.0, 0.5).normalized()).toRotationMatrix();
  HexahedronCorners u;
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector3d p(x[i].x, x[i].y, x[i].z), q = turn * p - p;
    u[i] = {q.x(), q.y(), q.z()};
  }
  for (const Rubber& rubber : rubbers()) {
    const RubberEnergy e = rubber_hexahedron(hexahedron_points(x), u, rubber);
    EXPECT_NEAR(e.value, 0.0, 1e-14);
    EXPECT_LT(e.force.cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_NEAR(e.least, 1.0, 1e-14);
  }
}

TEST(FiniteRubber, AnInvertedElementHasNoEnergy) {
  HexahedronCorners u{};
  u[6] = {-3.0, -3.0, -3.0};
  const RubberEnergy e = rubber_hexahedron(hexahedron_points(block()), u, rubbers()[0]);
  EXPECT_LE(e.least, 0.0);
  EXPECT_EQ(e.value, 0.0);
  EXPECT_EQ(e.force.norm(), 0.0);
  u[6].x = std::nan("");
  EXPECT_FALSE(rubber_hexahedron(hexahedron_points(block()), u, rubbers()[0]).least > 0.0);
}

namespace {
FaceCorners face() {
  return {{{1.0, 0.0, -0.1}, {1.1, 0.02, 0.2}, {0.9, 0.5, 0.22}, {0.85, 0.45, -0.12}}};
}
}  // namespace

TEST(Cords, ForcesAndStiffnessAreDerivativesOfTheEnergy) {
  const auto points = cord_points(face(), {0.3, 0.4, 0.5, -1.2}, {0.01, 0.02, 0.01, 0.015});
  FaceCorners x = face();
  const auto off = at_random(4, 0.03, 5);
  for (std::size_t i = 0; i < 4; ++i) x[i] += off[i];
  for (const CordLaw& law : {CordLaw{100.0, 0.01, 1.0}, CordLaw{100.0, -0.02, 0.3}})
    expect_derivatives(x, 1e-5, [&](const FaceCorners& at) { return cord_face(points, at, law); });
}

/// A flat face of cords at an angle, pulled: stretches and lengths by hand.
TEST(Cords, OfAFlatFaceByHand) {
  const FaceCorners x{{{0, 0, 0}, {0, 0, 2}, {0, 3, 2}, {0, 3, 0}}};  // along z, around y
  const double angle = 0.4;
  const auto points = cord_points(x, {angle, angle, angle, angle}, {0.1, 0.1, 0.1, 0.1});
  FaceCorners pulled = x;
  for (Vec3& p : pulled) p = {p.x, 1.1 * p.y, 0.9 * p.z};
  double length = 0.0;
  for (const CordPoint& p : points) {
    length += p.length;
    const CordState s = cord_state(p, pulled, {50.0, 0.02, 1.0});
    const double stretch = std::hypot(1.1 * std::cos(angle), 0.9 * std::sin(angle));
    EXPECT_NEAR(s.stretch, stretch, 1e-14);
    EXPECT_NEAR(s.force, 50.0 * (stretch - 0.98), 1e-12);
    EXPECT_NEAR(s.along.z / s.along.y, 0.9 / 1.1 * std::tan(angle), 1e-14);
  }
  EXPECT_NEAR(length, 6.0 / 0.1, 1e-12);
}

TEST(Cords, ALineTheOtherWayWithTheOppositeAngleIsTheSame) {
  const FaceCorners x = face(), back{x[1], x[0], x[3], x[2]};
  const auto one = cord_points(x, {0.3, 0.3, 0.3, 0.3}, {0.01, 0.01, 0.01, 0.01});
  const auto other = cord_points(back, {-0.3, -0.3, -0.3, -0.3}, {0.01, 0.01, 0.01, 0.01});
  FaceCorners y = x;
  y[2] += Vec3{0.01, 0.02, -0.03};
  const double a = cord_face(one, y, {10.0, 0.0, 1.0}).value,
               b = cord_face(other, {y[1], y[0], y[3], y[2]}, {10.0, 0.0, 1.0}).value;
  EXPECT_NEAR(a, b, 1e-15 + 1e-13 * a);
}

TEST(EnclosedVolume, ForcesAndStiffnessAreDerivatives) {
  expect_derivatives(face(), 1e-4, [](const std::array<Vec3, 4>& x) { return cone_volume(x); });
  const std::array<Vec3, 2> edge{{{1.0, 0.1, 0.3}, {0.8, 0.5, 0.35}}};
  expect_derivatives(edge, 1e-4,
                     [](const std::array<Vec3, 2>& x) { return cap_volume(x[0], x[1], 1.0); });
}

/// The faces of a distorted block, looking outwards: its volume, and the same wherever it is.
TEST(EnclosedVolume, OfAClosedSurfaceIsItsVolume) {
  const std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  double expected = 0.0;
  for (const double v : hexahedron_points(block()).volume) expected += v;
  for (const Vec3 shift : {Vec3{}, Vec3{3.0, -2.0, 1.0}}) {
    double volume = 0.0;
    for (const auto& f : faces) {
      std::array<Vec3, 4> x;
      for (std::size_t i = 0; i < 4; ++i) x[i] = block()[f[i]] + shift;
      volume += cone_volume(x).value;
    }
    EXPECT_NEAR(volume, expected, 1e-13);
  }
}

/// A cylinder of N sides with two caps: its volume is that of the prism.
TEST(EnclosedVolume, OfACappedCylinder) {
  const int n = 24;
  const double r = 0.1, length = 0.3, angle = 2.0 * 3.14159265358979323846 / n;
  double volume = 0.0;
  for (int j = 0; j < n; ++j) {
    const auto at = [&](int k, double z) {
      return Vec3{r * std::cos(k * angle), r * std::sin(k * angle), z};
    };
    const Vec3 a = at(j, 0.2), b = at(j + 1, 0.2), c = at(j + 1, 0.2 + length),
               d = at(j, 0.2 + length);
    volume += cone_volume({{a, b, c, d}}).value + cap_volume(d, c, 1.0).value +
              cap_volume(a, b, -1.0).value;
  }
  EXPECT_NEAR(volume, length * 0.5 * n * r * r * std::sin(angle), 1e-15);
}

namespace {

Rubber soft() {
  Rubber r;
  r.c10 = 0.5;
  r.bulk_modulus = 10.0;
  return r;
}

/// A line of cords along a flat disk, from r = 0.2 to 0.3 in `n` edges, held, of no rubber.
SectorEnergy flat_ply(int n, const Cords& ply, int n_sectors) {
  SweptSection s;
  s.n_sectors = n_sectors;
  for (int i = 0; i <= n; ++i) s.place.push_back({0.2 + 0.1 * i / n, 0.0});
  s.held.assign(3 * s.place.size(), 1);
  s.cords = {ply};
  for (int i = 0; i < n; ++i) s.cords[0].lines.push_back({i, i + 1});
  s.cords[0].excess_mass.assign(static_cast<std::size_t>(n), 1.0);
  return SectorEnergy(s);
}

}  // namespace

/// The length of all cords is N asin(c r) / c between the radii, c = cos α_g / (r_g (1 + e)); N is
/// their number around.
/// What the steps take is what the equilibrium takes.
TEST(SweptForces, OfAFaceAreThoseOfItsEnergy) {
  const FaceCorners x = face();
  FaceCorners y = x;
  const auto off = at_random(4, 0.03, 3);
  for (std::size_t i = 0; i < 4; ++i) y[i] += off[i];
  const auto points = cord_points(x, {0.3, 0.4, 0.5, 0.6}, {1e-2, 1e-2, 2e-2, 2e-2});
  const CordLaw law{500.0, 0.02, 0.3};
  const auto expect_same = [](const Energy<4>& a, const FaceForce& b) {
    EXPECT_NEAR(a.value, b.energy, 1e-13 * std::abs(a.value));
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d f = a.force.segment<3>(static_cast<Eigen::Index>(3 * i));
      EXPECT_NEAR(norm(Vec3(f[0], f[1], f[2]) - b.force[i]), 0.0, 1e-13 * a.force.norm()) << i;
    }
  };
  expect_same(cord_face(points, y, law), cord_force(points, y, law));
  expect_same(cone_volume(y), cone_force(y));
}

/// About its state a wheel feels nothing; from there its forces are the gradient of the energy.
TEST(SweptForces, OfAWheelAreTheGradientOfItsEnergy) {
  constexpr int n_sectors = 5;
  std::vector<Vec3> x;
  for (int j = 0; j < n_sectors; ++j)
    for (const Vec2 p : {Vec2{1.0, -0.3}, Vec2{1.2, 0.0}, Vec2{1.1, 0.4}})
      x.push_back(rotation(2.0 * std::numbers::pi * j / n_sectors) * Vec3(p.x, 0.0, p.y));
  SweptFaces faces;
  faces.pressure = 30.0;
  faces.liner = {{0, 1}, {1, 2}};
  SweptCords cords{{100.0, 0.01, 0.5}, faces.liner, {}};
  for (const auto& [a, b] : cords.lines) {
    const auto at = [&](int node) { return x[static_cast<std::size_t>(node)]; };
    cords.points.push_back(cord_points({at(a), at(b), at(b + 3), at(a + 3)}, {0.4, 0.4, 0.4, 0.4},
                                       {0.1, 0.1, 0.1, 0.1}));
  }
  faces.cords.push_back(cords);
  const SweptForces wheel(faces, x, n_sectors);
  const std::vector<Vec3> rest(x.size());
  std::vector<Vec3> force(x.size());
  EXPECT_EQ(wheel.add_to(rest, force), 0.0);
  for (Vec3& f : force) {
    EXPECT_NEAR(norm(f), 0.0, 1e-13);
    f = {};
  }
  const std::vector<Vec3> u = at_random(x.size(), 0.05, 7);
  wheel.add_to(u, force);
  double largest = 0.0;
  for (const Vec3& f : force) largest = std::max(largest, norm(f));
  EXPECT_GT(largest, 1.0);
  constexpr double h = 1e-5;
  for (std::size_t k = 0; k < x.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      auto more = u, less = u, unused = rest;
      component(more[k], c) += h;
      component(less[k], c) -= h;
      const double slope = (wheel.add_to(more, unused) - wheel.add_to(less, unused)) / (2.0 * h);
      EXPECT_NEAR(slope, component(force[k], c), 1e-7 * largest) << k << " " << c;
    }
  // The cords keep their sign of strain over h, so that the tangent is the change of the forces.
  std::vector<Vec3> change(x.size()), after(x.size()), before(x.size());
  const std::vector<Vec3> way = at_random(x.size(), 1.0, 8);
  wheel.tangent(u, [&](std::size_t f, std::size_t move, const Eigen::Matrix3d& block) {
    const Eigen::Vector3d more = block * Eigen::Vector3d(way[move].x, way[move].y, way[move].z);
    change[f] += Vec3(more[0], more[1], more[2]);
  });
  std::vector<Vec3> more = u, less = u;
  for (std::size_t k = 0; k < u.size(); ++k) more[k] += h * way[k], less[k] -= h * way[k];
  wheel.add_to(more, after);
  wheel.add_to(less, before);
  for (std::size_t k = 0; k < u.size(); ++k)
    EXPECT_LT(norm(0.5 / h * (after[k] - before[k]) - change[k]), 1e-5 * norm(change[k])) << k;
}

/// A turn of the whole wheel stores nothing in cords, and turns all forces with it.
TEST(SweptForces, ATurnOfTheWheelStoresNothing) {
  std::vector<Vec3> x;
  for (int j = 0; j < 4; ++j)
    for (const double z : {-0.2, 0.3})
      x.push_back(rotation(0.5 * std::numbers::pi * j) * Vec3(1.0, 0.0, z));
  SweptFaces faces;
  SweptCords cords{{100.0, 0.0, 1.0}, {{0, 1}}, {}};
  cords.points.push_back(
      cord_points({x[0], x[1], x[3], x[2]}, {0.4, 0.4, 0.4, 0.4}, {0.1, 0.1, 0.1, 0.1}));
  faces.cords.push_back(cords);
  const SweptForces wheel(faces, x, 4);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, 2.0, 0.5).normalized()).toRotationMatrix();
  std::vector<Vec3> u, force(x.size());
  for (const Vec3& p : x) {
    const Eigen::Vector3d q = turn * Eigen::Vector3d(p.x, p.y, p.z);
    u.push_back(Vec3(q[0], q[1], q[2]) - p);
  }
  EXPECT_NEAR(wheel.add_to(u, force), 0.0, 1e-12);
  for (const Vec3& f : force) EXPECT_NEAR(norm(f), 0.0, 1e-12);
}

TEST(Cords, LiftedFromADrumKeepTheirNumber) {
  Cords ply;
  ply.law.stiffness = 1.0;
  ply.angle = 0.9;
  ply.spacing = 1e-3;
  ply.lift = {0.24, 0.05};
  const double c = std::cos(0.9) / (0.24 * 1.05);
  const double number = 2.0 * 3.14159265358979 * 0.24 * std::sin(0.9) / 1e-3;
  const double length = number * (std::asin(c * 0.3) - std::asin(c * 0.2)) / c;
  double before = 0.0;
  for (const int fine : {1, 2}) {
    const SectorEnergy wheel = flat_ply(10 * fine, ply, 90 * fine);
    double mass = 0.0;
    for (const double m : wheel.mass()) mass += 90.0 * fine * m;
    const double error = std::abs(mass / length - 1.0);
    EXPECT_LT(error, 1e-3);
    if (fine == 2) {
      EXPECT_NEAR(before / error, 4.0, 0.4);
    }
    before = error;
    for (const auto& p : wheel.cords(0, std::vector<Vec3>(wheel.n_nodes())))
      EXPECT_NEAR(std::cos(p.angle), c * norm(p.place.plane()), 1e-12);
  }
}

/// A channel between two radii over a length, closed by the ring at its inner ends.
TEST(EnclosedVolume, CavityOfAChannel) {
  SweptSection s;
  s.n_sectors = 30;
  s.place = {{0.2, 0.0}, {0.3, 0.0}, {0.3, 0.1}, {0.2, 0.1}};
  s.held.assign(12, 1);
  s.liner = {{0, 1}, {1, 2}, {2, 3}};
  std::vector<Vec3> u(4);
  for (Vec3& v : u) v.z = 0.7;  // wherever it is along the axle
  const double polygon = 15.0 * std::sin(2.0 * 3.14159265358979 / 30.0);
  const std::optional<double> found = SectorEnergy(s).cavity(u);
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::abs(*found), polygon * (0.3 * 0.3 - 0.2 * 0.2) * 0.1, 1e-14);
  s.liner = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  EXPECT_FALSE(SectorEnergy(s).cavity(u));
}

TEST(FiniteRubber, LargestStretch) {
  SweptSection s;
  s.n_sectors = 12;
  s.place = {{0.2, 0.0}, {0.3, 0.0}, {0.3, 0.1}, {0.2, 0.1}};
  s.quads = {{{0, 1, 2, 3}, 0}};
  s.rubbers = {soft()};
  s.densities = {1.0};
  s.held.assign(12, 1);
  std::vector<Vec3> u(4);
  u[2].z = u[3].z = 0.1 * 0.25;  // along the axle by a quarter
  EXPECT_NEAR(SectorEnergy(s).largest_stretch(u), 1.25, 1e-12);
}

/// K u of the revolved wheel is what the section's blocks say, sector by sector; and symmetric to
/// the last bit.
TEST(TangentSector, IsTheTangentOfTheWheel) {
  mesh::Mesh plane;
  plane.coordinates = {{0.2, 0.0}, {0.2, 0.1}, {0.25, 0.01}, {0.26, 0.1}, {0.3, 0.0}, {0.31, 0.11}};
  plane.cells = {{0, 2, 3, 1}, {2, 4, 5, 3}};
  plane.clamped = {0, 1};
  plane.curves = {{"tread", {{4, 5}}}};
  const mesh::Mesh wheel = mesh::revolve(plane, {12, 1, {}}, "tread");
  SweptSection s;
  s.n_sectors = 12;
  s.place = plane.coordinates;
  s.quads = {{plane.cells[0], 0}, {plane.cells[1], 0}};
  s.rubbers = {soft()};
  s.densities = {1.0};
  s.held.assign(18, 0);
  for (std::size_t i = 0; i < 6; ++i) s.held[i] = 1;
  Cords ply;
  ply.law.stiffness = 2.0;
  ply.angle = 0.4;
  ply.spacing = 0.01;
  ply.lines = {{2, 3}};
  s.cords = {ply};
  const SectorEnergy energy(s);
  const SectorState state = energy.state(at_random(6, 0.01, 3), {0.0, 0.0});
  const SolidSector k = tangent_sector(wheel, state);
  std::vector<Vec3> u = at_random(wheel.n_nodes(), 1.0, 5), out(u.size());
  for (const int node : wheel.clamped) u[static_cast<std::size_t>(node)] = {};
  apply(k, u, out);
  const auto local = [&](const std::vector<Vec3>& v, int sector) {
    Eigen::VectorXd w(18);
    for (int a = 0; a < 6; ++a) {
      const double angle =
          2.0 * 3.14159265358979323846 * ((sector + 12) % 12) / 12.0 - 0.5 * 3.14159265358979323846;
      const Vec3 turned =
          rotation(-angle) * v[static_cast<std::size_t>((sector + 12) % 12 * 6 + a)];
      w.segment<3>(3 * a) << turned.x, turned.y, turned.z;
    }
    return w;
  };
  for (const int sector : {0, 5, 11}) {
    const Eigen::VectorXd expected = state.here * local(u, sector) +
                                     state.next * local(u, sector + 1) +
                                     state.next.transpose() * local(u, sector - 1);
    const Eigen::VectorXd found = local(out, sector);
    for (Eigen::Index i = 6; i < 18; ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-12 * expected.cwiseAbs().maxCoeff()) << i;
  }
  for (std::size_t a = 0; a < k.n_local(); ++a)
    for (const SolidSector::Entry& e : k.row(a)) {
      const auto back = k.row(static_cast<std::size_t>(e.column));
      const auto same = std::ranges::find_if(back, [&](const SolidSector::Entry& other) {
        return other.column == static_cast<int>(a) && other.shift == -e.shift;
      });
      ASSERT_NE(same, back.end());
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(e.block[3 * c + r], same->block[3 * r + c]);
    }
}

}  // namespace rondo::fem::finite
