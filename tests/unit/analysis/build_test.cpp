// SPDX-License-Identifier: BSD-3-Clause
/// From a case to a setup: by the assembled stiffness where the disk is small, by harmonics above.
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/stability.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "rondo/analysis/build/initial_state.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/integrators/fused/sparse_plan.hpp"
#include "rondo/model/steps/step_table.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::build_test {
namespace {

Case spinning(int radial, int circumferential, double spin) {
  return test::read_text(fmt::format(R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = {}
circumferential = {}
[material]
youngs_modulus = 2e7
poissons_ratio = 0.3
density = 1100.0
[damping]
stiffness = 1e-8
[motion]
angular_velocity = {:.1f}
speed = 0.0
height = 0.0
[initial]
state = "stationary"
[time]
end = 1e-3
)",
                                     radial, circumferential, spin));
}

}  // namespace

TEST(Build, SmallDisksAreSetUpAsEver) {
  const auto s = build(spinning(12, 180, 60.0), 1);
  const dynamics::Model& m = s.model;
  ASSERT_LT(2 * m.free.size(), harmonic_setup_dofs);
  const auto expected =
      dynamics::critical_step(m.stiffness, m.mass, m.free, {1e-8, 0.0},
                              s.critical.element_bound * s.critical.element_bound);
  EXPECT_FALSE(s.critical.proven);
  EXPECT_EQ(s.critical.omega, expected.omega);
  EXPECT_EQ(s.critical.step, expected.step);
  EXPECT_EQ(s.displacement,
            statics::stationary_spin(m.stiffness, m.mass, m.reference, m.free, -60.0).u);
  EXPECT_TRUE(s.warnings.empty());
}

TEST(Build, NoMoreThreadsThanTheOperatorSharesWorkAmong) {
  Case c = spinning(12, 180, 60.0);  // 6 groups of 32 sectors, the last one of 20
  for (const auto& [asked, used] : {std::pair{3, 3}, {6, 6}, {8, 6}}) {
    const auto s = build(c, asked);
    EXPECT_EQ(s.model.threads, used);
    EXPECT_EQ(s.warnings.size(), asked > used ? 1U : 0U);
  }
  EXPECT_TRUE(build(c, 8).warnings.front().starts_with("6 threads instead of 8: the cyclic"));
  EXPECT_EQ(build(c, 0).model.threads, 1);  // few dofs

  c.solver_operator = "sparse";
  const auto s = build(c, 1000);
  const std::size_t blocks = make_sparse_plan(s.model).n_blocks;
  EXPECT_GT(blocks, 1U);
  EXPECT_EQ(s.model.threads, static_cast<int>(blocks));
  EXPECT_EQ(s.warnings.size(), 1U);
}

TEST(Build, LargeDisksAreSetUpByHarmonics) {
  const auto s = build(spinning(82, 1230, 60.0), 1);
  const dynamics::Model& m = s.model;
  ASSERT_GT(2 * m.free.size(), harmonic_setup_dofs);
  ASSERT_TRUE(m.sector);
  const fem::Material rubber{2e7, 0.3, 1100.0};
  const double bound = fem::sector_eigenvalue_bound(s.mesh, {&rubber, 1});
  const auto expected = dynamics::critical_step(*m.sector, m.mass, {1e-8, 0.0}, bound);
  EXPECT_TRUE(s.critical.proven);
  EXPECT_EQ(s.critical.omega, expected.omega);
  EXPECT_EQ(s.critical.step, expected.step);
  EXPECT_EQ(s.critical.element_bound, std::sqrt(bound));
  EXPECT_EQ(s.displacement, statics::stationary_spin(*m.sector, m.mass, m.reference, -60.0).u);
  EXPECT_TRUE(s.warnings.empty());
}

TEST(Build, LargeDisksOfTheGeneralStepHaveTheirStiffness) {
  Case c = spinning(82, 1230, 60.0);
  c.time.scheme = Scheme::as_printed;
  const auto s = build(c, 1);
  EXPECT_EQ(step_of(s.model), dynamics::StepKind::general);
  EXPECT_EQ(s.model.stiffness_operator, dynamics::StiffnessOperator::sparse);
  EXPECT_EQ(s.model.stiffness.row_start.size(), s.mesh.n_nodes() + 1);
}

TEST(Build, LargeDisksAreCheckedForSoftening) {
  const auto s = build(spinning(82, 1230, 400.0), 1);  // the lowest frequency is 548 rad/s
  ASSERT_EQ(s.warnings.size(), 1U);
  EXPECT_NE(s.warnings[0].find("takes more than a quarter"), std::string::npos) << s.warnings[0];
  EXPECT_THROW(build(spinning(82, 1230, 600.0), 1), InputError);
}

