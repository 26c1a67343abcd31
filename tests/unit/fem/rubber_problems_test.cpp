// SPDX-License-Identifier: BSD-3-Clause
/// Rubber by Newton's method on problems with known answers: a ring under pressure, which has a
/// closed form; Cook's membrane (de Souza Neto et al., Int. J. Solids Struct. 33 (1996) 3277).
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <functional>

#include "rondo/core/complex.hpp"
#include "unit/fem/rubber_fixture.hpp"

namespace rubber_problems_test {

using namespace rondo;
using namespace rondo::fem;

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Force on the body and its derivative, at displacements (2n).
struct Load {
  Eigen::VectorXd force;
  Matrix slope;
};
using LoadOf = std::function<Load(const Eigen::VectorXd& u, double share)>;

struct Problem {
  mesh::Mesh mesh;
  Matrix moves;  ///< (2n, unknowns) the ways in which the nodes may move
  LoadOf load;
};

std::vector<Vec2> as_field(const Eigen::VectorXd& v) {
  std::vector<Vec2> u;
  for (Eigen::Index i = 0; i < v.size(); i += 2) u.push_back({v[i], v[i + 1]});
  return u;
}

/// Displacements under the whole load, in equal steps of it.
std::vector<Vec2> solve(const Problem& p, const Rubber& rubber, int steps) {
  Hyperelasticity body(p.mesh, std::vector{material_with(rubber)});
  Eigen::VectorXd q = Eigen::VectorXd::Zero(p.moves.cols());
  for (int step = 1; step <= steps; ++step)
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Eigen::VectorXd u = p.moves * q;
      const Load load = p.load(u, static_cast<double>(step) / steps);
      const Eigen::VectorXd rest =
          p.moves.transpose() * (load.force - as_vector(gradient_of(body, as_field(u))));
      if (rest.norm() <= 1e-8 * load.force.norm()) break;
      EXPECT_LT(iteration, 29);
      const Matrix k = free_matrix(body.tangent(as_field(u)), free_nodes(p.mesh)) - load.slope;
      const Matrix reduced = p.moves.transpose() * k * p.moves;
      q += Eigen::SimplicialLDLT<Matrix>(reduced).solve(rest);
    }
  return as_field(p.moves * q);
}

/// n × n cells between the corners of a patch: place(s, t) with s, t in [0, 1].
template <class Place>
mesh::Mesh grid(int n, Cells cells, Place&& place) {
  mesh::Mesh m = patch_mesh(n, cells);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      m.coordinates[static_cast<std::size_t>(j * (n + 1) + i)] =
          place(static_cast<double>(i) / n, static_cast<double>(j) / n);
  return m;
}

Matrix ways(std::size_t n_nodes, const std::vector<std::pair<int, Vec2>>& of_nodes) {
  std::vector<Eigen::Triplet<double>> entries;
  int column = 0;
  for (const auto& [node, way] : of_nodes) {
    entries.emplace_back(2 * node, column, way.x);
    entries.emplace_back(2 * node + 1, column++, way.y);
  }
  Matrix m(static_cast<Eigen::Index>(2 * n_nodes), column);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

constexpr double sector = 0.39269908169872414;  // 22.5°

/// Inner radius 1, outer 2; pressure on the chords as they lie.
Problem ring(int n, Cells cells, double pressure) {
  Problem p;
  p.mesh = grid(n, cells,
                [](double s, double t) { return (1.0 + t) * direction_at(sector * (1.0 - s)); });
  std::vector<std::pair<int, Vec2>> free;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const int node = j * (n + 1) + i;
      if (i == 0 || i == n)
        free.push_back({node, direction_at(i == n ? 0.0 : sector)});
      else
        free.insert(free.end(), {{node, {1.0, 0.0}}, {node, {0.0, 1.0}}});
    }
  p.moves = ways(p.mesh.n_nodes(), free);
  p.load = [n, pressure, x = as_vector(p.mesh.coordinates)](const Eigen::VectorXd& u,
                                                            double share) {
    std::vector<Eigen::Triplet<double>> entries;
    const double half = -0.5 * share * pressure;
    for (int a = 0; a < n; ++a)
      for (const int to : {a, a + 1}) {  // half of p turn90(x_{a+1} - x_a), towards the outside
        entries.emplace_back(2 * to, 2 * a + 3, half);
        entries.emplace_back(2 * to, 2 * a + 1, -half);
        entries.emplace_back(2 * to + 1, 2 * a + 2, -half);
        entries.emplace_back(2 * to + 1, 2 * a, half);
      }
    Matrix slope(u.size(), u.size());
    slope.setFromTriplets(entries.begin(), entries.end());
    return Load{slope * (x + u), slope};
  };
  return p;
}

/// p of b, with b² - a² = B² - A², of an incompressible neo-Hookean ring.
double ring_pressure(double a) {
  const double b = std::sqrt(3.0 + a * a);
  return std::log(2.0) - std::log(b / a) + 0.5 * (a * a - 1.0) * (1.0 / (a * a) - 1.0 / (b * b));
}

/// Mean inner radius.
double inflated(int n, Cells cells, bool one_point) {
  Rubber r = rubber_of(RubberLaw::neo_hooke);
  r.bulk_modulus = 1e4;
  r.one_point = one_point;
  const Problem p = ring(n, cells, ring_pressure(1.5));
  const std::vector<Vec2> u = solve(p, r, 4);
  double sum = 0.0;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(n); ++i)
    sum += norm(p.mesh.coordinates[i] + u[i]);
  return sum / (n + 1);
}

