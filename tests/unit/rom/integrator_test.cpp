// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/integrator.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "rondo/core/complex.hpp"
#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "whole_space.hpp"

namespace integrator_test {

using namespace rondo;
using namespace rondo::rom;
using namespace rondo::rom::test;

namespace {

using dynamics::Table;

MatrixXd system_matrix(const rom::ReducedModel& m, const StepMatrixKey& k) {
  const Index r = m.size();
  MatrixXd a = MatrixXd::Zero(2 * r, 2 * r);
  a.topLeftCorner(r, r) = k.spin * m.generator;
  a.topRightCorner(r, r).setIdentity();
  a.bottomLeftCorner(r, r) = k.spin * k.spin * MatrixXd::Identity(r, r) - m.stiffness;
  a.bottomRightCorner(r, r) = k.spin * m.generator - 2.0 * k.spin * m.turn -
                              k.mass_damping * MatrixXd::Identity(r, r) -
                              k.stiffness_damping * m.stiffness;
  return a;
}

TEST(MidpointStep, ConvergesToTheExactSolutionWithTheSquareOfTheStep) {
  const Reduced r = whole_space(rondo::test::rolling_disk(2, 9));
  StepMatrixKey key{
      .dt = 4e-5, .mass_damping = 50.0, .stiffness_damping = 1e-6, .carry = -300.0, .spin = -300.0};
  const Index n = 2 * r.model.size();
  // Soft shapes, so that the longer step resolves all that moves.
  VectorXd y0 = VectorXd::Zero(n);
  y0.head(n / 2) = r.model.stiffness.inverse() * r.model.translation.col(0);
  const double end = 1.6e-3;
  const VectorXd exact = (end * system_matrix(r.model, key)).exp() * y0;
  std::vector<double> errors;
  for (const int steps : {80, 160}) {
    key.dt = end / steps;
    StepMatrices matrices(r.model, key);
    const VectorXd no_push = VectorXd::Zero(n / 2);
    VectorXd y = y0;
    for (int k = 0; k < steps; ++k) {
      VectorXd q_end = no_push, p_end = no_push, carried = no_push;
      matrices.advance(y.head(n / 2), y.tail(n / 2), no_push, q_end, p_end, carried);
      y << q_end, p_end;
    }
    errors.push_back((y - exact).norm() / exact.norm());
  }
  EXPECT_LT(errors[0], 0.05);
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.2);  // the next term of the error is of fourth order
}

TEST(ReducedIntegrator, WithAllModesMovesAsTheFullModelDoes) {
  DiskCase c = rondo::test::rolling_disk(3, 24);
  c.motion.angular_velocity = Table({{0.0, 20.0}, {0.01, 220.0}});
  c.motion.speed = Table({{0.0, 4.0}, {0.01, 84.0}});
  c.motion.height = Table({{0.0, 0.4}, {0.01, 0.5}});
  c.motion.gravity = Table(50.0);
  c.beta = 0.0;  // which the full scheme takes half a step late: of first order
  std::vector<double> errors;
  for (const double safety : {0.4, 0.2}) {
    c.safety = safety;
    Reduced r = whole_space(c);
    dynamics::State state = rondo::test::start_at_rest(r.full.model);
    ReducedIntegrator reduced = r.start(state);
    dynamics::GeneralIntegrator full(r.full.model, state);
    const auto steps = static_cast<std::size_t>(0.004 / r.full.model.dt);
    std::vector<dynamics::StepReport> reports(steps);
    dynamics::State found(r.full.model);
    reduced.advance(reports, &found);
    std::vector<dynamics::StepReport> expected(steps);
    full.advance(expected, &state);
    ASSERT_EQ(found.step, state.step);
    errors.push_back(difference(state.u, found.u));
    EXPECT_LT(difference(state.v, found.v), 20.0 * errors.back());
    EXPECT_GT(r.figures.factored, static_cast<long long>(steps / 3));  // the spin changes
    EXPECT_LT(reports.back().balance.relative, 1e-12);
  }
  EXPECT_LT(errors[0], 2e-3);
  EXPECT_LT(errors[1], 0.3 * errors[0]);  // two schemes of second order
}

TEST(ReducedIntegrator, StaysInTheStationaryStateOfTheFullModel) {
  DiskCase c = rondo::test::rolling_disk(3, 24);
  c.motion.height = Table(1.0);
  c.motion.speed = Table(0.0);
  c.motion.angular_velocity = Table(80.0);
  Reduced r = whole_space(c);
  r.full.model.dt *= 20.0;
  const statics::StationarySpin spin = statics::stationary_spin(
      r.full.model.stiffness, r.full.model.mass, r.full.model.reference, r.full.model.free, -80.0);
  ASSERT_EQ(spin.status, statics::SpinStatus::solved);
  const std::vector<Vec2> zero(spin.u.size());
  ReducedIntegrator reduced = r.start(dynamics::start(r.full.model, spin.u, zero));
  std::vector<dynamics::StepReport> reports(500);
  dynamics::State found(r.full.model);
  reduced.advance(reports, &found);
  EXPECT_LT(difference(spin.u, found.u), 1e-11);  // round-off, times the condition of the step
  EXPECT_EQ(r.figures.factored, 1);
}

constexpr auto nodes = rom::ContactForm::nodes;
constexpr auto turning = rom::ModelFrame::turning;
constexpr auto central = StepScheme::central;

const std::array<Form, 8> every_form{{
    {.stride = 1},
    {.stride = 2},
    {.scheme = central, .stride = 1},
    {.scheme = central, .stride = 2},
    {.contact = nodes},
    {.contact = nodes, .scheme = central},
    {.contact = nodes, .frame = turning},
    {.contact = nodes, .frame = turning, .scheme = central},
}};

/// Steps to the same time.
std::size_t steps_of(const Form& form) {
  return form.scheme == central ? 1500 : 150;
}

TEST(ReducedIntegrator, ClosesItsLedgerInContact) {
  for (const Form& form : every_form) {
    SCOPED_TRACE(&form - every_form.data());
    Reduced r = pressed(form);
    ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
    std::vector<dynamics::StepReport> reports(steps_of(form));
    reduced.advance(reports);
    const dynamics::Balance& b = reports.back().balance;
    EXPECT_LT(b.relative, 1e-12);
    EXPECT_GT(b.works.dissipation_friction, 0.01 * b.exchanged);
    EXPECT_GT(b.works.dissipation_mass, 0.0);
    EXPECT_GT(b.works.dissipation_stiffness, 0.0);
    EXPECT_LT(std::abs(b.works.scheme), 1e-12 * b.exchanged);  // the whole space has K D skew
    EXPECT_NEAR(b.works.contact, b.works.rim - b.works.dissipation_friction - b.works.loss_impact,
                1e-12 * b.exchanged);
    EXPECT_GT(r.figures.contact_steps, 50);
  }
}

TEST(ReducedIntegrator, ClosesItsLedgerWithFewerModes) {
  for (const Form& form : every_form) {
    if (form.frame == turning) continue;  // nothing is carried there
    SCOPED_TRACE(&form - every_form.data());
    Reduced r = pressed(form, 5);
    ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
    std::vector<dynamics::StepReport> reports(steps_of(form));
    reduced.advance(reports);
    const dynamics::Balance& b = reports.back().balance;
    EXPECT_LT(b.relative, 1e-12);
    EXPECT_GT(std::abs(b.works.scheme), 1e-6 * b.exchanged);  // modes without D of themselves
  }
}

/// Nodes that come by, seen at half steps as the full run sees them: no impulse does work on them.
TEST(ReducedIntegrator, EnergySafeImpactsOfNodesTakeEnergy) {
  for (const Form& form : every_form) {
    if (form.contact != nodes || form.scheme != central) continue;
    SCOPED_TRACE(&form - every_form.data());
    Reduced r = pressed(form);
    r.full.model.contact->law.restitution = 0.5;
    r.full.model.contact->law.impact = contact::Impact::energy_safe;
    ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
    std::vector<dynamics::StepReport> reports(steps_of(form));
    reduced.advance(reports);
    double least = 0.0;
    for (const dynamics::StepReport& step : reports)
      least = std::min(least, step.balance.works.loss_impact);
    const dynamics::Balance& b = reports.back().balance;
    EXPECT_GT(least, -1e-6 * b.exchanged);
    EXPECT_GT(b.works.loss_impact, 0.0);
    EXPECT_LT(b.relative, 1e-12);
  }
}

/// The law anew from the motion alone, without the Delassus blocks.
TEST(ReducedIntegrator, ObeysTheLawInTheMotionItMakes) {
  for (const int stride : {1, 2}) {
    Reduced r = pressed({.stride = stride});
    r.full.model.contact->law.restitution = 0.0;
    ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
    const rom::ReducedModel& m = r.model;
    const dynamics::Motion& motion = r.full.model.motion;
    const double dt = r.full.model.dt, friction = r.full.model.contact->law.friction.constant();
    int pressed = 0, slipping = 0;
    for (int k = 0; k < 300; ++k) {
      const double t = k * dt, end = (k + 1) * dt, spin = motion.turn(t, dt) / dt;
      const VectorXd before = m.contact.rows * reduced.displacement();
      dynamics::StepReport report;
      reduced.advance({&report, 1});
      const VectorXd u = m.contact.rows * reduced.displacement(),
                     v = m.contact.rows * reduced.velocity();
      const VectorXd carried = m.contact.rows * (m.generator * reduced.displacement());
      const auto at = [](const VectorXd& rows, int point) {
        return Vec2{rows[2 * point], rows[2 * point + 1]};
      };
      const Vec2 center_rate{motion.speed.at(end), motion.height.slope(end)};
      for (const PointContact& c : reduced.contacts()) {
        const Vec2 arm = m.contact.points[static_cast<std::size_t>(c.point)] + at(u, c.point);
        const Vec2 moved = motion.advance(t, dt).plane() + at(u, c.point) - at(before, c.point);
        // c.gap is that of the free step: the facet is found from its place there.
        const Vec2 place = motion.center(end).plane() + arm;
        const double gap = r.full.model.contact->ground.distance(place);
        const double gap_before = gap - dot(c.normal, moved);
        const double opening =
            dot(c.normal, center_rate + at(v, c.point) + spin * at(carried, c.point));
        const double slip =
            dot(turn90(c.normal), center_rate + spin * turn90(arm) + at(v, c.point));
        EXPECT_GE(c.impulse.x, 0.0);
        EXPECT_LE(std::abs(c.impulse.y), friction * c.impulse.x * (1.0 + 1e-12));
        if (c.impulse.x <= 0.0) continue;
        ++pressed;
        // On facets alone: the fillet's normal turns with the place.
        const bool flat = std::abs(c.normal.x) < 1e-15;
        if (flat) {
          EXPECT_NEAR(opening + gap_before / dt, 0.0, 1e-8) << "step " << k;
        }
        if (c.status == contact::Status::stick) {
          if (flat) {
            EXPECT_NEAR(slip, 0.0, 1e-8) << "step " << k;
          }
        } else {
          ++slipping;
          EXPECT_LE(slip * c.impulse.y, 0.0);
        }
      }
    }
    EXPECT_GT(pressed, 200);  // it was in contact, one way and the other
    EXPECT_GT(slipping, 30);
  }
}

/// The same for nodes, whose motion is that of the lifted fields.
TEST(ReducedIntegrator, ObeysTheLawAtTheNodesThatComeBy) {
  for (const rom::ModelFrame frame : {rom::ModelFrame::rectified, turning}) {
    SCOPED_TRACE(frame == turning);
    Reduced r = pressed({.contact = nodes, .frame = frame});
    r.full.model.contact->law.restitution = 0.0;
    ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
    const dynamics::Motion& motion = r.full.model.motion;
    const double dt = r.full.model.dt, friction = r.full.model.contact->law.friction.constant();
    dynamics::State before(r.full.model), after(r.full.model), found(r.full.model);
    reduced.fields(before);
    int pressed = 0, slipping = 0;
    for (int k = 0; k < 300; ++k) {
      const double t = k * dt, end = (k + 1) * dt, spin = motion.turn(t, dt) / dt;
      dynamics::StepReport report;
      reduced.advance({&report, 1}, &found);
      reduced.fields(after);
      const Complex turned = rotation(motion.angle(end)), earlier = rotation(motion.angle(t));
      const Vec2 center_rate{motion.speed.at(end), motion.height.slope(end)};
      Vec2 sum;
      for (const dynamics::ActiveContact& c : found.active) {
        const auto node = static_cast<std::size_t>(r.full.mesh.boundary[c.candidate]);
        const Vec2 x = r.full.mesh.coordinates[node];
        const Vec2 arm = turned * (x + after.u.plane()[node]),
                   arm_before = earlier * (x + before.u.plane()[node]);
        const double gap = r.full.model.contact->ground.distance(motion.center(end).plane() + arm);
        const Vec2 moved = motion.advance(t, dt).plane() + arm - arm_before;
        const Vec2 w = center_rate + spin * turn90(arm) + turned * after.v_next.plane()[node];
        sum += from_frame(c.normal, c.impulse.plane());
        EXPECT_GT(c.impulse.x, 0.0);
        EXPECT_LE(std::abs(c.impulse.y), friction * c.impulse.x * (1.0 + 1e-12));
        ++pressed;
        if (std::abs(c.normal.x) > 1e-15) continue;  // the fillet's normal turns with the place
        EXPECT_NEAR(dot(c.normal, w) + (gap - dot(c.normal, moved)) / dt, 0.0, 1e-8) << k;
        const double slip = dot(turn90(c.normal), w);
        if (c.status == contact::Status::stick) {
          EXPECT_NEAR(slip, 0.0, 1e-8) << k;
        } else {
          ++slipping;
          EXPECT_LE(slip * c.impulse.y, 0.0);
        }
      }
      EXPECT_NEAR(norm(sum - report.contact.impulse), 0.0, 1e-12 * norm(sum) + 1e-15);
      std::swap(before.u, after.u);
    }
    EXPECT_GT(pressed, 200);
    EXPECT_GT(slipping, 30);
  }
}

/// With all modes, the turning frame and central differences it is the full model's scheme, to
/// round-off.
TEST(ReducedIntegrator, CentralDifferencesInTheTurningFrameAreTheFullScheme) {
  DiskCase c = rondo::test::rolling_disk(3, 24);
  c.motion.angular_velocity = Table({{0.0, 20.0}, {0.01, 220.0}});
  c.motion.speed = Table({{0.0, 4.0}, {0.01, 84.0}});
  c.motion.height = Table({{0.0, 0.4}, {0.01, 0.5}});
  c.motion.gravity = Table(50.0);
  for (const rom::ModelFrame frame : {turning, rom::ModelFrame::rectified}) {
    Reduced r = whole_space(c, {.contact = nodes, .frame = frame, .scheme = central});
    dynamics::State state = rondo::test::start_at_rest(r.full.model);
    ReducedIntegrator reduced = r.start(state);
    dynamics::GeneralIntegrator full(r.full.model, state);
    std::vector<dynamics::StepReport> reports(400), expected(400);
    dynamics::State found(r.full.model);
    reduced.advance(reports, &found);
    full.advance(expected, &state);
    // Fields are carried by Cayley's turn, off by (s Δt k)³/12 in each step at harmonic k <= 12.
    const double bound = frame == turning ? 1e-10 : 1e-3;
    EXPECT_LT(difference(state.u, found.u), bound);
    EXPECT_LT(difference(state.v, found.v), bound);
  }
}

TEST(ReducedIntegrator, CentralDifferencesAtNodesAreTheFullSchemeInContact) {
  Reduced r = pressed({.contact = nodes, .frame = turning, .scheme = central});
  dynamics::State state = rondo::test::start_at_rest(r.full.model);
  ReducedIntegrator reduced = r.start(state);
  dynamics::GeneralIntegrator steps(r.full.model, state);
  std::vector<dynamics::StepReport> reports(1500), expected(1500);
  dynamics::State found(r.full.model);
  reduced.advance(reports, &found);
  steps.advance(expected, &state);
  int contacts = 0;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const dynamics::StepReport& report = reports[i];
    const dynamics::ContactReport& full = expected[i].contact;
    ASSERT_EQ(full.nodes, report.contact.nodes) << report.step;
    contacts += full.nodes;
    // A touch that comes with round-off may come a step later: none does here.
    EXPECT_NEAR(norm(full.impulse - report.contact.impulse), 0.0, 1e-8 * norm(full.impulse));
    EXPECT_NEAR(full.penetration, report.contact.penetration, 1e-12);
  }
  EXPECT_GT(contacts, 1000);
  EXPECT_LT(difference(state.u, found.u), 1e-9);
  EXPECT_LT(difference(state.v, found.v), 1e-9);
}

