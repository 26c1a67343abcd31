// SPDX-License-Identifier: BSD-3-Clause
/// Rubber of a wheel beyond its tangent about a state, and the window of its columns.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "rondo/fem/finite/rubber_remainder.hpp"
#include "rondo/fem/finite/sector_energy.hpp"

namespace rondo::fem::finite::rubber_window_test {
namespace {

constexpr int n_sectors = 7;
constexpr std::size_t n_nodes = 6;

std::vector<Vec3> at_random(std::size_t n, double most, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> of(-most, most);
  std::vector<Vec3> v(n);
  for (Vec3& x : v) x = {of(generator), of(generator), of(generator)};
  return v;
}

/// Two elements of different rubber side by side.
SweptSection section() {
  SweptSection s;
  s.n_sectors = n_sectors;
  s.place = {{1.0, -0.3}, {1.0, 0.0}, {1.1, 0.4}, {1.4, -0.3}, {1.3, 0.1}, {1.4, 0.3}};
  s.quads = {{{0, 1, 4, 3}, 0}, {{1, 2, 5, 4}, 1}};
  Rubber soft, stiff;
  soft.c10 = 0.5;
  stiff.law = RubberLaw::mooney_rivlin;
  stiff.c10 = 2.0, stiff.c01 = 0.5;
  soft.bulk_modulus = stiff.bulk_modulus = 20.0;
  s.rubbers = {soft, stiff};
  s.densities = {1.0, 1.0};
  s.held.assign(3 * n_nodes, 0);
  return s;
}

std::vector<Complex> turns() {
  std::vector<Complex> turn;
  for (int j = 0; j < n_sectors; ++j)
    turn.push_back(rotation(2.0 * std::numbers::pi * j / n_sectors));
  return turn;
}

RubberRemainder wheel_about(const std::vector<Vec3>& state) {
  return {SectorEnergy(section()).rubber(state), turns()};
}

/// Places of all nodes in the undeformed wheel: outwards is -y in sector 0, around is x.
std::vector<Vec3> undeformed() {
  std::vector<Vec3> x;
  for (const Complex turn : turns())
    for (const Vec2 p : section().place)
      x.push_back(turn * Complex{0.0, -1.0} * Vec3(p.x, 0.0, p.y));
  return x;
}

struct Found {
  double energy = 0.0;
  std::vector<Vec3> force;
};

Found find(const RubberRemainder& wheel, const std::vector<Vec3>& u,
           const std::vector<double>& weight) {
  Found found;
  found.force.resize(u.size());
  std::vector<double> energy(weight.size(), 9.0);
  wheel.add_to(u, weight, found.force, energy);
  for (std::size_t j = 0; j < weight.size(); ++j) {
    found.energy += weight[j] * energy[j];
    if (weight[j] == 0.0) {
      EXPECT_EQ(energy[j], 0.0) << j;
    }
  }
  return found;
}

double& component(Vec3& v, int c) {
  return c == 0 ? v.x : c == 1 ? v.y : v.z;
}

double largest(const std::vector<Vec3>& v) {
  double most = 0.0;
  for (const Vec3& x : v) most = std::max(most, norm(x));
  return most;
}

const std::vector<double> all(n_sectors, 1.0), some{1.0, 0.4, 0.0, 0.0, 0.0, 0.7, 1.0};

}  // namespace

TEST(RubberRemainder, ForcesAreTheGradientOfItsEnergy) {
  const RubberRemainder wheel = wheel_about(at_random(n_nodes, 0.03, 3));
  const std::vector<Vec3> u = at_random(n_nodes * n_sectors, 0.03, 4);
  const Found here = find(wheel, u, some);
  const double scale = largest(here.force);
  EXPECT_GT(scale, 1e-3);
  constexpr double h = 1e-5;
  for (std::size_t k = 0; k < u.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      auto more = u, less = u, force = here.force;
      component(more[k], c) += h;
      component(less[k], c) -= h;
      const double slope =
          (find(wheel, more, some).energy - find(wheel, less, some).energy) / (2.0 * h);
      EXPECT_NEAR(slope, component(force[k], c), 1e-6 * scale) << k << " " << c;
    }
}

TEST(RubberRemainder, ItsTangentIsTheChangeOfItsForces) {
  const RubberRemainder wheel = wheel_about(at_random(n_nodes, 0.03, 13));
  const std::vector<Vec3> u = at_random(n_nodes * n_sectors, 0.03, 14),
                          way = at_random(n_nodes * n_sectors, 1.0, 15);
  std::vector<Vec3> change(u.size());
  wheel.tangent(u, some, [&](std::size_t force, std::size_t move, const Eigen::Matrix3d& block) {
    const Eigen::Vector3d f = block * Eigen::Vector3d(way[move].x, way[move].y, way[move].z);
    change[force] += Vec3(f[0], f[1], f[2]);
  });
  constexpr double h = 1e-5;
  auto more = u, less = u;
  for (std::size_t k = 0; k < u.size(); ++k) more[k] += h * way[k], less[k] -= h * way[k];
  const Found after = find(wheel, more, some), before = find(wheel, less, some);
  const double scale = largest(change);
  EXPECT_GT(scale, 0.1);
  for (std::size_t k = 0; k < u.size(); ++k)
    EXPECT_LT(norm(0.5 / h * (after.force[k] - before.force[k]) - change[k]), 1e-6 * scale) << k;
}

/// The tangent is that of the state: what is left is of second order, its energy of third.
TEST(RubberRemainder, IsOfSecondOrder) {
  const RubberRemainder wheel = wheel_about(at_random(n_nodes, 0.03, 5));
  const auto way = [](double size) { return at_random(n_nodes * n_sectors, size, 6); };
  const Found one = find(wheel, way(1e-3), all), half = find(wheel, way(5e-4), all);
  EXPECT_NEAR(largest(one.force) / largest(half.force), 4.0, 0.05);
  EXPECT_NEAR(one.energy / half.energy, 8.0, 0.3);
  const Found none = find(wheel, way(0.0), all);
  EXPECT_EQ(none.energy, 0.0);
  EXPECT_EQ(largest(none.force), 0.0);
}

/// Turned by Q as a whole the undeformed wheel feels nothing: what is left is -K (Q - 1) x, which
/// for an axis grows with 1 - cos of the angle.
TEST(RubberRemainder, ATurnOfTheWheelStoresNothing) {
  const RubberRemainder wheel = wheel_about(std::vector<Vec3>(n_nodes));
  const auto turned = [&](double angle) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, 2.0, 0.5).normalized()).toRotationMatrix();
    std::vector<Vec3> u;
    for (const Vec3& p : undeformed()) {
      const Eigen::Vector3d q = turn * Eigen::Vector3d(p.x, p.y, p.z);
      u.push_back(Vec3(q[0], q[1], q[2]) - p);
    }
    return u;
  };
  const std::vector<Vec3> u = turned(1.1), other = turned(0.4);
  const Found found = find(wheel, u, all), less = find(wheel, other, all);
  double work = 0.0;
  for (std::size_t k = 0; k < u.size(); ++k) work += 0.5 * dot(u[k], found.force[k]);
  EXPECT_LT(work, -1.0);
  EXPECT_NEAR(found.energy / work, 1.0, 1e-11);
  const double ratio = (1.0 - std::cos(1.1)) / (1.0 - std::cos(0.4));
  for (std::size_t k = 0; k < u.size(); ++k)
    EXPECT_NEAR(norm(found.force[k] - ratio * less.force[k]), 0.0, 1e-11 * largest(found.force));
}