/// By both ways: the start solves the equation with K + K_σ, and the step is that of K + K_σ.
TEST(Build, StressOfTheSpinStiffens) {
  for (const int radial : {12, 82}) {
    SCOPED_TRACE(radial);
    Case c = spinning(radial, 15 * radial, 60.0);
    const auto plain = build(c, 1);
    c.stress_stiffening = StressStiffening::centrifugal;
    const auto s = build(c, 1);
    const dynamics::Model& m = s.model;
    const fem::Material rubber{2e7, 0.3, 1100.0};
    const fem::SectorStiffness expected = fem::assemble_sector(s.mesh, {&rubber, 1}, s.prestress);
    std::vector<Vec2> ku(m.n_nodes()), of_prestress(m.n_nodes());
    fem::apply(expected, s.displacement, ku);
    fem::apply(*plain.model.sector, s.prestress, of_prestress);
    double load = 0.0, rest = 0.0, rest_of_prestress = 0.0;
    for (const int node : m.free) {
      const auto i = static_cast<std::size_t>(node);
      const double factor = 3600.0 * m.mass[i];
      load = std::max(load, factor * norm(m.reference[i]));
      rest = std::max(rest, norm(ku[i] - factor * (m.reference[i] + s.displacement.plane()[i])));
      rest_of_prestress =
          std::max(rest_of_prestress, norm(of_prestress[i] - factor * m.reference[i]));
    }
    EXPECT_LT(rest, 1e-9 * load);  // K u cancels: 1e-13 of its terms
    EXPECT_LT(rest_of_prestress, 1e-9 * load);
    const double bound = fem::sector_eigenvalue_bound(s.mesh, {&rubber, 1}, s.prestress);
    EXPECT_NEAR(s.critical.element_bound, std::sqrt(bound), 1e-12 * std::sqrt(bound));
    const auto step = dynamics::critical_step(expected, m.mass, {1e-8, 0.0}, bound);
    EXPECT_NEAR(s.critical.omega, step.omega, 5e-4 * step.omega);  // Lanczos: 1e-3 of its square
    // Stress over modulus: ρ s² R² / E = 2 %, of which rings carry some tenths.
    EXPECT_GT(s.critical.omega, 1.0005 * plain.critical.omega);
    EXPECT_TRUE(s.warnings.empty());
    EXPECT_TRUE(plain.prestress.empty());
  }
}

TEST(Build, WithoutSpinNothingStiffens) {
  Case c = spinning(4, 60, 0.0);
  c.stress_stiffening = StressStiffening::centrifugal;
  const auto s = build(c, 1);
  ASSERT_EQ(s.warnings.size(), 1U);
  EXPECT_NE(s.warnings[0].find("the initial angular velocity is 0"), std::string::npos);
}

/// The spin that softening alone does not let be: 600 rad/s, above the lowest frequency.
TEST(Build, StiffenedDisksMaySpinFaster) {
  Case c = spinning(12, 180, 600.0);
  EXPECT_THROW(build(c, 1), InputError);
  c.stress_stiffening = StressStiffening::centrifugal;
  const auto s = build(c, 1);
  EXPECT_TRUE(s.warnings.empty());
}

TEST(Build, MassDampingShortensTheStepOfTheSchemeAsPrinted) {
  for (const int radial : {12, 82}) {
    Case c = spinning(radial, 15 * radial, 60.0);
    c.damping.mass = 300.0;
    const auto kept = build(c, 1).critical;
    EXPECT_EQ(kept.step, dynamics::critical_step_of(kept.omega, {1e-8, 0.0}));
    c.time.scheme = Scheme::as_printed;
    const auto lagged = build(c, 1).critical;
    EXPECT_EQ(lagged.step, dynamics::critical_step_of(lagged.omega, {1e-8, 300.0}));
    EXPECT_LT(lagged.step, kept.step);
  }
}

/// Found by fuzzing: the quotient of the smallest end and a step of seconds is 0.
TEST(Build, AnEndThatUnderflowsHasOneStep) {
  Case c = spinning(2, 6, 60.0);
  c.time.end = 5e-324;
  EXPECT_EQ(count_steps(c, 4.0), 1);
  c.time.end = 0.1;
  EXPECT_EQ(count_steps(c, 1e-5), 10000);
}

/// Found by fuzzing: on a very soft body the rim turned several times in a step, and the contact
/// law had no solution. At a step of φ = 2 atan(1/μ) its normal and tangential terms balance.
TEST(Build, ATurnTooWideForTheContactLawIsRefused) {
  Case c = spinning(2, 24, 1.0);
  c.initial.state = InitialState::rest;
  c.motion.height = dynamics::Table(1.0);
  c.ground.emplace().friction.coefficient = 100.0;  // less than 0.02 rad a step
  const double dt = build(c, 1).model.dt, limit = 2.0 * std::atan(1.0 / 100.0);
  c.motion.angular_velocity = dynamics::Table(0.999 * limit / dt);
  EXPECT_NO_THROW(static_cast<void>(build(c, 1)));
  c.motion.angular_velocity = dynamics::Table(1.001 * limit / dt);
  EXPECT_THROW(static_cast<void>(build(c, 1)), InputError);
  c.ground.reset();
  EXPECT_NO_THROW(static_cast<void>(build(c, 1)));
}

TEST(Build, SofteningIsCheckedWhereOneFactorIsSmall) {
  EXPECT_TRUE(softening_is_checked(500000, 0));
  EXPECT_FALSE(softening_is_checked(500001, 0));
  EXPECT_TRUE(softening_is_checked(10000000, 20000));
  EXPECT_FALSE(softening_is_checked(10000000, 20001));
  EXPECT_TRUE(softening_is_checked(500000, 100000));
}

TEST(Build, FieldsOfTheStartComeAfterTheStep) {
  const Case c = spinning(2, 24, 10.0);
  auto s = build(c, 1);
  set_initial_fields(c, s);
  s.model.dt = 0.0;
  EXPECT_DEATH(set_initial_fields(c, s), "model.dt > 0.0");
}

}  // namespace rondo::study::build_test
