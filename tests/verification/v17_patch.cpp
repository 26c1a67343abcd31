// SPDX-License-Identifier: BSD-3-Clause
/// V17: patch tests (constant strain on a distorted mesh of triangles and quadrilaterals), masses,
/// free fall.
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <Eigen/SparseLU>
#include <random>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/stress.hpp"
#include "support/models.hpp"
#include "support/stepping.hpp"

namespace v17_patch {

using namespace rondo;

namespace {

enum class Cells { quadrilaterals, triangles, mixed };

/// n × n unit square, inner nodes moved at random by up to 0.3 of an edge.
mesh::Mesh distorted_square(Cells kind, int n) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> move(-0.3 / n, 0.3 / n);
  mesh::Mesh m;
  const auto node = [&](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const Vec2 shift = inner ? Vec2{move(random), move(random)} : Vec2{};
      m.coordinates.push_back(Vec2{static_cast<double>(i) / n, static_cast<double>(j) / n} + shift);
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if (kind == Cells::quadrilaterals || (kind == Cells::mixed && (i + j) % 2 == 0)) {
        m.cells.push_back({a, b, c, d});
      } else {
        m.cells.push_back({a, b, c, -1});
        m.cells.push_back({a, c, d, -1});
      }
    }
  return m;
}

Vec2 linear(Vec2 p) {
  return {1e-3 * p.x - 2e-3 * p.y + 5e-4, 3e-3 * p.x + 7e-4 * p.y};
}

bool on_edge(Vec2 p) {
  return p.x == 0.0 || p.x == 1.0 || p.y == 0.0 || p.y == 1.0;
}

using Law = std::tuple<fem::Plane, fem::Integration, double>;  ///< ν last
class Patch : public testing::TestWithParam<std::tuple<Cells, Law>> {};

}  // namespace

/// Edge nodes given the linear field, inner nodes solved for: they take the same field, and the
/// stress is the constant one everywhere.
TEST_P(Patch, ConstantStrain) {
  const auto [kind, law] = GetParam();
  const auto [plane, integration, nu] = law;
  const mesh::Mesh m = distorted_square(kind, 5);
  const fem::Material material{2e7, nu, 1100.0, plane, integration};
  const fem::BlockCsr k = fem::assemble_stiffness(m, {&material, 1});
  const std::vector<int> all = fem::free_nodes(m);  // nothing is clamped: all of them
  const Eigen::SparseMatrix<double> a = fem::free_matrix(k, all);
  std::vector<Eigen::Index> inner;
  Eigen::VectorXd u(a.rows());
  for (std::size_t i = 0; i < m.n_nodes(); ++i) {
    const Vec2 value = linear(m.coordinates[i]);
    const bool edge = on_edge(m.coordinates[i]);
    u.segment<2>(static_cast<Eigen::Index>(2 * i)) =
        edge ? Eigen::Vector2d(value.x, value.y) : Eigen::Vector2d::Zero();
    for (int c = 0; c < 2 && !edge; ++c) inner.push_back(static_cast<Eigen::Index>(2 * i) + c);
  }
  const Eigen::MatrixXd dense = a;
  const Eigen::VectorXd load = -(dense * u);
  const Eigen::VectorXd x = dense(inner, inner).ldlt().solve(load(inner));
  for (std::size_t i = 0; i < inner.size(); ++i) u[inner[i]] = x[static_cast<Eigen::Index>(i)];

  std::vector<Vec2> field(m.n_nodes());
  for (std::size_t i = 0; i < m.n_nodes(); ++i) {
    const auto place = static_cast<Eigen::Index>(2 * i);
    field[i] = {u[place], u[place + 1]};
    // Condition of the inner matrix about 1e2: 1e-14 of 3e-3.
    ASSERT_LT(norm(field[i] - linear(m.coordinates[i])), 1e-16);
  }
  const fem::Hooke d = fem::hooke(material);
  fem::StressRecovery recovery(m, {&material, 1});
  for (const fem::Stress& s : recovery(field)) {
    ASSERT_NEAR(s[0], d.d11 * 1e-3 + d.d12 * 7e-4, 1e-12 * d.d11);
    ASSERT_NEAR(s[1], d.d12 * 1e-3 + d.d11 * 7e-4, 1e-12 * d.d11);
    ASSERT_NEAR(s[2], d.zz * (s[0] + s[1]), 1e-12 * d.d11);
    ASSERT_NEAR(s[3], d.d33 * 1e-3, 1e-12 * d.d11);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Patch,
    testing::Combine(testing::Values(Cells::quadrilaterals, Cells::triangles, Cells::mixed),
                     testing::Values(Law{fem::Plane::strain, fem::Integration::full, 0.3},
                                     Law{fem::Plane::stress, fem::Integration::full, 0.3},
                                     Law{fem::Plane::strain, fem::Integration::b_bar, 0.3},
                                     Law{fem::Plane::strain, fem::Integration::b_bar, 0.49},
                                     Law{fem::Plane::stress, fem::Integration::b_bar, 0.3})));

TEST(Mass, SumsToDensityTimesArea) {
  const fem::Material rubber{2e7, 0.3, 1100.0, fem::Plane::strain};
  for (const Cells kind : {Cells::quadrilaterals, Cells::triangles, Cells::mixed}) {
    double sum = 0.0;
    for (const double mass : fem::lumped_mass(distorted_square(kind, 5), {&rubber, 1})) sum += mass;
    EXPECT_NEAR(sum, 1100.0, 1e-11);
  }
}

/// Nothing clamped, gravity: every node falls at g, u = -g t²/2 at the steps, no strain. The mesh
/// has no sectors: sparse operator.
TEST(FreeFall, EveryNodeFallsAtG) {
  const mesh::Mesh m = distorted_square(Cells::mixed, 4);
  const fem::Material material{2e5, 0.3, 1100.0, fem::Plane::strain};
  dynamics::Model model;
  model.reference = m.coordinates;
  model.mass = fem::lumped_mass(m, {&material, 1});
  model.free = fem::free_nodes(m);
  model.stiffness = fem::assemble_stiffness(m, {&material, 1});
  model.motion.gravity = dynamics::Table(9.81);
  model.dt = 1e-4;
  test::Stepping run(model, test::start_at_rest(model));
  run.advance(1000);
  for (const Vec2 u : run.state().u.plane()) {
    ASSERT_NEAR(u.y, -0.5 * 9.81 * 0.1 * 0.1, 1e-13);  // round-off of K u feeds 1,000 steps
    ASSERT_NEAR(u.x, 0.0, 1e-13);
  }
  EXPECT_LT(run.balance().relative, 1e-13);
}

}  // namespace v17_patch
