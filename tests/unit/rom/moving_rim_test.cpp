// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <cmath>

#include "rondo/integrators/general/wheel_integrator.hpp"
#include "rondo/rom/integrator.hpp"
#include "whole_space.hpp"

namespace moving_rim_test {

using namespace rondo;
using namespace rondo::rom;
using namespace rondo::rom::test;

namespace {

using dynamics::RimBody;
using dynamics::Table;

RimBody all_free() {
  RimBody rim;
  rim.free_x = rim.free_y = rim.free_spin = true;
  rim.mass = 60.0;
  rim.inertia = 1.0;
  return rim;
}

/// @param left_out as whole_space()
Reduced on_rim(const DiskCase& c, const RimBody& rim, Form form = {}, Index left_out = 0) {
  Reduced r = whole_space(c, form, left_out);
  rondo::test::set_rim(r.full, rim);
  r.model.rim = make_rim_modes(r.full.mesh, r.full.model.mass, r.model);
  return r;
}

/// Pressed on the ledge by a load, with all that a rim may have.
Reduced loaded(Form form = {}, Index left_out = 0) {
  DiskCase c = rondo::test::rolling_disk(2, 48);
  c.motion.start_x = -0.1;
  c.motion.height = Table(0.3);
  c.motion.gravity = Table(9.81);
  c.motion.slope = 0.1;
  RimBody rim = all_free();
  rim.force_y = Table({{0.0, 0.0}, {0.005, -1.5e5}});
  rim.force_x = Table({{0.0, 2e4}, {0.01, -1e4}});
  rim.torque = Table({{0.0, 0.0}, {0.01, 2e4}});
  rim.brake = Table({{0.0, 0.0}, {0.01, 5e3}});
  rim.support_x = {2e4, 1e3, 0.1};
  rim.support_y = {1e5, 4e4, 0.31};
  Reduced r = on_rim(c, rim, form, left_out);
  rondo::test::add_ground(r.full, rondo::test::ledge(), {0.4, 0.2});
  r.full.model.dt *= 10.0;
  return r;
}

/// What a step begins with.
struct Now {
  VectorXd q, p;
  Eigen::Vector3d v;  ///< ċ, s
  Vec2 center;
};

/// u of J: (x, y) -> (-y, x), in the momenta of the modes.
MatrixXd turned(const MatrixXd& translation) {
  MatrixXd out(translation.rows(), 2);
  out << -translation.col(1), translation.col(0);
  return out;
}

/// (R.8) as one dense system in (q̄, p̄, ċ̄, s̄), line by line. @param before the state a step
/// earlier, @param sa s_A, @param late what that step left (R.9)
VectorXd dense_step(const dynamics::Model& full, const ReducedModel& m, double t, const Now& now,
                    const Now& before, double sa, const VectorXd& late) {
  const Index r = m.size();
  const double dt = full.dt, h = 0.5 * dt, alpha = full.mass_damping;
  const VectorXd qa = 1.5 * now.q - 0.5 * before.q;
  const MatrixXd &K = m.stiffness, &D = m.generator, &J = m.turn, &E = m.translation;
  const MatrixXd T = turned(E), one = MatrixXd::Identity(r, r);
  const VectorXd j = m.turned_reference + J * qa, x = m.reference + qa,
                 f = m.reference + m.rim->carried_turn * qa + qa;
  const RimBody& rim = *full.rim;
  const double mass = rim.mass + m.rim->mass;
  const double inertia = rim.inertia + m.rim->inertia + 2.0 * m.reference.dot(qa) + qa.dot(qa);
  const Vec2 gravity = full.motion.gravity_at(t + h);
  const Eigen::Vector2d g(gravity.x, gravity.y), a = T.transpose() * qa;
  MatrixXd lhs = MatrixXd::Zero(2 * r + 3, 2 * r + 3);
  VectorXd rhs = VectorXd::Zero(2 * r + 3);
  lhs.topLeftCorner(r, r) = one - h * sa * m.rim->carry;
  lhs.block(0, r, r, r) = -h * one;
  rhs.head(r) = now.q;
  // The modes.
  lhs.block(r, 0, r, r) = 2.0 * sa * J + dt * K;
  lhs.block(r, r, r, r) =
      (2.0 + dt * alpha) * one - dt * sa * (D - J) + dt * full.stiffness_damping * K;
  lhs.block(r, 2 * r, r, 2) = 2.0 * E;
  lhs.block(r, 2 * r + 2, r, 1) = 2.0 * j - dt * sa * f;
  rhs.segment(r, r) = 2.0 * now.p + 2.0 * E * now.v.head(2) + 2.0 * now.v[2] * j +
                      2.0 * sa * J * now.q - J * late + dt * E * g;
  // The center.
  lhs.block(2 * r, 0, 2, r) = 2.0 * sa * T.transpose();
  lhs.block(2 * r, r, 2, r) = 2.0 * E.transpose();
  lhs.block(2 * r, 2 * r + 2, 2, 1) = 2.0 * a;
  const auto mean = [&](const Table& table) { return table.integral(t, dt) / dt; };
  const Eigen::Vector2d load(mean(rim.force_x), mean(rim.force_y));
  rhs.segment(2 * r, 2) = 2.0 * (mass * now.v.head(2) + E.transpose() * now.p + a * now.v[2] +
                                 sa * T.transpose() * now.q) -
                          T.transpose() * late + dt * (load + mass * g);
  const dynamics::RimSupport* supports[] = {&rim.support_x, &rim.support_y};
  const double place[] = {now.center.x, now.center.y};
  for (Index k = 0; k < 2; ++k) {
    const dynamics::RimSupport& s = *supports[k];
    lhs(2 * r + k, 2 * r + k) = 2.0 * mass + dt * (h * s.stiffness + s.damping);
    rhs[2 * r + k] -= dt * s.stiffness * (place[k] - s.at);
  }
  // The spin.
  lhs.block(2 * r + 2, 0, 1, r) = 2.0 * sa * x.transpose();
  lhs.block(2 * r + 2, r, 1, r) = (2.0 * j + dt * sa * f).transpose();
  lhs.block(2 * r + 2, 2 * r, 1, 2) = 2.0 * a.transpose();
  lhs(2 * r + 2, 2 * r + 2) = 2.0 * inertia;
  rhs[2 * r + 2] =
      2.0 * (inertia * now.v[2] + a.dot(now.v.head(2)) + j.dot(now.p) + sa * x.dot(now.q)) -
      x.dot(late) + dt * (a.dot(g) - mean(rim.torque));
  return lhs.partialPivLu().solve(rhs);
}

/// s_A, from that of the step before.
double matrix_spin(const Now& before, const Now& now, double last) {
  const double ahead = 1.5 * now.v[2] - 0.5 * before.v[2];
  return std::abs(ahead - last) <= same_spin * std::abs(ahead) ? last : ahead;
}

/// z: what the step from `now` to `next` leaves to the one after.
VectorXd left_over(const Now& before, const Now& now, const Now& next, double sa) {
  const VectorXd qa = 1.5 * now.q - 0.5 * before.q;
  return (0.5 * (now.v[2] + next.v[2]) - sa) * (next.q - now.q) +
         (next.v[2] - now.v[2]) * (0.5 * (now.q + next.q) - qa);
}

Now state_of(const ReducedIntegrator& reduced, const dynamics::StepReport& report) {
  return {reduced.displacement(),
          reduced.velocity(),
          {report.rim.velocity.x, report.rim.velocity.y, -report.rim.spin},
          report.frame.center.plane()};
}

TEST(MovingRim, BordersTheStepAsTheDenseEquationsSay) {
  for (const Index left_out : {0, 5}) {
    Reduced r = loaded({}, left_out);
    r.full.model.contact.reset();
    r.full.model.rim->brake = Table(0.0);
    ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
    dynamics::StepReport report;
    reduced.advance({&report, 1});
    Now before = state_of(reduced, report);
    reduced.advance({&report, 1});
    Now now = state_of(reduced, report);
    VectorXd late = VectorXd::Zero(now.q.size());
    const double spin = -33.333333;
    double sa = matrix_spin({{}, {}, {10.0, 0.0, spin}, {}}, before, spin);
    for (int k = 2; k < 40; ++k) {
      sa = matrix_spin(before, now, sa);
      const double dt = r.full.model.dt;
      const Index n = now.q.size();
      reduced.advance({&report, 1});
      const Now next = state_of(reduced, report);
      if (k > 2) {  // what the second step left is not known here
        const VectorXd mean = dense_step(r.full.model, r.model, k * dt, now, before, sa, late);
        const double spun = std::abs(now.v[2]) * r.model.turned_reference.norm();
        EXPECT_LT((2.0 * mean.head(n) - now.q - next.q).norm(), 1e-11 * next.q.norm());
        EXPECT_LT((2.0 * mean.segment(n, n) - now.p - next.p).norm(), 1e-11 * spun);
        EXPECT_LT((2.0 * mean.tail(3) - now.v - next.v).norm(), 1e-12 * next.v.norm());
      }
      late = left_over(before, now, next, sa);
      before = now;
      now = next;
    }
    EXPECT_GT(late.norm(), 0.0);
  }
}

TEST(MovingRim, ClosesTheLedgerWithAllThatMovesIt) {
  for (const auto contact : {ContactForm::places, ContactForm::nodes})
    for (const Index left_out : {0, 5}) {
      Reduced r = loaded({.contact = contact}, left_out);
      ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
      std::vector<dynamics::StepReport> reports(300);
      reduced.advance(reports);
      const dynamics::Balance& b = reports.back().balance;
      const dynamics::Works& w = b.works;
      EXPECT_LT(b.relative, 1e-12);
      for (const double work : {w.gravity, w.rim_load, w.torque, w.dissipation_brake,
                                w.dissipation_support, w.dissipation_friction, b.support})
        EXPECT_GT(std::abs(work), 1e-6 * b.exchanged);
      EXPECT_EQ(w.held, 0.0);
      EXPECT_EQ(w.frame, 0.0);
      EXPECT_LT(std::abs(w.scheme), 1e-3 * b.exchanged);
      EXPECT_GT(r.figures.contact_steps, 50);
    }
}

/// Two schemes of second order go to the same motion.
TEST(MovingRim, WithAllModesMovesAsTheFullModelDoes) {
  DiskCase c = rondo::test::rolling_disk(3, 24);
  c.beta = c.alpha = 0.0;  // which the full scheme takes half a step late
  c.motion.angular_velocity = Table(60.0);
  c.motion.gravity = Table(50.0);
  RimBody rim = all_free();
  rim.force_x = Table(2e5);
  rim.torque = Table(2e4);
  rim.support_y = {1e6, 0.0, 0.2};
  std::vector<double> errors, spins;
  for (const double safety : {0.4, 0.2}) {
    c.safety = safety;
    Reduced r = on_rim(c, rim);
    dynamics::State state = rondo::test::start_at_rest(r.full.model);
    ReducedIntegrator reduced = r.start(state);
    dynamics::WheelIntegrator full(r.full.model, state);
    const auto steps = static_cast<std::size_t>(0.004 / r.full.model.dt);
    std::vector<dynamics::StepReport> found(steps), expected(steps);
    dynamics::State last(r.full.model);
    reduced.advance(found, &last);
    full.advance(expected, &state);
    errors.push_back(difference(state.u, last.u));
    spins.push_back(std::abs(found.back().rim.spin - expected.back().rim.spin));
    EXPECT_LT(norm(found.back().frame.center - expected.back().frame.center), 1e-5);
    EXPECT_LT(found.back().balance.relative, 1e-12);
  }
  EXPECT_LT(errors[0], 0.02);
  EXPECT_LT(errors[1], 0.3 * errors[0]);
  EXPECT_LT(spins[1], 0.3 * spins[0] + 1e-6);
}

/// Momentum is that of rim and body, whatever the modes hold, but for what a step leaves to the
/// next.
TEST(MovingRim, KeepsItsMomentumInFlight) {
  DiskCase c = rondo::test::rolling_disk(2, 48);
  c.motion.height = Table(1.0);
  Reduced r = on_rim(c, all_free(), {}, 5);
  r.full.model.dt *= 10.0;
  const ReducedModel& m = r.model;
  const MatrixXd across = turned(m.translation).transpose();
  ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
  const double mass = r.full.model.rim->mass + m.rim->mass;
  Eigen::Vector2d first(mass * 10.0, 0.0);
  Now before, now;
  double sa = -33.333333;
  for (int k = 0; k < 2000; ++k) {
    dynamics::StepReport report;
    reduced.advance({&report, 1});
    const Now next = state_of(reduced, report);
    if (k > 1) {
      sa = matrix_spin(before, now, sa);
      const Eigen::Vector2d momentum =
          mass * next.v.head<2>() + m.translation.transpose() * next.p +
          next.v[2] * (across * next.q) - across * left_over(before, now, next, sa);
      ASSERT_LT((momentum - first).norm(), 1e-12 * first.norm()) << k;
    }
    before = now;
    now = next;
  }
}

/// The mean load is right by construction: the ground gives back what loads the rim.
TEST(MovingRim, RestsOnWhatItIsLoadedWith) {
  DiskCase c = rondo::test::rolling_disk(2, 48);
  c.motion.angular_velocity = c.motion.speed = Table(0.0);
  c.motion.height = Table(0.3);
  RimBody rim = all_free();
  rim.free_x = rim.free_spin = false;
  rim.force_y = Table({{0.0, 0.0}, {0.01, -1e5}});
  rim.support_y.damping = 6e4;
  Reduced r = on_rim(c, rim, {}, 5);
  rondo::test::add_ground(r.full, {.profile = {{-10, 0}, {10, 0}}}, {0.0, 0.0});
  r.full.model.dt *= 20.0;
  ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
  std::vector<dynamics::StepReport> reports(static_cast<std::size_t>(0.4 / r.full.model.dt));
  reduced.advance(reports);
  EXPECT_NEAR(reports.back().contact.impulse.y / r.full.model.dt, 1e5, 1.0);
  EXPECT_EQ(reports.back().frame.angle, 0.0);
  EXPECT_LT(reports.back().balance.relative, 1e-12);
}

/// The law anew from the motion alone: the rim moves with the impulses of the same step.
TEST(MovingRim, ObeysTheLawInTheMotionItMakes) {
  DiskCase c = rondo::test::rolling_disk(2, 48);
  c.motion.height = Table(0.3);
  RimBody rim = all_free();
  rim.free_spin = false;
  rim.force_y = Table({{0.0, 0.0}, {0.01, -1.5e5}});
  rim.support_y.damping = 4e4;
  Reduced r = on_rim(c, rim, {}, 5);
  rondo::test::add_ground(r.full, {.profile = {{-10, 0}, {10, 0}}}, {0.3, 0.0});
  r.full.model.dt *= 10.0;
  const ReducedModel& m = r.model;
  ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
  Vec2 center{-0.35, 0.3};
  int pressed = 0;
  for (int k = 0; k < 200; ++k) {
    const VectorXd before = m.contact.rows * reduced.displacement();
    dynamics::StepReport report;
    reduced.advance({&report, 1});
    const VectorXd rate =
        m.contact.rows * (reduced.velocity() - 33.333333 * (m.rim->carry * reduced.displacement()));
    for (const PointContact& contact : reduced.contacts()) {
      if (contact.impulse.x <= 0.0) continue;
      const Index row = 2 * contact.point + 1;
      const double gap =
          center.y + m.contact.points[static_cast<std::size_t>(contact.point)].y + before[row];
      EXPECT_NEAR(report.rim.velocity.y + rate[row] + gap / r.full.model.dt, 0.0, 1e-9) << k;
      ++pressed;
    }
    center = report.frame.center.plane();
  }
  EXPECT_GT(pressed, 100);
}

TEST(MovingRim, HeldTellsWhatHoldsIt) {
  Reduced held = loaded();
  held.full.model.contact.reset();
  RimBody& rim = *held.full.model.rim;
  rim.free_x = rim.free_y = rim.free_spin = false;
  rim.force_x = rim.force_y = rim.torque = rim.brake = Table(0.0);
  rim.support_x = rim.support_y = {};
  ReducedIntegrator reduced = held.start(rondo::test::start_at_rest(held.full.model));
  std::vector<dynamics::StepReport> reports(200);
  reduced.advance(reports);
  const dynamics::Balance& b = reports.back().balance;
  EXPECT_LT(b.relative, 1e-12);
  EXPECT_GT(std::abs(b.works.held), 1e-6 * b.exchanged);
  // Weight on a slope, and nothing else in the mean.
  Vec2 sum;
  for (const dynamics::StepReport& report : reports) sum += report.rim.force;
  const double weight = 9.81 * (rim.mass + held.model.rim->mass) * 200.0;
  EXPECT_NEAR(sum.x, -weight * std::sin(0.1), 0.1 * weight);
  EXPECT_NEAR(sum.y, weight * std::cos(0.1), 0.1 * weight);
}

TEST(MovingRim, BrakeStopsTheWheelAndKeepsIt) {
  Reduced r = loaded({}, 5);
  RimBody& rim = *r.full.model.rim;
  rim.torque = Table(0.0);
  rim.brake = Table({{0.0, 0.0}, {0.01, 0.0}, {0.03, 6e4}});
  r.full.model.dt *= 0.2;
  ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
  std::vector<dynamics::StepReport> reports(static_cast<std::size_t>(0.06 / r.full.model.dt));
  reduced.advance(reports);
  std::size_t locked = 0;
  while (locked < reports.size() && reports[locked].rim.spin != 0.0) ++locked;
  ASSERT_LT(locked, reports.size() - 20);
  for (std::size_t k = 0; k < reports.size(); ++k) {
    ASSERT_GE(reports[k].rim.spin, 0.0) << k;  // never reversed
    if (k > locked) {
      ASSERT_EQ(reports[k].frame.angle, reports[locked].frame.angle) << k;
    }
  }
  EXPECT_FALSE(std::signbit(reports.back().rim.spin));
  EXPECT_LT(reports.back().balance.relative, 1e-12);
}

}  // namespace

}  // namespace moving_rim_test