double some_law(const contact::SlidingState& s) {
  return 0.2 + 0.1 * std::sin(40.0 * s.place.x) + 0.01 * s.slip + 2e-7 * s.pressure;
}

TEST(ReducedIntegrator, AsksAFrictionLawAsTheFullSchemeDoes) {
  Reduced r = pressed({.contact = nodes, .frame = turning, .scheme = central});
  rondo::test::add_ground(r.full, {}, {contact::Friction(some_law), 0.0});
  dynamics::State state = rondo::test::start_at_rest(r.full.model);
  ReducedIntegrator reduced = r.start(state);
  dynamics::GeneralIntegrator steps(r.full.model, state);
  std::vector<dynamics::StepReport> reports(1500), expected(1500);
  reduced.advance(reports);
  steps.advance(expected);
  int contacts = 0, sliding = 0;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const dynamics::ContactReport& full = expected[i].contact;
    ASSERT_EQ(full.nodes, reports[i].contact.nodes) << i;
    contacts += full.nodes;
    sliding += full.nodes - full.sticking;
    EXPECT_NEAR(norm(full.impulse - reports[i].contact.impulse), 0.0, 1e-8 * norm(full.impulse));
  }
  EXPECT_GT(contacts, 1000);
  EXPECT_GT(sliding, 100);
}

