// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "rondo/fem/finite/cord_face.hpp"
#include "rondo/fem/finite/enclosed_volume.hpp"
#include "rondo/fem/finite/rubber_hexahedron.hpp"

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

}  // namespace rondo::fem::finite
