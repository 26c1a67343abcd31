// SPDX-License-Identifier: BSD-3-Clause
/// Reduced wheels of viscous materials: the spectrum of their creep, the answer to forces that
/// stand still in space, energies, and what must hold whatever the numbers.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <vector>

#include "rolling_wheel.hpp"
#include "rondo/fem/viscosity.hpp"
#include "rondo/rom/wheel/creep_field.hpp"

namespace rondo::rom {
namespace viscous_wheel_test {
using namespace rolling_wheel;
using Branches = std::vector<fem::ViscousBranch>;
using Complexes = std::complex<double>;
using Eigen::Index, Eigen::MatrixXcd;

/// A loss factor of .15 from 5 to 500 Hz.
Branches rubber() {
  return fem::branches_of(0.15, {5.0, 500.0});
}

TEST(Creep, TermsAreTheInverseOfTheModulus) {
  const Branches of[] = {{{0.8, 0.02}}, rubber(), {{0.1, 0.01}, {0.3, 0.01}, {0.2, 1e-5}}};
  for (const Branches& branches : of)
    for (const double beta : {0.0, 2e-5, 1e-2}) {
      const std::vector<CreepTerm> terms = creep_terms(branches, beta);
      double sum = 0.0, time = -1.0;
      for (const CreepTerm& term : terms) {
        EXPECT_GT(term.share, 0.0);
        EXPECT_GT(term.time, time);
        time = term.time;
        sum += term.share;
      }
      EXPECT_NEAR(sum, 1.0, 1e-13);
      EXPECT_EQ(terms.front().time == 0.0, beta == 0.0);
      for (const double omega : {0.0, 1.0, 50.0, -300.0, 1e4, 1e6}) {
        const Complexes g =
            1.0 + fem::branch_modulus(branches, omega) + Complexes(0.0, omega * beta);
        EXPECT_NEAR(std::abs(creep_at(terms, omega) * g - 1.0), 0.0, 1e-12) << beta << " " << omega;
      }
    }
}

/// The lag of a force that changes linearly: λ_b' = (λ - λ_b)/τ.
TEST(Creep, AStepIsExactForAForceThatChangesLinearly) {
  const double dt = 4e-4, from = 2.0, to = 5.0, start = -1.0;
  for (const double ratio : {0.009, 0.011, 0.7, 30.0}) {
    const double time = dt / ratio, slope = (to - from) / dt;
    const CreepStep s = creep_step(time, dt);
    EXPECT_NEAR(s.kept + s.before + s.now, 1.0, 1e-15);
    const double exact = to - slope * time + (start - from + slope * time) * std::exp(-ratio);
    EXPECT_NEAR(s.kept * start + s.before * from + s.now * to, exact, 1e-12) << ratio;
  }
  const CreepStep slow = creep_step(dt / 1e-8, dt);
  EXPECT_NEAR(slow.now, 0.5e-8, 1e-15);
  EXPECT_NEAR(slow.before, 0.5e-8, 1e-15);
  const CreepStep at_once = creep_step(0.0, 4e-4);
  EXPECT_EQ(at_once.now, 1.0);
  EXPECT_EQ(at_once.kept, 0.0);
}

/// Σ e^{-ikφ} G[d] over the lags.
MatrixXcd harmonic_of(const RingResidual& g, int k) {
  MatrixXcd sum = MatrixXcd::Zero(g.size, g.size);
  for (int d = 0; d < g.n_sectors; ++d)
    sum += std::polar(1.0, -2.0 * pi * k * d / g.n_sectors) * g.block(d);
  return sum;
}

/// (2C, 2C) The answer of all of the body to forces that stand still, by one dense inverse.
MatrixXcd steady_answer(const Ring& ring, int k, double spin, Complexes modulus) {
  const double rate = k * spin;
  MatrixXcd z = modulus * stiffness_of(ring, k);
  for (Index a = 0; a < z.rows(); a += 2) {
    const double mass = ring.mass[static_cast<std::size_t>(a / 2)];
    z(a, a) -= (spin * spin + rate * rate) * mass;
    z(a + 1, a + 1) -= (spin * spin + rate * rate) * mass;
    z(a, a + 1) -= Complexes(0.0, 2.0 * rate * spin * mass);
    z(a + 1, a) += Complexes(0.0, 2.0 * rate * spin * mass);
  }
  std::vector<Index> rows;
  for (const int c : ring.contact) rows.insert(rows.end(), {Index{2} * c, Index{2} * c + 1});
  return MatrixXcd(z.inverse())(rows, rows);
}

/// With the modes' own answer, of (R.30) with K g.
MatrixXcd modes_answer(const RingHarmonic& h, double spin, Complexes modulus) {
  const double rate = h.k * spin;
  MatrixXcd z = Complexes(0.0, 2.0 * rate * spin) * h.coriolis;
  z.diagonal() += modulus * h.squares;
  z.diagonal().array() -= spin * spin + rate * rate;
  return h.contact * z.inverse() * h.contact.adjoint();
}

TEST(CreepResidual, AnswersStandingForcesExactly) {
  const Disk d(4, 30);
  const Ring ring = d.ring();
  const auto modes = ring_modes(ring, {.wanted = 11});
  for (const double spin : {10.0, 60.0})
    for (const double beta : {0.0, 1e-4}) {
      const std::vector<CreepTerm> terms = creep_terms(rubber(), beta);
      const CreepResidual both = creep_residual(ring, modes, spin * spin, terms);
      EXPECT_TRUE(both.one_matrix.empty());
      EXPECT_TRUE(both.at_once.made_static.empty());
      for (int k = 0; k < 15; ++k) {
        const double rate = k * spin;
        const Complexes first = terms.front().at(rate), all = creep_at(terms, rate);
        MatrixXcd answer =
            first * harmonic_of(both.at_once, k) + (all - first) * harmonic_of(both.later, k);
        for (const RingHarmonic& h : modes)
          if (h.k == k) answer += modes_answer(h, spin, 1.0 / all);
        const MatrixXcd exact = steady_answer(ring, k, spin, 1.0 / all);
        EXPECT_LE((answer - exact).norm(), 1e-9 * exact.norm()) << k << " at " << spin;
      }
    }
}

/// Branches so strong and fast that they are damping, whose form no sum of positive lags has.
TEST(CreepResidual, TakesOneMatrixWhereTwoWouldGainEnergy) {
  const Disk d(4, 30);
  const Ring ring = d.ring();
  const double spin = 60.0, beta = 2e-5;
  const Branches one{{beta / 1e-8, 1e-8}};
  const CreepResidual both = creep_residual(ring, {}, spin * spin, creep_terms(one, 0.0));
  EXPECT_FALSE(both.one_matrix.empty());
  EXPECT_TRUE(both.at_once.made_static.empty());
  const RingResidual damped = ring_residual(ring, {}, spin * spin, ResidualForm::convected);
  for (int k = 0; k < 15; ++k) {
    const MatrixXcd g = harmonic_of(damped, k);
    EXPECT_LE((harmonic_of(both.later, k) - g).norm(), 1e-3 * g.norm()) << k;
  }
}

struct Way {
  const char* name;
  Rolling run;
  bool whole = false;
};

class ViscousWheel : public testing::TestWithParam<Way> {};

/// The balance, the split of the inner work and the sign of the loss.
TEST_P(ViscousWheel, LosesWhatItDoesNotStore) {
  const Way& way = GetParam();
  const Disk d(4, 60, way.whole);
  Rolling run = way.run;
  run.branches = rubber();
  run.end = 0.1;
  const Outcome o = outcome(run, d);
  EXPECT_LE(o.unbalanced, 1e-12 * o.energy);
  EXPECT_LE(o.unsplit, 1e-12 * o.energy);
  EXPECT_GE(o.least_viscous, 0.0);
  EXPECT_GT(o.sums.viscous, 0.1 * o.energy);
  EXPECT_LE(o.residual, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    Ways, ViscousWheel,
    testing::Values(Way{"ring", {}}, Way{"undamped", {.damped = false}}, Way{"mesh", {}, true},
                    Way{"no_modes", {.modes = 0}}, Way{"damped", {.stiffness_damping = 2e-4}},
                    Way{"spin", {.spins = dynamics::Table({{0.0, 20.0}, {0.1, 40.0}})}},
                    Way{"turning_back",
                        {.speed = 0.0, .spins = dynamics::Table({{0.0, 20.0}, {0.1, -20.0}})}},
                    Way{"mesh_spin", {.spins = dynamics::Table({{0.0, 20.0}, {0.1, 40.0}})}, true}),
    [](const auto& info) { return std::string(info.param.name); });

/// One branch of a short time is stiffness damping: in the limit of small steps too, because the
/// lag of damping is taken by implicit Euler and that of a branch exactly.
TEST(ViscousWheels, AShortBranchIsStiffnessDamping) {
  const Disk d(6, 90);
  const double beta = 2e-4;
  struct Difference {
    double force, loss;
  };
  const auto difference = [&](double time, double passes) {
    Rolling run{.passes = passes, .end = 0.1, .stiffness_damping = beta};
    const Outcome damped = outcome(run, d);
    run.branches = {{beta / time, time}};
    run.stiffness_damping = 0.0;
    const Outcome o = outcome(run, d);
    const double loss = damped.sums.by_stiffness + damped.sums.by_residual;
    return Difference{(std::abs(o.y - damped.y) + std::abs(o.x - damped.x)) / damped.y,
                      std::abs(o.sums.viscous - loss) / loss};
  };
  const Difference slow = difference(1e-3, 20.618), coarse = difference(1e-6, 5.618),
                   fine = difference(1e-6, 20.618);
  EXPECT_GT(slow.loss, 0.1);
  EXPECT_LT(coarse.force, 1e-3);
  EXPECT_LT(coarse.loss, 0.05);
  EXPECT_LT(fine.force, 3e-4);
  EXPECT_LT(fine.loss, 0.01);
}

/// What is left of the whole mesh's form, its missing inertia, is small with so many modes.
TEST(ViscousWheels, AMeshWithoutSectorsLosesWhatTheDiskDoes) {
  Rolling run{.modes = 40, .friction = 0.0, .branches = rubber()};
  const Outcome ring = outcome(run, Disk(6, 90)), mesh = outcome(run, Disk(6, 90, true));
  EXPECT_NEAR(mesh.y, ring.y, 2e-3 * ring.y);
  EXPECT_NEAR(mesh.sums.viscous, ring.sums.viscous, 0.01 * ring.sums.viscous);
}

TEST(ViscousWheels, BackwardsIsTheMirror) {
  const Disk d(6, 90);
  Rolling run{.end = 0.1, .branches = rubber()}, mirrored = run;
  mirrored.spin = -run.spin;
  mirrored.speed = -run.speed;
  const Outcome a = outcome(run, d), b = outcome(mirrored, d);
  EXPECT_NEAR(b.x, -a.x, 1e-5 * a.y);
  EXPECT_NEAR(b.y, a.y, 1e-5 * a.y);
  EXPECT_NEAR(b.sums.viscous, a.sums.viscous, 1e-5 * a.sums.viscous);
}

TEST(ViscousWheels, ResumeToTheSameBits) {
  const OneBlasThread one;
  const Disk d(4, 60);
  for (const bool changes : {false, true}) {
    Rolling run{.branches = rubber()};
    if (changes) run.spins = dynamics::Table({{0.0, 25.0}, {1.0, 35.0}});
    Wheel whole(d, run), first(d, run), second(d, run);
    for (int i = 0; i < 100; ++i) {
      static_cast<void>(whole.wheel.step(whole.motion.at(i)));
      static_cast<void>(first.wheel.step(first.motion.at(i)));
    }
    const std::vector<double> numbers = first.wheel.save();
    EXPECT_EQ(numbers.size(), RingWheel::n_numbers(first.ring, first.model, 0.0));
    ASSERT_TRUE(RingWheel::is_saved(first.ring, first.model, 0.0, numbers));
    second.wheel.restore(numbers);
    for (int i = 100; i < 200; ++i) {
      const WheelReport a = whole.wheel.step(whole.motion.at(i)),
                        b = second.wheel.step(second.motion.at(i));
      ASSERT_EQ(a.force, b.force) << i;
      ASSERT_EQ(a.energy.viscous, b.energy.viscous) << i;
      ASSERT_EQ(a.energy.internal, b.energy.internal) << i;
      ASSERT_EQ(total(a.energy), total(b.energy)) << i;
    }
    EXPECT_EQ(whole.wheel.save(), second.wheel.save());
  }
}

/// Both ways to the displacement of a contact node, of a wheel that remembers all around.
TEST(ViscousWheels, ContactNodesAreWhereTheFieldHasThem) {
  const OneBlasThread one;
  const Disk d(4, 60);
  Wheel w(d, {.branches = rubber()});
  for (int i = 0; i < 120; ++i) static_cast<void>(w.wheel.step(w.motion.at(i)));
  const double angle = w.motion.at(119).angle_next;
  std::vector<Vec2> field(d.built.mesh.n_nodes()), contact(field.size());
  w.wheel.displacement(angle, field);
  w.wheel.contact_displacement(angle, contact);
  double largest = 0.0;
  for (const int node : d.built.mesh.boundary) {
    const auto k = static_cast<std::size_t>(node);
    EXPECT_LT(norm(field[k] - contact[k]), 1e-12) << node;
    largest = std::max(largest, norm(field[k]));
  }
  EXPECT_GT(largest, 1e-3);
}

/// Pressed and left alone, a wheel that stands gives way to the force of slow strains.
TEST(ViscousWheels, AStandingWheelRelaxes) {
  const Disk d(6, 90);
  Rolling run{.modes = 20, .friction = 0.0, .spin = 0.0, .speed = 0.0, .end = 0.8};
  const Outcome slow = outcome(run, d);
  run.branches = rubber();
  const Outcome relaxed = outcome(run, d);
  run.end = 0.0215;
  const Outcome pressed = outcome(run, d);
  EXPECT_NEAR(relaxed.y, slow.y, 1e-4 * slow.y);
  EXPECT_GT(pressed.y, 1.05 * slow.y);
}

/// A start from a field on the ground takes its branches as relaxed: a wheel that has stood for
/// long goes on standing.
TEST(ViscousWheels, AStartOnTheGroundIsRelaxed) {
  const OneBlasThread one;
  const Disk d(6, 90);
  const Rolling run{.modes = 20, .friction = 0.0, .spin = 0.0, .speed = 0.0, .branches = rubber()};
  Wheel w(d, run);
  const int n = static_cast<int>(0.8 / w.dt);
  double force = 0.0;
  for (int i = 0; i < n; ++i) force = w.wheel.step(w.motion.at(i)).force.y;
  std::vector<Vec2> u(d.built.mesh.n_nodes()), v(u.size());
  w.wheel.displacement(w.motion.at(n - 1).angle_next, u);
  WheelMotion start = w.motion.at(n);
  start.center_next = start.center;
  w.wheel.start(start, u, v);
  EXPECT_NEAR(w.wheel.force_at_start()[1], force, 2e-3 * force);
  EXPECT_NEAR(w.wheel.step(w.motion.at(n)).force.y, force, 2e-3 * force);
}

}  // namespace viscous_wheel_test
}  // namespace rondo::rom
