// SPDX-License-Identifier: BSD-3-Clause
/// Reduced wheels of viscous materials in three dimensions: the answer to forces that stand still
/// in space, energies, and what must hold whatever the numbers.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "rolling_box.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/fem/viscosity.hpp"
#include "rondo/rom/solid/solid_dynamic.hpp"
#include "rondo/rom/wheel/creep/creep_pair.hpp"

namespace rondo::rom {
namespace solid_creep_test {
using namespace rolling_box;
using Branches = std::vector<fem::ViscousBranch>;
using Complexes = std::complex<double>;
using Eigen::Index, Eigen::MatrixXcd;

/// A loss factor of .15 from 5 to 500 Hz.
Branches rubber() {
  return fem::branches_of(0.15, {5.0, 500.0});
}

/// Σ e^{-ikφ} G[d] over the lags.
MatrixXcd sum_of_lags(const RingResidual& g, int k) {
  MatrixXcd sum = MatrixXcd::Zero(g.size, g.size);
  for (int d = 0; d < g.n_sectors; ++d)
    sum += std::polar(1.0, -2.0 * std::numbers::pi * k * d / g.n_sectors) * g.block(d);
  return sum;
}

/// K g less the inertia of a pattern that stands still, by the definition.
MatrixXcd standing_matrix(const SolidRing& ring, int k, double spin, Complexes modulus) {
  const double rate = k * spin;
  MatrixXcd z = modulus * MatrixXcd(HarmonicStiffness(ring.stiffness).at_harmonic(k));
  for (Index a = 0; a < z.rows(); a += 3) {
    const double mass = ring.mass[static_cast<std::size_t>(a / 3)];
    for (const Index row : {a, a + 1}) z(row, row) -= (spin * spin + rate * rate) * mass;
    z(a + 2, a + 2) -= rate * rate * mass;
    z(a, a + 1) -= Complexes(0.0, 2.0 * rate * spin * mass);
    z(a + 1, a) += Complexes(0.0, 2.0 * rate * spin * mass);
  }
  return z;
}

/// Both matrices and the modes answer as one dense inverse of all of the body does.
TEST(SolidCreepResidual, AnswersStandingForcesExactly) {
  const BoxWheel box(24, 2);
  const auto modes = solid_modes(box.ring, {.wanted = 11});
  const std::vector<Index> rows = contact_rows(box.ring);
  for (const double beta : {0.0, 1e-4}) {
    const std::vector<CreepTerm> terms = creep_terms(rubber(), beta);
    for (const double spin : {10.0, 60.0}) {
      const CreepResidual both = solid_creep_residual(box.ring, modes, spin * spin, terms);
      EXPECT_TRUE(both.one_matrix.empty());
      EXPECT_TRUE(both.at_once.made_static.empty());
      for (int k = 0; k < 12; ++k) {
        const CreepLags lags(terms, k * spin);
        const MatrixXcd z = standing_matrix(box.ring, k, spin, 1.0 / lags.all());
        MatrixXcd answer =
            lags.first * sum_of_lags(both.at_once, k) + lags.others * sum_of_lags(both.later, k);
        if (const RingHarmonic* h = find_harmonic(modes, k))
          answer +=
              h->contact * (h->shapes.adjoint() * z * h->shapes).inverse() * h->contact.adjoint();
        const MatrixXcd exact = MatrixXcd(z.inverse())(rows, rows);
        EXPECT_LE((answer - exact).norm(), 1e-9 * exact.norm()) << k << " at " << spin;
      }
    }
  }
}

/// Branches so strong and fast that they are damping, whose form no sum of positive lags has.
TEST(SolidCreepResidual, TakesOneMatrixWhereTwoWouldGainEnergy) {
  const BoxWheel box(24, 2);
  const double spin = 60.0;
  const CreepResidual both =
      solid_creep_residual(box.ring, {}, spin * spin, creep_terms(Branches{{2e3, 1e-8}}, 0.0));
  EXPECT_FALSE(both.one_matrix.empty());
  const RingResidual damped = solid_residual(box.ring, {}, spin * spin);
  for (const int k : both.one_matrix) {
    const MatrixXcd g = sum_of_lags(damped, k);
    EXPECT_LE((sum_of_lags(both.later, k) - g).norm(), 1e-3 * g.norm()) << k;
  }
}

double total(const WheelEnergy& e) {
  return e.kinetic + e.elastic + e.residual;
}
double change(const WheelEnergy& e) {
  return e.frame - e.by_mass - e.by_stiffness - e.by_residual - e.viscous - e.friction - e.arrival -
         e.rim + e.scheme;
}

struct Outcome {
  double y = 0.0;                          ///< mean of the last steps [N]
  double unbalanced = 0.0, unsplit = 0.0;  ///< largest defects in a step [J]
  double energy = 0.0;                     ///< largest [J]
  double viscous = 0.0, least_viscous = 0.0, damped = 0.0;
};

constexpr int steps = 150, last = 50;

Outcome outcome(const RollingBox& rolling) {
  const OneBlasThread one;
  SolidWheel wheel = rolling.wheel();
  wheel.start(rolling.start());
  Outcome o;
  double energy = total(wheel.energy_at_start(true)), stored = wheel.energy_at_start(true).stored;
  for (int n = 0; n < steps; ++n) {
    const SolidWheelReport r = wheel.step(rolling.motion(n));
    const WheelEnergy& e = r.energy;
    o.unbalanced = std::max(o.unbalanced, std::abs(total(e) - energy - change(e)));
    o.unsplit = std::max(o.unsplit, std::abs(e.internal - (e.stored - stored) - e.viscous));
    energy = total(e);
    stored = e.stored;
    o.energy = std::max(o.energy, std::abs(energy));
    o.viscous += e.viscous;
    o.least_viscous = std::min(o.least_viscous, e.viscous);
    o.damped += e.by_stiffness + e.by_residual;
    if (n >= steps - last) o.y += r.end.force.y / last;
  }
  return o;
}

struct Way {
  const char* name;
  WheelViscosity loss;
  double spin_rate = 0.0;
};

class ViscousBox : public testing::TestWithParam<Way> {};

/// The balance, the split of the inner work and the sign of the loss.
TEST_P(ViscousBox, LosesWhatItDoesNotStore) {
  const Outcome o = outcome(RollingBox(GetParam().loss, GetParam().spin_rate));
  EXPECT_LE(o.unbalanced, 1e-12 * o.energy);
  EXPECT_LE(o.unsplit, 1e-12 * o.energy);
  EXPECT_GE(o.least_viscous, 0.0);
  EXPECT_GT(o.viscous, 0.1 * o.energy);
}

INSTANTIATE_TEST_SUITE_P(Ways, ViscousBox,
                         testing::Values(Way{"damped", {rubber(), 2e-5}},
                                         Way{"undamped", {rubber(), 0.0}},
                                         Way{"spin", {rubber(), 2e-5}, 100.0},
                                         Way{"turning_back", {rubber(), 2e-5}, 440.0}),
                         [](const auto& info) { return std::string(info.param.name); });

/// One branch of a short time is stiffness damping, and one of a long time a stiffer spring.
TEST(ViscousBoxes, HaveTheLimitsOfABranch) {
  const double beta = 2e-4;
  const Outcome damped = outcome(RollingBox(WheelViscosity{{}, beta})),
                branch = outcome(RollingBox(WheelViscosity{{{beta / 1e-6, 1e-6}}, 0.0}));
  EXPECT_NEAR(branch.y, damped.y, 2e-3 * damped.y);
  EXPECT_NEAR(branch.viscous, damped.damped, 0.1 * damped.damped);
  const Outcome elastic = outcome(RollingBox(WheelViscosity{{}, 0.0})),
                frozen = outcome(RollingBox(WheelViscosity{{{0.5, 1e4}}, 0.0}));
  EXPECT_NEAR(frozen.y, 1.5 * elastic.y, 0.02 * elastic.y);
  EXPECT_LT(frozen.viscous, 1e-4 * frozen.energy);
}

TEST(ViscousBoxes, ResumeToTheSameBits) {
  const OneBlasThread one;
  for (const double spin_rate : {0.0, 100.0}) {
    const RollingBox rolling({rubber(), 2e-5}, spin_rate);
    SolidWheel whole = rolling.wheel(), first = rolling.wheel(), second = rolling.wheel();
    whole.start(rolling.start());
    first.start(rolling.start());
    for (int n = 0; n < 60; ++n) {
      static_cast<void>(whole.step(rolling.motion(n)));
      static_cast<void>(first.step(rolling.motion(n)));
    }
    const std::vector<double> numbers = first.save();
    EXPECT_EQ(numbers.size(), SolidWheel::n_numbers(rolling.box.ring, rolling.model));
    ASSERT_TRUE(SolidWheel::is_saved(rolling.box.ring, rolling.model, numbers));
    second.restore(numbers);
    for (int n = 60; n < 100; ++n) {
      const SolidWheelReport a = whole.step(rolling.motion(n)), b = second.step(rolling.motion(n));
      ASSERT_EQ(a.end.force, b.end.force) << n;
      ASSERT_EQ(a.energy.viscous, b.energy.viscous) << n;
      ASSERT_EQ(total(a.energy), total(b.energy)) << n;
    }
    EXPECT_EQ(whole.save(), second.save());
  }
}

/// Both ways to the displacement of a contact node, of a wheel that remembers all around.
TEST(ViscousBoxes, ContactNodesAreWhereTheFieldHasThem) {
  const OneBlasThread one;
  const RollingBox rolling({rubber(), 2e-5});
  SolidWheel wheel = rolling.wheel();
  wheel.start(rolling.start());
  for (int n = 0; n < 120; ++n) static_cast<void>(wheel.step(rolling.motion(n)));
  const double angle = rolling.motion(119).plane.angle_next;
  std::vector<Vec3> field(rolling.box.model.reference.size()), contact(field.size());
  wheel.displacement(angle, field);
  wheel.contact_displacement(angle, contact);
  double largest = 0.0;
  for (const int node : rolling.box.mesh.boundary) {
    const auto k = static_cast<std::size_t>(node);
    EXPECT_LT(norm(field[k] - contact[k]), 1e-11) << node;
    largest = std::max(largest, norm(field[k]));
  }
  EXPECT_GT(largest, 1e-3);
}

}  // namespace solid_creep_test
}  // namespace rondo::rom
