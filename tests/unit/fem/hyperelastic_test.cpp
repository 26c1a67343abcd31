// SPDX-License-Identifier: BSD-3-Clause
/// Rubber at finite strain: laws, cells of all kinds, whole bodies.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "rondo/core/complex.hpp"
#include "rondo/fem/hyperelastic/laws.hpp"
#include "unit/fem/rubber_fixture.hpp"

namespace hyperelastic_test {

using namespace rondo;
using namespace rondo::fem;

namespace {

struct Kind {
  Rubber rubber;
  Cells cells;
};

std::vector<Kind> all_kinds() {
  std::vector<Kind> kinds;
  for (Rubber r : all_rubbers()) {
    kinds.push_back({r, Cells::both});
    r.one_point = true;
    kinds.push_back({r, Cells::quadrilaterals});
  }
  return kinds;
}

/// Of a function of u by central differences.
template <class Function>
Eigen::VectorXd differences(const std::vector<Vec2>& u, double h, Function&& f) {
  Eigen::VectorXd slope(2 * static_cast<Eigen::Index>(u.size()));
  for (std::size_t i = 0; i < 2 * u.size(); ++i) {
    const auto moved = [&](double by) {
      std::vector<Vec2> v = u;
      (i % 2 == 0 ? v[i / 2].x : v[i / 2].y) += by;
      return f(v);
    };
    slope[static_cast<Eigen::Index>(i)] = (moved(h) - moved(-h)) / (2.0 * h);
  }
  return slope;
}

Eigen::MatrixXd matrix(const Hyperelasticity& body, const mesh::Mesh& m,
                       const std::vector<Vec2>& u) {
  return free_matrix(body.tangent(u), free_nodes(m));
}

/// In the interior of patch_mesh(n).
bool inside(std::size_t node, int n) {
  const int i = static_cast<int>(node) % (n + 1), j = static_cast<int>(node) / (n + 1);
  return i > 0 && i < n && j > 0 && j < n;
}

std::vector<Vec2> turned(const mesh::Mesh& m, const std::vector<Vec2>& u, double angle) {
  const Complex by = rotation(angle);
  std::vector<Vec2> v;
  for (std::size_t k = 0; k < u.size(); ++k)
    v.push_back(by * (m.coordinates[k] + u[k]) - m.coordinates[k]);
  return v;
}

}  // namespace

TEST(Hyperelastic, ForcesAreTheSlopeOfTheEnergy) {
  for (const Kind& kind : all_kinds()) {
    SCOPED_TRACE(name_of(kind.rubber));
    const mesh::Mesh m = patch_mesh(3, kind.cells);
    const Hyperelasticity body(m, std::vector{material_with(kind.rubber)});
    const std::vector<Vec2> u = wavy(m, 0.2);
    const Eigen::VectorXd f = as_vector(gradient_of(body, u));
    const auto energy = [&](const std::vector<Vec2>& v) { return energy_of(body, v); };
    EXPECT_LT((f - differences(u, 1e-5, energy)).norm(), 1e-8 * f.norm());
  }
}

TEST(Hyperelastic, TheTangentIsTheSlopeOfTheForces) {
  for (const Kind& kind : all_kinds()) {
    SCOPED_TRACE(name_of(kind.rubber));
    const mesh::Mesh m = patch_mesh(3, kind.cells);
    const Hyperelasticity body(m, std::vector{material_with(kind.rubber)});
    const std::vector<Vec2> u = wavy(m, 0.2);
    const Eigen::MatrixXd k = matrix(body, m, u);
    EXPECT_LT((k - k.transpose()).norm(), 1e-15 * k.norm());
    for (const Eigen::Index row : {0, 9, 14, 31}) {
      const auto force = [&](const std::vector<Vec2>& v) {
        return as_vector(gradient_of(body, v))[row];
      };
      const Eigen::VectorXd slope = differences(u, 1e-5, force);
      EXPECT_LT((k.row(row).transpose() - slope).norm(), 1e-8 * k.norm());
    }
  }
}

TEST(Hyperelastic, AtRestTheTangentIsTheStiffnessOfSmallStrain) {
  for (const Rubber& rubber : all_rubbers()) {
    SCOPED_TRACE(name_of(rubber));
    const mesh::Mesh m = patch_mesh(4, Cells::both);
    const std::vector materials{material_with(rubber)};
    const Hyperelasticity body(m, materials);
    const Eigen::MatrixXd small = free_matrix(assemble_stiffness(m, materials), free_nodes(m));
    const std::vector<Vec2> none(m.n_nodes());
    EXPECT_LT((matrix(body, m, none) - small).norm(), 2.5e-15 * small.norm());
    EXPECT_LT(largest_of(gradient_of(body, none)), 1e-15);
    EXPECT_NEAR(energy_of(body, none), 0.0, 1e-15);
  }
}

TEST(Hyperelastic, OnePointAtRestSeesNoStiffnessInRigidMotions) {
  Rubber rubber = rubber_of(RubberLaw::neo_hooke);
  rubber.one_point = true;
  const mesh::Mesh m = patch_mesh(1, Cells::quadrilaterals);
  const Hyperelasticity body(m, std::vector{material_with(rubber)});
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      matrix(body, m, std::vector<Vec2>(m.n_nodes())));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(solver.eigenvalues()[i], 0.0, 1e-14 * 40.0);
  EXPECT_GT(solver.eigenvalues()[3], 0.1);
}

