// SPDX-License-Identifier: BSD-3-Clause
/// A wheel that stands and is pressed onto the ground by increments.
#include "rondo/statics/steady/standing.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "rondo/contact/friction_table.hpp"
#include "support/solid_steady.hpp"

namespace standing_test {

using namespace rondo;
using namespace rondo::statics;
using contact::Status;
using Eigen::Index;

namespace {

test::SteadyWheelCase standing_case() {
  test::SteadyWheelCase c = test::box_wheel_case(1);
  c.wheel = test::box_wheel(2, 3, 36);
  c.spin = c.mass_damping = c.stiffness_damping = 0.0;
  return c;
}

/// What a body has beyond K u that is `share` stiffer than K, with its tangent, one sample a
/// sector.
class Stiffer final : public RollingRemainder {
 public:
  Stiffer(const test::SteadyWheel& w, double share) : w_(w), share_(share) {}
  bool find(const Eigen::MatrixXd& u, Eigen::MatrixXd& force) override {
    force = share_ * linear(u);
    energy_ = 0.5 * (1.0 + share_) / share_ * force.cwiseProduct(u).sum();
    return true;
  }
  Eigen::MatrixXd linear(const Eigen::MatrixXd& u) override {
    Eigen::MatrixXd force = Eigen::MatrixXd::Zero(u.rows(), u.cols());
    const fem::SolidSector& k = w_.sector;
    for (Index j = 0; j < u.cols(); ++j)
      for (std::size_t a = 0; a < k.n_local(); ++a)
        for (const fem::SolidSector::Entry& e : k.row(a)) {
          const Index other = (j + e.shift + u.cols()) % u.cols(), row = static_cast<Index>(3 * a);
          force.col(j).segment<3>(row) += Eigen::Map<const Eigen::Matrix3d>(e.block.data()) *
                                          u.col(other).segment<3>(3 * e.column);
        }
    return force;
  }
  bool take_tangent(const Eigen::MatrixXd& /*u*/, std::span<const RollingPair> /*pairs*/) override {
    return true;
  }
  void move(const Eigen::MatrixXd& force, Eigen::MatrixXd& u) override {
    u += w_.harmonics.fields(w_.harmonics.response(force), 0.0, false) / (1.0 + share_);
  }
  [[nodiscard]] Eigen::Matrix3d softness(const RollingPair& of,
                                         const RollingPair& by) const override {
    return -share_ / (1.0 + share_) *
           w_.harmonics.compliance(of.candidate, by.candidate, of.sample - by.sample);
  }
  [[nodiscard]] double energy() const override { return energy_; }

