// SPDX-License-Identifier: BSD-3-Clause
/// V13: stable at 0.99 of the critical step and divergent at 1.01, with and without contact, spin
/// and stiffness damping, by both operators.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <random>
#include <tuple>

#include "rondo/fem/assembly.hpp"
#include "support/models.hpp"
#include "support/stepping.hpp"

namespace v13_critical_step {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

struct Variant {
  const char* name;
  double beta, spin;
  bool contact;
  Scheme scheme = Scheme::symplectic;
  double alpha = 0.0;
};

class Limit : public testing::TestWithParam<std::tuple<Variant, StiffnessOperator>> {};

/// Largest energy over the run, of a start with random velocities (which hold every mode).
double largest_energy(const std::tuple<Variant, StiffnessOperator>& of, double safety, int steps) {
  const Variant& v = std::get<0>(of);
  auto c = test::rubber_annulus(3, 36);
  c.beta = v.beta;
  c.alpha = v.alpha;
  c.scheme = v.scheme;
  c.safety = safety;
  c.motion.angular_velocity = Table(v.spin);
  c.motion.speed = Table(0.3 * v.spin);
  c.motion.height = Table(0.298);
  auto b = test::build(c);
  if (v.contact) test::add_ground(b, {}, {0.3, 0.0});
  std::mt19937 random(11);
  std::uniform_real_distribution<double> x(-1.0, 1.0);
  std::vector<Vec2> u0(b.model.n_nodes()), v0(b.model.n_nodes());
  for (Vec2& velocity : v0) velocity = {x(random), x(random)};
  test::Stepping run(b, std::get<1>(of), u0, v0);
  double largest = 0.0;
  const auto look = [&](const StepReport& s) { largest = std::max(largest, s.balance.kinetic); };
  for (int n = 0; n < steps && std::isfinite(largest) && largest < 1e30; n += 50)
    run.advance(50, look);
  return largest;
}

}  // namespace

TEST_P(Limit, StableBelowDivergentAbove) {
  const double reference = largest_energy(GetParam(), 0.5, 20000);
  // Below the limit the energy keeps the size that it has at half the step.
  EXPECT_LT(largest_energy(GetParam(), 0.99, 20000), 10.0 * reference);
  // Above, the fastest mode alone grows by |z| >= 1.01 a step at the least.
  EXPECT_GT(largest_energy(GetParam(), 1.01, 20000), 1e9 * reference);
}

INSTANTIATE_TEST_SUITE_P(
    All, Limit,
    testing::Combine(testing::Values(Variant{"plain", 0.0, 0.0, false},
                                     Variant{"damped", 1e-5, 0.0, false},
                                     Variant{"strongly_damped", 2e-4, 0.0, false},
                                     Variant{"spinning", 0.0, 50.0, false},
                                     Variant{"contact", 0.0, 50.0, true},
                                     Variant{"all", 2e-5, 50.0, true}),
                     testing::ValuesIn(test::both_operators)),
    [](const auto& p) { return test::name(std::get<0>(p.param).name, std::get<1>(p.param)); });
INSTANTIATE_TEST_SUITE_P(General, Limit,
                         testing::Combine(testing::Values(Variant{"as_printed_damped", 1e-5, 0.0,
                                                                  false, Scheme::as_printed, 2e4}),
                                          testing::Values(StiffnessOperator::sparse)),
                         [](const auto& p) {
                           return test::name(std::get<0>(p.param).name, std::get<1>(p.param));
                         });

TEST(CriticalStep, FrequencyIsTheLargestOfTheMeshAndBelowTheElementBound) {
  test::DiskCase graded = test::rubber_annulus(6, 24);
  graded.disk.grading = 2.0;
  graded.material.plane = fem::Plane::stress;
  test::DiskCase treaded = test::rolling_disk(4, 0);
  treaded.disk.tread = mesh::Tread{
      .pitches = 12, .depth = 0.02, .land_columns = 3, .groove_columns = 1, .layers = 2};
  for (const auto& c :
       {test::rubber_annulus(3, 24), test::rubber_annulus(6, 24), graded, treaded}) {
    const auto b = test::build(c);
    Eigen::MatrixXd a = fem::free_matrix(b.model.stiffness, b.model.free);
    const auto mass = [&](Eigen::Index i) {
      return b.model.mass[static_cast<std::size_t>(b.model.free[static_cast<std::size_t>(i / 2)])];
    };
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      for (Eigen::Index j = 0; j < a.cols(); ++j) a(i, j) /= std::sqrt(mass(i) * mass(j));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> dense(a, Eigen::EigenvaluesOnly);
    const double omega = std::sqrt(dense.eigenvalues().maxCoeff());
    EXPECT_TRUE(b.critical.converged);
    EXPECT_GE(b.critical.omega, omega * (1.0 - 1e-13));  // on the safe side
    EXPECT_LT(b.critical.omega, omega * (1.0 + 5e-4));   // half of the residual asked for
    EXPECT_GE(b.critical.element_bound, omega);
  }
}

TEST(CriticalStep, FormulaWithStiffnessDamping) {
  const double omega = 3e4, beta = 2e-5, xi = 0.5 * beta * omega;
  EXPECT_NEAR(critical_step_of(omega, {beta}), 2.0 / omega * (std::sqrt(1 + xi * xi) - xi), 1e-18);
  EXPECT_EQ(critical_step_of(omega, {}), 2.0 / omega);
  // Mass damping alone, much larger than the frequencies: v⁺ = (1 - Δt α) v⁻ turns over at 2/α.
  EXPECT_NEAR(critical_step_of(omega, {0.0, 1e9}), 2.0 / 1e9, 1e-17);
}

}  // namespace v13_critical_step