/// A uniform strain has a uniform stress: what is inside is in equilibrium.
TEST(Hyperelastic, PassesThePatchTest) {
  for (const Kind& kind : all_kinds()) {
    SCOPED_TRACE(name_of(kind.rubber));
    const mesh::Mesh m = patch_mesh(6, kind.cells);
    const Hyperelasticity body(m, std::vector{material_with(kind.rubber)});
    const std::vector<Vec2> f = gradient_of(body, linear(m, 0.3, 0.2, -0.1, -0.15));
    double worst = 0.0;
    for (std::size_t k = 0; k < f.size(); ++k)
      if (inside(k, 6)) worst = std::max(worst, norm(f[k]));
    EXPECT_LT(worst, 9e-15 * largest_of(f));
  }
}

TEST(Hyperelastic, RotationsAreNoStrain) {
  for (const Kind& kind : all_kinds()) {
    SCOPED_TRACE(name_of(kind.rubber));
    const mesh::Mesh m = patch_mesh(3, kind.cells);
    const Hyperelasticity body(m, std::vector{material_with(kind.rubber)});
    const std::vector<Vec2> none(m.n_nodes()), u = wavy(m, 0.2);
    EXPECT_LT(largest_of(gradient_of(body, turned(m, none, 1.0))), 1e-13);
    EXPECT_NEAR(energy_of(body, turned(m, none, 1.0)), 0.0, 1e-14);
    const std::vector<Vec2> here = gradient_of(body, u),
                            there = gradient_of(body, turned(m, u, 1.0));
    EXPECT_NEAR(energy_of(body, u), energy_of(body, turned(m, u, 1.0)), 1e-14 * energy_of(body, u));
    Vec2 sum;
    double moment = 0.0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      EXPECT_LT(norm(rotation(1.0) * here[k] - there[k]), 1e-13);
      sum += here[k];
      moment += cross(m.coordinates[k] + u[k], here[k]);
    }
    EXPECT_LT(norm(sum) + std::abs(moment), 1e-13);
  }
}

TEST(Hyperelastic, AnInvertedCellIsNamed) {
  const mesh::Mesh m = patch_mesh(3, Cells::quadrilaterals);
  const Hyperelasticity body(m, std::vector{material_with(rubber_of(RubberLaw::ogden))});
  std::vector<Vec2> u(m.n_nodes()), f(m.n_nodes());
  Hyperelasticity::Pass pass;
  EXPECT_NEAR(body.gradient(u, {}, f, pass).least.ratio, 1.0, 1e-15);
  u[15] = {-0.5, -0.5};  // the last corner
  const LeastVolume least = body.gradient(u, {}, f, pass).least;
  EXPECT_LT(least.ratio, 0.0);
  EXPECT_EQ(least.cell, 8U);
  EXPECT_EQ(energy_of(body, u), std::numeric_limits<double>::infinity());
}

