// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/reduced/integrator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "support/models.hpp"

using namespace rondo;
using namespace rondo::reduced;

namespace {

using dynamics::Table;

struct Reduced {
  test::Built full;
  reduction::ReducedModel model;
  StepFigures figures;

  [[nodiscard]] ReducedIntegrator start(const dynamics::State& state) {
    return {IntegratorInput{full.mesh, full.model, model, figures}, state};
  }
};

/// The whole space of a small disk as modes: what is reduced is then the frame and the step only.
/// @param left_out every so-manieth column of it; 0: none
Reduced whole_space(const test::DiskCase& c, int stride = 1, Index left_out = 0) {
  Reduced r{test::build(c), {}, {}};
  const auto sector = fem::assemble_sector(r.full.mesh, {&c.material, 1});
  const auto n = static_cast<Index>(r.full.model.free.size());
  const Index columns = 2 * n - (left_out > 0 ? 2 * n / left_out : 0);
  MatrixXd basis = MatrixXd::Zero(static_cast<Index>(2 * r.full.mesh.n_nodes()), columns);
  for (Index k = 0, column = 0; k < 2 * n; ++k)
    if (left_out == 0 || (k + 1) % left_out != 0)
      basis(2 * r.full.model.free[static_cast<std::size_t>(k / 2)] + k % 2, column++) = 1.0;
  r.model = reduction::make_reduced_model(
      {r.full.mesh, r.full.model.mass,
       [&](std::span<const Vec2> in, std::span<Vec2> out) { fem::apply(sector, in, out); }},
      basis, stride);
  return r;
}

double difference(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double sum = 0.0, all = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += dot(a[i] - b[i], a[i] - b[i]);
    all += dot(a[i], a[i]);
  }
  return std::sqrt(sum / all);
}

MatrixXd system_matrix(const reduction::ReducedModel& m, const StepMatrixKey& k) {
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
  const Reduced r = whole_space(test::rolling_disk(2, 9));
  StepMatrixKey key{.dt = 4e-5, .mass_damping = 50.0, .stiffness_damping = 1e-6, .spin = -300.0};
  const Index n = 2 * r.model.size();
  // Soft shapes, so that the longer step resolves all that moves.
  VectorXd y0 = VectorXd::Zero(n);
  y0.head(n / 2) = r.model.stiffness.inverse() * r.model.translation.col(0);
  const double end = 1.6e-3;
  const VectorXd exact = (end * system_matrix(r.model, key)).exp() * y0;
  std::vector<double> errors;
  for (const int steps : {80, 160}) {
    key.dt = end / steps;
    const SpinMatrices matrices(r.model, key);
    VectorXd y = y0;
    for (int k = 0; k < steps; ++k) y = 2.0 * (matrices.inverse() * y) - y;
    errors.push_back((y - exact).norm() / exact.norm());
  }
  EXPECT_LT(errors[0], 0.05);
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.2);  // the next term of the error is of fourth order
}