/// With points that stand still: |r_t| = μ r_n where they slide, μ that of the place, the slip and
/// the impulse before the step.
TEST(ReducedIntegrator, AsksAFrictionLawAtPointsThatStandStill) {
  Reduced r = pressed({});
  rondo::test::add_ground(r.full, {}, {contact::Friction(some_law), 0.0});
  ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
  const rom::ContactRows& points = r.model.contact;
  const dynamics::Motion& motion = r.full.model.motion;
  const double dt = r.full.model.dt;
  std::vector<double> impulse(points.points.size());
  int sliding = 0;
  for (int k = 0; k < 300; ++k) {
    const double t = k * dt, spin = motion.turn(t, dt) / dt;
    const VectorXd u = points.rows * reduced.displacement(), v = points.rows * reduced.velocity();
    dynamics::StepReport report;
    reduced.advance({&report, 1});
    std::vector<double> now(impulse.size());
    for (const PointContact& c : reduced.contacts()) {
      const auto i = static_cast<std::size_t>(c.point);
      const Vec2 arm = points.points[i] + Vec2{u[2 * c.point], u[2 * c.point + 1]};
      const double slip =
          motion.speed.at(t) + (spin * turn90(arm) + Vec2{v[2 * c.point], v[2 * c.point + 1]}).x;
      const double mu = some_law(
          {motion.center(t).plane() + arm, std::abs(slip), impulse[i] / (dt * points.share[i])});
      now[i] = c.impulse.x;
      if (c.status != contact::Status::slip) continue;
      EXPECT_NEAR(std::abs(c.impulse.y), mu * c.impulse.x, 1e-10 * c.impulse.x) << k;
      sliding += impulse[i] > 0.0 ? 1 : 0;
    }
    impulse = std::move(now);
  }
  EXPECT_GT(sliding, 30);
}