 private:
  const test::SteadyWheel& w_;
  double share_, energy_ = 0.0;
};

void expect_good(const StandingState& s) {
  EXPECT_LE(s.residual, 1e-12);
  EXPECT_LE(s.equilibrium, 1e-11);
  EXPECT_LE(s.penetration, 1e-14);
  EXPECT_LE(s.works.relative, 1e-12);
}

StandingState pressed(StandingWheel& wheel, const StandingTarget& target) {
  EXPECT_EQ(wheel.press(target), RollingEnd::solved);
  expect_good(wheel.state());
  return wheel.state();
}

int count(const StandingState& s, Status status) {
  int n = 0;
  for (const RollingStatus& p : s.solution.status) n += p.status == status ? 1 : 0;
  return n;
}

/// 1 cm² for each candidate.
std::vector<double> areas(const test::SteadyWheel& w) {
  return std::vector<double>(w.harmonics.n_candidates(), 1e-4);
}

StandingState drawn(const test::SteadyWheel& w, contact::FrictionTable table) {
  StandingWheel wheel(w.harmonics, 0.0, contact::friction_of(std::move(table)), nullptr, areas(w));
  for (const double depth : {2e-3, 4e-3}) static_cast<void>(pressed(wheel, {.depth = depth}));
  for (const double slide : {1e-3, 2e-3})
    static_cast<void>(pressed(wheel, {.depth = 4e-3, .slide = slide}));
  return wheel.state();
}

}  // namespace

/// Whatever touches sticks: gap and way are 0 there, and no force is elsewhere.
TEST(Standing, WhereAllSticksOneIncrementIsALinearSystem) {
  const test::SteadyWheel w(standing_case());
  StandingWheel wheel(w.harmonics, 0.05, 10.0, nullptr);
  const StandingState s = pressed(wheel, {.depth = 6e-3});
  const RollingProblem<3>& p = wheel.window().problem();
  std::vector<Index> rows;
  for (std::size_t j = 0; j < s.solution.status.size(); ++j)
    for (Index c = 0; s.solution.status[j].status == Status::stick && c < 3; ++c)
      rows.push_back(static_cast<Index>(3 * j) + c);
  EXPECT_EQ(count(s, Status::slip), 0);
  ASSERT_GE(rows.size(), 12U);
  Eigen::VectorXd free = p.base(rows);
  for (Index k = 0; k < free.size(); k += 3) free[k] += s.solution.height;
  const Eigen::VectorXd force = p.matrix(rows, rows).fullPivLu().solve(-free);
  const Eigen::VectorXd found = s.solution.force(rows);
  EXPECT_LT((force - found).norm(), 1e-10 * force.norm());
  EXPECT_NEAR(s.works.friction, 0.0, 1e-14 * s.works.exchanged);
}

/// Without friction a state does not depend on its path; with it one does, and pressing it down and
/// up takes energy. At depth 0 nothing is left.
TEST(Standing, OnlyFrictionTakesEnergyOnTheWayDownAndUp) {
  const test::SteadyWheel w(standing_case());
  for (const double friction : {0.0, 0.3}) {
    StandingWheel wheel(w.harmonics, 0.0, friction, nullptr),
        at_once(w.harmonics, 0.0, friction, nullptr);
    for (const double depth : {1e-3, 2e-3}) static_cast<void>(pressed(wheel, {.depth = depth}));
    const double first = pressed(wheel, {.depth = 3e-3}).solution.forces.normal;
    for (const double depth : {4e-3, 5e-3}) static_cast<void>(pressed(wheel, {.depth = depth}));
    const StandingState deepest = pressed(wheel, {.depth = 6e-3});
    const double direct = pressed(at_once, {.depth = 6e-3}).solution.forces.normal;
    for (const double depth : {5e-3, 4e-3}) static_cast<void>(pressed(wheel, {.depth = depth}));
    const double again = pressed(wheel, {.depth = 3e-3}).solution.forces.normal;
    for (const double depth : {2e-3, 1e-3}) static_cast<void>(pressed(wheel, {.depth = depth}));
    EXPECT_EQ(wheel.press({.depth = 0.0}), RollingEnd::no_contact);
    const StandingState& left = wheel.state();
    EXPECT_EQ(left.solution.forces.normal, 0.0);
    EXPECT_EQ(left.works.strain, 0.0);
    EXPECT_LE(left.works.relative, 1e-12);
    const double size = deepest.solution.forces.normal;
    if (friction == 0.0) {
      EXPECT_NEAR(first, again, 1e-12 * size);
      EXPECT_NEAR(size, direct, 1e-12 * size);
      EXPECT_EQ(left.works.friction, 0.0);
    } else {
      EXPECT_GT(std::abs(first - again), 1e-4 * size);
      EXPECT_GT(deepest.works.friction, 0.0);
      EXPECT_GT(left.works.friction, deepest.works.friction);
    }
    EXPECT_NEAR(left.works.rim, left.works.friction + left.works.impact,
                1e-12 * left.works.exchanged);
  }
}

TEST(Standing, ALoadLeadsToTheDepthThatBearsIt) {
  const test::SteadyWheel w(standing_case());
  StandingWheel by_depth(w.harmonics, -0.1, 0.5, nullptr), by_load(w.harmonics, -0.1, 0.5, nullptr);
  for (const double depth : {2e-3, 5e-3}) {
    const StandingState s = pressed(by_depth, {.depth = depth});
    const StandingState t = pressed(by_load, {.load = s.solution.forces.normal});
    EXPECT_NEAR(t.depth, depth, 1e-12);
    EXPECT_NEAR(t.solution.forces.lateral, s.solution.forces.lateral,
                1e-9 * s.solution.forces.normal);
  }
}

/// The center goes along t1: the ground holds back, until all slides.
TEST(Standing, DrawnAlongTheGroundItSlidesInTheEnd) {
  const test::SteadyWheel w(standing_case());
  StandingWheel wheel(w.harmonics, 0.0, 0.4, nullptr);
  const StandingState before = pressed(wheel, {.depth = 4e-3});
  EXPECT_NEAR(before.solution.forces.heading, 0.0, 1e-9);
  const StandingState stuck = pressed(wheel, {.depth = 4e-3, .slide = 1e-4});
  EXPECT_LT(stuck.solution.forces.heading, 0.0);
  EXPECT_GT(count(stuck, Status::stick), 0);
  StandingState s;
  for (int k = 1; k <= 10; ++k) s = pressed(wheel, {.depth = 4e-3, .slide = 5e-3 * k});
  EXPECT_EQ(count(s, Status::stick), 0);
  EXPECT_NEAR(s.solution.forces.heading / s.solution.forces.normal, -0.4, 1e-3);
}

/// Forces beyond K u, here as many again: the states of a body that is twice as stiff.
/// Ice under the left half or under the right one: mirrored, the drag on the other half.
TEST(Standing, PatchesOnEitherSideAreMirrored) {
  const test::SteadyWheel w(standing_case());
  const auto on = [&](contact::Side side) {
    return drawn(w, {.coefficient = 0.4,
                     .slip = {},
                     .patches = {{.from = -1.0, .to = 1.0, .side = side, .factor = 0.1}}})
        .solution.forces;
  };
  const RollingForces left = on(contact::Side::left), right = on(contact::Side::right),
                      both = on(contact::Side::both);
  const double size = left.normal;
  EXPECT_NEAR(left.normal, right.normal, 1e-9 * size);
  EXPECT_NEAR(left.heading, right.heading, 1e-9 * size);
  EXPECT_NEAR(left.lateral, -right.lateral, 1e-9 * size);
  EXPECT_NEAR(left.aligning, -right.aligning, 1e-9 * size);
  EXPECT_GT(std::abs(left.aligning), 1e-3 * size);
  const RollingForces ice =
      drawn(w, {.coefficient = 0.04, .slip = {}, .patches = {}}).solution.forces;
  EXPECT_NEAR(both.heading, ice.heading, 1e-9 * size);
  EXPECT_NEAR(both.normal, ice.normal, 1e-9 * size);
  EXPECT_LT(left.heading, -0.15 * size);
}

/// Each pair that slides has the coefficient of its pressure in the increment before.
TEST(Standing, APairHasTheCoefficientOfItsPressureBefore) {
  const test::SteadyWheel w(standing_case());
  const contact::FrictionTable table{.coefficient = 0.4,
                                     .slip = {},
                                     .pressure_exponent = -0.3,
                                     .pressure_reference = 2e6,
                                     .patches = {}};
  StandingWheel wheel(w.harmonics, 0.0, contact::friction_of(table), nullptr, areas(w));
  double least = 1.0, most = 0.0;
  for (int k = 1; k <= 6; ++k) {
    const Eigen::VectorXd before = wheel.state().solution.force;
    const StandingState s = pressed(wheel, {.depth = 1e-3 * k, .slide = 5e-4 * k});
    for (std::size_t j = 0; j < s.solution.status.size(); ++j) {
      const auto row = static_cast<Index>(3 * j);
      const double normal = s.solution.force[row], was = row < before.size() ? before[row] : 0.0;
      const double mu =
          contact::friction_at(table, {.place = {}, .pressure = was / 1e-4}).coefficient;
      const double shear = s.solution.force.segment<2>(row + 1).norm();
      EXPECT_LE(shear, mu * normal * (1.0 + 1e-9)) << k << " " << j;
      if (s.solution.status[j].status != Status::slip) continue;
      EXPECT_NEAR(shear, mu * normal, 1e-9 * normal) << k << " " << j;
      least = std::min(least, mu);
      most = std::max(most, mu);
    }
  }
  EXPECT_GT(most, 1.3 * least);
}

TEST(Standing, FindsTheStatesOfABodyWithAnotherPartOfForces) {
  test::SteadyWheel w(standing_case());
  StandingWheel linear(w.harmonics, 0.03, 0.3, nullptr);
  w.harmonics.keep_factors();
  Stiffer remainder(w, 0.5);
  StandingWheel stiffer(w.harmonics, 0.03, 0.3, &remainder);
  for (const double depth : {2e-3, 4e-3, 1e-3}) {
    const RollingForces a = pressed(linear, {.depth = depth}).solution.forces;
    ASSERT_EQ(stiffer.press({.depth = depth}), RollingEnd::solved);
    const StandingState& s = stiffer.state();
    EXPECT_LE(s.effort.residual, finite_rolling_bound);
    EXPECT_LE(s.effort.turns, 4);  // the tangent is exact
    EXPECT_LE(s.works.relative, 1e-11);
    const RollingForces& b = s.solution.forces;
    EXPECT_NEAR(b.normal, 1.5 * a.normal, 1e-6 * a.normal);
    EXPECT_NEAR(b.lateral, 1.5 * a.lateral, 1e-6 * a.normal);
    EXPECT_NEAR(s.works.strain, 1.5 * linear.state().works.strain,
                1e-6 * linear.state().works.strain);
  }
  EXPECT_NEAR(stiffer.state().works.internal, stiffer.state().works.strain,
              1e-6 * stiffer.state().works.strain);
}

}  // namespace standing_test