TEST(ReducedIntegrator, WithAllModesMovesAsTheFullModelDoes) {
  test::DiskCase c = test::rolling_disk(3, 24);
  c.motion.angular_velocity = Table({{0.0, 20.0}, {0.01, 220.0}});
  c.motion.speed = Table({{0.0, 4.0}, {0.01, 84.0}});
  c.motion.height = Table({{0.0, 0.4}, {0.01, 0.5}});
  c.motion.gravity = Table(50.0);
  c.beta = 0.0;  // which the full scheme takes half a step late: of first order
  std::vector<double> errors;
  for (const double safety : {0.4, 0.2}) {
    c.safety = safety;
    Reduced r = whole_space(c);
    dynamics::State state = test::start_at_rest(r.full.model);
    ReducedIntegrator reduced = r.start(state);
    dynamics::Ledger ledger;
    const auto steps = static_cast<std::size_t>(0.004 / r.full.model.dt);
    std::vector<dynamics::StepReport> reports(steps);
    dynamics::State found(r.full.model);
    reduced.advance(reports, &found);
    for (std::size_t k = 0; k < steps; ++k)
      static_cast<void>(dynamics::advance(r.full.model, state, ledger));
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
  test::DiskCase c = test::rolling_disk(3, 24);
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

/// A disk that is pressed on a ledge with both dampings while its spin changes.
Reduced pressed(int stride, Index left_out = 0) {
  test::DiskCase c = test::rolling_disk(3, 48);
  c.motion.start_x = -0.1;
  c.motion.angular_velocity = Table({{0.0, 33.0}, {0.005, 36.0}});
  c.motion.height = Table({{0.0, 0.3}, {0.01, 0.29}});
  Reduced r = whole_space(c, stride, left_out);
  test::add_ground(r.full, test::ledge(), {0.4, 0.2});
  r.full.model.dt *= 10.0;
  return r;
}

TEST(ReducedIntegrator, ClosesItsLedgerInContact) {
  for (const int stride : {1, 2}) {
    Reduced r = pressed(stride);
    ReducedIntegrator reduced = r.start(test::start_at_rest(r.full.model));
    std::vector<dynamics::StepReport> reports(300);
    reduced.advance(reports);
    const dynamics::Balance& b = reports.back().balance;
    EXPECT_LT(b.relative, 1e-12);
    EXPECT_GT(b.works.dissipation_friction, 0.01 * b.exchanged);
    EXPECT_GT(b.works.dissipation_mass, 0.0);
    EXPECT_GT(b.works.dissipation_stiffness, 0.0);
    EXPECT_NEAR(b.works.contact, b.works.rim - b.works.dissipation_friction - b.works.loss_impact,
                1e-12 * b.exchanged);
    EXPECT_GT(r.figures.contact_steps, 100);
  }
}

TEST(ReducedIntegrator, ClosesItsLedgerWithFewerModes) {
  Reduced r = pressed(1, 5);
  ReducedIntegrator reduced = r.start(test::start_at_rest(r.full.model));
  std::vector<dynamics::StepReport> reports(300);
  reduced.advance(reports);
  const dynamics::Balance& b = reports.back().balance;
  EXPECT_LT(b.relative, 1e-12);
  EXPECT_GT(std::abs(b.works.scheme), 1e-6 * b.exchanged);  // the modes do not hold D of themselves
}

/// The law anew from the motion alone, without the Delassus blocks.
TEST(ReducedIntegrator, ObeysTheLawInTheMotionItMakes) {
  for (const int stride : {1, 2}) {
    Reduced r = pressed(stride);
    r.full.model.contact->law.restitution = 0.0;
    ReducedIntegrator reduced = r.start(test::start_at_rest(r.full.model));
    const reduction::ReducedModel& m = r.model;
    const dynamics::Motion& motion = r.full.model.motion;
    const double dt = r.full.model.dt, friction = r.full.model.contact->law.friction;
    int pressed = 0, slipping = 0;
    for (int k = 0; k < 300; ++k) {
      const double t = k * dt, end = (k + 1) * dt, spin = motion.turn(t, dt) / dt;
      const VectorXd before = m.rows * reduced.displacement();
      dynamics::StepReport report;
      reduced.advance({&report, 1});
      const VectorXd u = m.rows * reduced.displacement(), v = m.rows * reduced.velocity();
      const VectorXd carried = m.rows * (m.generator * reduced.displacement());
      const auto at = [](const VectorXd& rows, int point) {
        return Vec2{rows[2 * point], rows[2 * point + 1]};
      };
      const Vec2 center_rate{motion.speed.at(end), motion.height.slope(end)};
      for (const PointContact& c : reduced.contacts()) {
        const Vec2 arm = m.contact_points[static_cast<std::size_t>(c.point)] + at(u, c.point);
        const Vec2 moved = motion.advance(t, dt) + at(u, c.point) - at(before, c.point);
        // c.gap is that of the free step: the facet is found from its place there.
        const Vec2 place = motion.center(end) + arm;
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

TEST(ReducedIntegrator, GivesItsImpulsesToTheNodes) {
  for (const int stride : {1, 2}) {
    Reduced r = pressed(stride);
    ReducedIntegrator reduced = r.start(test::start_at_rest(r.full.model));
    std::vector<dynamics::StepReport> reports(250);
    dynamics::State state(r.full.model);
    reduced.advance(reports, &state);
    ASSERT_GT(reports.back().contact.nodes, 0);
    Vec2 sum;
    double moment = 0.0;
    for (const dynamics::ActiveContact& c : state.active) {
      EXPECT_GE(c.impulse.x, 0.0);
      const auto node = static_cast<std::size_t>(r.full.mesh.boundary[c.candidate]);
      const Vec2 impulse = c.normal * c.impulse;
      sum += impulse;
      moment += cross(position(r.full.model, state, node) - state.frame.center, impulse);
    }
    // The nodes are where the point is: the mean of a hat that spans 15 degrees lies 1 % inside.
    EXPECT_NEAR(moment, reports.back().contact.angular_impulse, 0.02 * 0.3 * norm(sum));
    EXPECT_NEAR(sum.x, reports.back().contact.impulse.x, 1e-12 * norm(sum));
    EXPECT_NEAR(sum.y, reports.back().contact.impulse.y, 1e-12 * norm(sum));
  }
}

}  // namespace