Vec2 impulse_of(const Form& form) {
  Reduced r = pressed(form);
  r.full.model.contact->law.restitution = 0.0;
  ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
  std::vector<dynamics::StepReport> reports(2 * steps_of(form));
  reduced.advance(reports);
  Vec2 sum;
  for (const dynamics::StepReport& report : reports) sum += report.contact.impulse.plane();
  return sum;
}

/// All forms of contact come near that of the full scheme: here, impulses over a time.
TEST(ReducedIntegrator, EveryFormPressesAsTheFullModelDoes) {
  const Vec2 expected = impulse_of(every_form.back());
  for (const Form& form : every_form) {
    if (form.stride != 1) continue;
    SCOPED_TRACE(&form - every_form.data());
    // Longer steps, and places instead of nodes, change when contacts begin and end: the contact
    // spans six columns.
    EXPECT_LT(norm(impulse_of(form) - expected), 0.05 * norm(expected));
  }
}

TEST(ReducedIntegrator, GivesItsImpulsesToTheNodes) {
  for (const int stride : {1, 2}) {
    Reduced r = pressed({.stride = stride});
    ReducedIntegrator reduced = r.start(rondo::test::start_at_rest(r.full.model));
    std::vector<dynamics::StepReport> reports(250);
    dynamics::State state(r.full.model);
    reduced.advance(reports, &state);
    ASSERT_GT(reports.back().contact.nodes, 0);
    Vec2 sum;
    double moment = 0.0;
    for (const dynamics::ActiveContact& c : state.active) {
      EXPECT_GE(c.impulse.x, 0.0);
      const auto node = static_cast<std::size_t>(r.full.mesh.boundary[c.candidate]);
      const Vec2 impulse = from_frame(c.normal, c.impulse.plane());
      sum += impulse;
      moment += cross(position(r.full.model, state, node) - state.frame.center.plane(), impulse);
    }
    // The nodes are where the point is: the mean of a hat that spans 15 degrees lies 1 % inside.
    EXPECT_NEAR(moment, reports.back().contact.angular_impulse, 0.02 * 0.3 * norm(sum));
    EXPECT_NEAR(sum.x, reports.back().contact.impulse.x, 1e-12 * norm(sum));
    EXPECT_NEAR(sum.y, reports.back().contact.impulse.y, 1e-12 * norm(sum));
  }
}

}  // namespace

}  // namespace integrator_test