/// Beside cells of another material, which have their stiffness of small strain.
TEST(Hyperelastic, LinearCellsHaveTheirStiffness) {
  mesh::Mesh m = patch_mesh(3, Cells::both);
  m.clamped = {0, 1, 2, 3};
  m.region_names = {"rubber", "belt"};
  for (std::size_t e = 0; e < m.cells.size(); ++e) m.region.push_back(e % 3 == 0 ? 1 : 0);
  std::vector materials{material_with(rubber_of(RubberLaw::yeoh)), Material{20.0, 0.3, 1.0}};
  const Hyperelasticity body(m, materials);
  std::vector<Vec2> u = wavy(m, 0.1);
  for (const int node : m.clamped) u[static_cast<std::size_t>(node)] = {};
  const Eigen::VectorXd f = as_vector(gradient_of(body, u));
  const auto energy = [&](const std::vector<Vec2>& v) { return energy_of(body, v); };
  const Eigen::VectorXd slope = differences(u, 1e-5, energy);
  const Eigen::Index n = f.size() - 8;
  EXPECT_LT((f - slope).tail(n).norm(), 1e-8 * f.tail(n).norm());
  const auto force = [&](const std::vector<Vec2>& v) {
    return as_vector(gradient_of(body, v))[20];
  };
  const Eigen::MatrixXd k = matrix(body, m, u);
  EXPECT_LT((k.row(12).transpose() - differences(u, 1e-5, force).tail(n)).norm(), 1e-8 * k.norm());
  const std::vector<Vec2> none(m.n_nodes());
  const Eigen::MatrixXd small = free_matrix(assemble_stiffness(m, materials), free_nodes(m));
  EXPECT_LT((matrix(body, m, none) - small).norm(), 2.5e-15 * small.norm());
}

TEST(Hyperelastic, ForcesAreTheSameBitsOnAnyNumberOfThreads) {
  Rubber rubber = rubber_of(RubberLaw::yeoh);
  rubber.branches = {{0.3, 1.0}};
  const mesh::Mesh m = patch_mesh(40, Cells::both);
  const Hyperelasticity body(m, std::vector{material_with(rubber)});
  const std::vector<Vec2> u = wavy(m, 0.1), rest(m.n_nodes());
  std::vector<Vec2> one(u.size()), three(u.size());
  auto histories = body.relaxed(rest), others = histories;
  Hyperelasticity::Pass pass;
  const double lost = body.relax(u, 0.5, histories, pass, 1);
  EXPECT_EQ(lost, body.relax(u, 0.5, others, pass, 3));
  body.gradient(u, histories, one, pass, 1);
  body.gradient(u, others, three, pass, 3);
  EXPECT_EQ(one, three);
}

namespace {

/// W of principal stretches: it is that of what is as strained in its plane, for only their ratios
/// count.
double energy_of(const Rubber& r, double x, double y, double z) {
  return hyperelastic::isochoric_stress(r, (x * x + y * y) / (z * z), x * y / (z * z)).w;
}

/// dW/dλ over the number of directions that λ is of.
template <class Stretches>
double nominal_stress(const Rubber& r, double stretch, int directions, Stretches&& energy) {
  const double h = 1e-4;
  const auto at = [&](double by) { return energy(r, stretch + by); };
  return (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h * directions);
}

}  // namespace

/// Stress over the undeformed section of incompressible rubber: closed forms.
TEST(RubberLaws, FollowTheClosedForms) {
  struct Known {
    RubberLaw law;
    double uniaxial, equibiaxial, shear;
  };
  for (const Known& known : {Known{RubberLaw::neo_hooke, 1.750000, 1.368313, 0.700000},
                             Known{RubberLaw::mooney_rivlin, 1.575000, 1.710391, 0.700000},
                             Known{RubberLaw::yeoh, 1.890000, 1.419069, 0.682644},
                             Known{RubberLaw::ogden, 0.602722, 0.601980, 0.284257}}) {
    const Rubber r = rubber_of(known.law);
    SCOPED_TRACE(name_of(r));
    const auto uniaxial = [](const Rubber& of, double l) {
      return energy_of(of, l, 1.0 / std::sqrt(l), 1.0 / std::sqrt(l));
    };
    const auto equibiaxial = [](const Rubber& of, double l) {
      return energy_of(of, l, 1.0 / (l * l), l);
    };
    const auto shear = [](const Rubber& of, double by) {
      return hyperelastic::isochoric_stress(of, 2.0 + by * by, 1.0).w;
    };
    EXPECT_NEAR(nominal_stress(r, 2.0, 1, uniaxial), known.uniaxial, 6e-7);
    EXPECT_NEAR(nominal_stress(r, 1.5, 2, equibiaxial), known.equibiaxial, 6e-7);
    EXPECT_NEAR(nominal_stress(r, 0.7, 1, shear), known.shear, 6e-7);
  }
}