TEST(ColumnWindow, IsOneNearTheGroundAndFadesToZero) {
  constexpr std::size_t n = 120;
  constexpr double column = 2.0 * std::numbers::pi / n;
  const ColumnWindow window{0.5};
  std::vector<double> weight(n);
  window.find(0.0, weight);
  for (std::size_t j = 0; j < n; ++j) {
    const double middle = (static_cast<double>(j) + 0.5) * column,
                 away = std::min(middle, 2.0 * std::numbers::pi - middle);
    EXPECT_NEAR(weight[j], weight[n - 1 - j], 1e-12) << j;
    if (away < 0.5) {
      EXPECT_EQ(weight[j], 1.0) << j;
    } else if (away > 0.5 + ColumnWindow::fade) {
      EXPECT_EQ(weight[j], 0.0) << j;
    } else {
      EXPECT_NEAR(weight[j], std::pow(std::cos(5.0 * std::numbers::pi * (away - 0.5)), 2), 1e-12);
    }
  }
}

/// The wheel turns by a column counter-clockwise: each column gets the weight of the next one.
TEST(ColumnWindow, StandsStillAsTheWheelTurns) {
  constexpr std::size_t n = 120;
  const ColumnWindow window{0.3};
  std::vector<double> before(n), after(n);
  for (const double angle : {0.01, -1000.3}) {
    window.find(angle, before);
    window.find(angle + 2.0 * std::numbers::pi / n, after);
    for (std::size_t j = 0; j < n; ++j) EXPECT_NEAR(after[j], before[(j + 1) % n], 1e-9) << j;
  }
  EXPECT_FALSE(window.is_whole());
  const ColumnWindow whole{2.0 * std::numbers::pi};
  EXPECT_TRUE(whole.is_whole());
  whole.find(3.0, after);
  for (const double w : after) EXPECT_EQ(w, 1.0);
}

}  // namespace rondo::fem::finite::rubber_window_test