/// Turning, with ρ s² A² = `pull` of the shear modulus.
Problem spinning(int n, double pull) {
  Problem p = ring(n, Cells::quadrilaterals, 0.0);
  const std::vector<double> area = nodal_areas(p.mesh);
  p.load = [pull, area, x = as_vector(p.mesh.coordinates)](const Eigen::VectorXd& u, double share) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < u.size(); ++i)
      entries.emplace_back(i, i, share * pull * area[static_cast<std::size_t>(i / 2)]);
    Matrix slope(u.size(), u.size());
    slope.setFromTriplets(entries.begin(), entries.end());
    return Load{slope * (x + u), slope};
  };
  return p;
}

double spun(int n, double pull) {
  Rubber r = rubber_of(RubberLaw::neo_hooke);
  r.bulk_modulus = 1e5;
  return 1.0 + solve(spinning(n, pull), r, 4)[static_cast<std::size_t>(n)].x;
}

Problem membrane(int n, Cells cells) {
  Problem p;
  p.mesh = grid(n, cells, [](double s, double t) {
    return Vec2{48.0 * s, (1.0 - t) * 44.0 * s + t * (44.0 + 16.0 * s)};
  });
  std::vector<std::pair<int, Vec2>> free;
  for (int node = 0; node < (n + 1) * (n + 1); ++node)
    if (node % (n + 1) != 0) free.insert(free.end(), {{node, {1.0, 0.0}}, {node, {0.0, 1.0}}});
  p.moves = ways(p.mesh.n_nodes(), free);
  p.load = [n](const Eigen::VectorXd& u, double share) {
    Load load{Eigen::VectorXd::Zero(u.size()), Matrix(u.size(), u.size())};
    for (int j = 0; j <= n; ++j)
      load.force[2 * (j * (n + 1) + n) + 1] = share * 100.0 / n * (j == 0 || j == n ? 0.5 : 1.0);
    return load;
  };
  return p;
}

double lifted(int n, Cells cells, bool one_point) {
  Rubber r = rubber_of(RubberLaw::neo_hooke);
  r.c10 = 0.5 * 80.1938;
  r.bulk_modulus = 40.0942e4;
  r.one_point = one_point;
  return solve(membrane(n, cells), r, 10).back().y;
}

}  // namespace

TEST(RubberProblems, PressureOfTheClosedForm) {
  EXPECT_NEAR(ring_pressure(1.05), 0.070132, 6e-7);
  EXPECT_NEAR(ring_pressure(1.2), 0.233370, 6e-7);
  EXPECT_NEAR(ring_pressure(1.5), 0.428228, 6e-7);
  EXPECT_NEAR(ring_pressure(2.0), 0.574054, 6e-7);
}

/// To 1.5, with an error of second order.
TEST(RubberProblems, AnInflatedRing) {
  EXPECT_NEAR(inflated(4, Cells::quadrilaterals, false), 1.49872, 6e-6);
  EXPECT_NEAR(inflated(8, Cells::quadrilaterals, false), 1.49971, 6e-6);
  EXPECT_NEAR(inflated(16, Cells::quadrilaterals, false), 1.49996, 6e-6);
}

TEST(RubberProblems, AnInflatedRingWithOnePoint) {
  EXPECT_NEAR(inflated(4, Cells::quadrilaterals, true), 1.47737, 6e-6);
  EXPECT_NEAR(inflated(8, Cells::quadrilaterals, true), 1.49384, 6e-6);
}

TEST(RubberProblems, AnInflatedRingOfTriangles) {
  EXPECT_NEAR(inflated(4, Cells::triangles, false), 1.49088, 6e-6);
  EXPECT_NEAR(inflated(8, Cells::triangles, false), 1.49773, 6e-6);
}

/// Inner radius over that at rest; closed form of an incompressible ring.
TEST(RubberProblems, ASpinningRing) {
  EXPECT_NEAR(spun(16, 0.02), 1.020568, 1e-4);
  EXPECT_NEAR(spun(16, 0.1), 1.116357, 5e-4);
  EXPECT_NEAR(spun(16, 0.2), 1.281575, 1e-3);
  const double coarse = spun(8, 0.1) - 1.116357, fine = spun(16, 0.1) - 1.116357;
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
}

TEST(RubberProblems, CooksMembrane) {
  EXPECT_NEAR(lifted(4, Cells::quadrilaterals, false), 6.0199, 6e-5);
  EXPECT_NEAR(lifted(8, Cells::quadrilaterals, false), 6.6186, 6e-5);
  EXPECT_NEAR(lifted(16, Cells::quadrilaterals, false), 6.8144, 6e-5);
}

TEST(RubberProblems, CooksMembraneWithOnePoint) {
  EXPECT_NEAR(lifted(4, Cells::quadrilaterals, true), 6.4405, 6e-5);
  EXPECT_NEAR(lifted(8, Cells::quadrilaterals, true), 6.7020, 6e-5);
}

TEST(RubberProblems, CooksMembraneOfTriangles) {
  EXPECT_NEAR(lifted(4, Cells::triangles, false), 3.1885, 6e-5);
  EXPECT_NEAR(lifted(8, Cells::triangles, false), 4.7740, 6e-5);
}

}  // namespace rubber_problems_test