namespace {

Rubber viscous() {
  Rubber r = rubber_of(RubberLaw::neo_hooke);
  r.branches = {{0.5, 1.0}, {0.25, 0.1}};
  return r;
}

}  // namespace

TEST(RubberBranches, ForcesAreTheSlopeOfTheEnergy) {
  for (const Cells cells : {Cells::quadrilaterals, Cells::triangles}) {
    const mesh::Mesh m = patch_mesh(2, cells);
    const Hyperelasticity body(m, std::vector{material_with(viscous())});
    Hyperelasticity::Pass pass;
    auto histories = body.relaxed(wavy(m, -0.1));
    body.relax(wavy(m, 0.05), 0.05, histories, pass);
    const std::vector<Vec2> u = wavy(m, 0.2);
    const Eigen::VectorXd f = as_vector(gradient_of(body, u, histories));
    EXPECT_GT((f - as_vector(gradient_of(body, u))).norm(), 0.2);
    const auto energy = [&](const std::vector<Vec2>& v) { return energy_of(body, v, histories); };
    EXPECT_LT((f - differences(u, 1e-5, energy)).norm(), 1e-8 * f.norm());
  }
}

/// Relaxed branches have neither energy nor stress; held, they lose what they had.
TEST(RubberBranches, LoseTheirEnergyAndNoMore) {
  const mesh::Mesh m = patch_mesh(2, Cells::both);
  const Hyperelasticity body(m, std::vector{material_with(viscous())});
  Hyperelasticity::Pass pass;
  const std::vector<Vec2> u = wavy(m, 0.2), rest(m.n_nodes());
  auto histories = body.relaxed(rest);
  double stored = energy_of(body, u, histories), lost = 0.0;
  for (int step = 0; step < 400; ++step) {
    const double now = body.relax(u, 0.05, histories, pass);
    EXPECT_GE(now, -1e-15 * stored);  // of round-off once nothing is left
    lost += now;
  }
  EXPECT_NEAR(lost, stored - energy_of(body, u, histories), 1e-13 * stored);
  EXPECT_NEAR(energy_of(body, u, histories), energy_of(body, u), 1e-14 * stored);
  EXPECT_LT(
      (as_vector(gradient_of(body, u, body.relaxed(u))) - as_vector(gradient_of(body, u))).norm(),
      1e-14);
}

/// A small sudden strain decays as its branch does: exp(-t/τ).
TEST(RubberBranches, RelaxLinearlyAtSmallStrain) {
  Rubber r = rubber_of(RubberLaw::neo_hooke);
  r.branches = {{0.5, 1.0}};
  const mesh::Mesh m = patch_mesh(1, Cells::quadrilaterals);
  const Hyperelasticity body(m, std::vector{material_with(r)});
  Hyperelasticity::Pass pass;
  const std::vector<Vec2> u = linear(m, 0.0, 1e-5, 0.0, 0.0), rest(m.n_nodes());
  auto histories = body.relaxed(rest);
  const Eigen::VectorXd slow = as_vector(gradient_of(body, u));
  const double sudden = (as_vector(gradient_of(body, u, histories)) - slow).norm();
  for (int step = 0; step < 10; ++step) body.relax(u, 0.1, histories, pass);
  const double after = (as_vector(gradient_of(body, u, histories)) - slow).norm();
  EXPECT_NEAR(sudden, 0.5 * slow.norm(), 1e-4 * slow.norm());
  EXPECT_NEAR(after / sudden, std::exp(-1.0), 1e-5);
}

/// With any turn of the body.
TEST(RubberBranches, RotationsAreNoStrain) {
  const mesh::Mesh m = patch_mesh(2, Cells::both);
  const Hyperelasticity body(m, std::vector{material_with(viscous())});
  Hyperelasticity::Pass pass;
  const std::vector<Vec2> u = wavy(m, 0.2);
  auto histories = body.relaxed(std::vector<Vec2>(m.n_nodes()));
  body.relax(turned(m, u, 0.4), 0.3, histories, pass);
  const std::vector<Vec2> here = gradient_of(body, u, histories),
                          there = gradient_of(body, turned(m, u, 1.0), histories);
  for (std::size_t k = 0; k < u.size(); ++k)
    EXPECT_LT(norm(rotation(1.0) * here[k] - there[k]), 1e-13);
}

}  // namespace hyperelastic_test
