// SPDX-License-Identifier: BSD-3-Clause
/// Steady rolling in three dimensions, part by part.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>

#include "support/solid_steady.hpp"

namespace steady_solid_test {

using namespace rondo;
using namespace rondo::statics;
using test::solved;

namespace {

test::SteadyWheelCase small_case(int samples = 2) {
  test::SteadyWheelCase c = test::box_wheel_case(samples);
  c.wheel = test::box_wheel(2, 3, 36);
  return c;
}

RollingOrder order(double rate, double turn) {
  return {{std::polar(1.0, -turn), 1.0, std::polar(1.0, turn)}, rate, -30.0, 200.0, 2e-5};
}

/// Z_k as a full matrix, by the definition.
Eigen::MatrixXcd full_matrix(const test::SteadyWheel& w, const RollingOrder& o) {
  const std::complex<double> i{0.0, 1.0}, elastic = 1.0 + i * (o.rate * o.stiffness_damping);
  const auto n = static_cast<Eigen::Index>(3 * w.sector.n_local());
  Eigen::MatrixXcd z = Eigen::MatrixXcd::Zero(n, n);
  for (std::size_t a = 0; a < w.sector.n_local(); ++a) {
    const auto row = static_cast<Eigen::Index>(3 * a);
    for (const auto& e : w.sector.row(a))
      z.block<3, 3>(row, 3 * e.column) += elastic * o.turns[static_cast<std::size_t>(e.shift + 1)] *
                                          Eigen::Map<const Eigen::Matrix3d>(e.block.data());
    const double m = w.mass[w.sector.node(a, 0)];
    for (Eigen::Index c = 0; c < 3; ++c)
      z(row + c, row + c) +=
          m * (-o.rate * o.rate + i * o.rate * o.mass_damping - (c < 2 ? o.spin * o.spin : 0.0));
    z(row, row + 1) -= 2.0 * i * o.rate * o.spin * m;
    z(row + 1, row) += 2.0 * i * o.rate * o.spin * m;
  }
  return z;
}

SolidRollingDrive drive() {
  SolidRollingDrive d;
  d.height = 0.29;
  d.speed = 10.0;
  d.slip_angle = 0.03;
  d.friction = 0.4;
  return d;
}

SolidWindow cambered(const test::SteadyWheel& w, double gravity = 0.0) {
  return {w.harmonics, SlipDifference::bdf2, 0.05, gravity};
}

void expect_near(const SolidRollingForces& a, const SolidRollingForces& b, double bound) {
  EXPECT_NEAR(a.normal, b.normal, bound);
  EXPECT_NEAR(a.heading, b.heading, bound);
  EXPECT_NEAR(a.lateral, b.lateral, bound);
  EXPECT_NEAR(a.torque, b.torque, bound);
  EXPECT_NEAR(a.aligning, b.aligning, bound);
  EXPECT_NEAR(a.overturning, b.overturning, bound);
}

SolidRollingForces difference(const SolidRollingForces& a, const SolidRollingForces& b, double by) {
  return {(a.normal - b.normal) / by,     (a.heading - b.heading) / by,
          (a.lateral - b.lateral) / by,   (a.torque - b.torque) / by,
          (a.aligning - b.aligning) / by, (a.overturning - b.overturning) / by};
}

}  // namespace

TEST(SteadySolidLayers, EliminateAHarmonicAsItsFullMatrixDoes) {
  const test::SteadyWheel w(small_case());
  const RollingOrder o = order(-90.0, 0.5);
  const auto layers = solid_layers(w.sector, w.harmonics.body().candidates, w.mass);
  EXPECT_EQ(layers.size(), 2U);
  SolidElimination e(layers, o);
  const Eigen::MatrixXcd inverse = full_matrix(w, o).inverse();
  const Eigen::Index n = inverse.rows(), last = e.surface().rows();
  ASSERT_EQ(last, 12);  // the last rows are the tread's, in this order
  EXPECT_LT((e.surface() - inverse.bottomRightCorner(last, last)).norm(), 1e-12 * inverse.norm());
  const Eigen::VectorXcd force = Eigen::VectorXcd::Random(n), u = e.solve(force);
  EXPECT_LT((u - inverse * force).norm(), 1e-12 * u.norm());
  Eigen::VectorXcd from_surface = Eigen::VectorXcd::Zero(n), load = from_surface;
  load.tail(last) = force.tail(last);
  from_surface.tail(last) = e.surface() * load.tail(last);
  follow(layers, e.transfers(), from_surface);
  EXPECT_LT((from_surface - inverse * load).norm(), 1e-12 * from_surface.norm());
}

TEST(SteadySolidHarmonics, AForceIsFeltAsItsSpectrumSays) {
  const test::SteadyWheel w(small_case());
  const SolidHarmonics& h = w.harmonics;
  Eigen::MatrixXd force =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * h.n_candidates()), h.turn());
  force.block<3, 1>(3, 5) << 2.0, -1.0, 3.0;
  const Eigen::MatrixXd u = h.fields(h.spectrum(force, {}), false);
  for (const int sample : {5, 6, 4, 60})
    for (std::size_t a = 0; a < h.n_candidates(); ++a) {
      const Vec3 rest = h.displacement(a, sample, {});
      Eigen::Vector3d found = u.block<3, 1>(3 * h.body().candidates[a], sample);
      found -= Eigen::Vector3d{rest.x, rest.y, rest.z};
      const Eigen::Vector3d expected =
          h.compliance(a, 1, sample - 5) * Eigen::Vector3d{2.0, -1.0, 3.0};
      EXPECT_LT((found - expected).norm(), 1e-14 * u.norm());
    }
}

TEST(SteadySolid, SlopesAreThoseOfDifferences) {
  const test::SteadyWheel w(small_case());
  SolidWindow window = cambered(w, 9.81);
  const SolidRollingDrive d = drive();
  const SolidRollingSolution s = solved(window, d);
  const auto by = [&](double SolidRollingDrive::*what, double step) {
    SolidRollingDrive more = d, less = d;
    more.*what += step;
    less.*what -= step;
    return difference(solved(window, more).forces, solved(window, less).forces, 2.0 * step);
  };
  const double size = s.forces.normal;
  expect_near(s.slopes.by_height.forces, by(&SolidRollingDrive::height, 1e-8), 1e-3 * size);
  expect_near(s.slopes.by_speed.forces, by(&SolidRollingDrive::speed, 1e-6), 1e-6 * size);
  expect_near(s.slopes.by_slip_angle.forces, by(&SolidRollingDrive::slip_angle, 1e-7), 1e-5 * size);
  expect_near(s.slopes.by_friction.forces, by(&SolidRollingDrive::friction, 1e-6), 1e-6 * size);
}

TEST(SteadySolid, MomentsAreThoseOfPlacesAndForces) {
  const test::SteadyWheel w(small_case());
  SolidWindow window = cambered(w);
  const SolidRollingSolution s = solved(window, drive());
  double aligning = 0.0, overturning = 0.0;
  for (Eigen::Index j = 0; 3 * j < s.force.size(); ++j) {
    aligning += s.place[2 * j + 1] * s.force[3 * j + 1] - s.place[2 * j] * s.force[3 * j + 2];
    overturning -= s.place[2 * j + 1] * s.force[3 * j];
  }
  EXPECT_NEAR(s.forces.aligning, aligning / 2.0, 1e-9 * s.forces.normal);
  EXPECT_NEAR(s.forces.overturning, overturning / 2.0, 1e-9 * s.forces.normal);
  EXPECT_GT(std::abs(aligning), 1.0);
}

TEST(SteadySolid, TheSlipOfTheLawIsThatOfTheField) {
  const test::SteadyWheel w(test::box_wheel_case(4));
  SolidWindow window = cambered(w);
  SolidRollingDrive d = drive();
  d.slip_angle = 0.1;
  const SolidRollingSolution s = solved(window, d);
  const RollingPower power = rolling_power(window, s, spectrum_of(window, s));
  EXPECT_GT(power.friction, 1e3);
  EXPECT_LT(std::abs(power.scheme), 0.006 * power.friction);
}

TEST(SteadySolid, LoadTractionAndTorqueComeBackToHeightAndSpeed) {
  const test::SteadyWheel w(small_case());
  SolidWindow window = cambered(w, 9.81);
  const SolidRollingDrive given = drive();
  const SolidRollingSolution s = solved(window, given);
  SolidRollingDrive d = given;
  d.load = s.forces.normal;
  d.height = 0.0;
  SolidRollingSolution by = solved(window, d);
  EXPECT_NEAR(by.height, given.height, 1e-12);
  d.traction = s.forces.heading;
  d.speed = 10.2;
  by = solved(window, d);
  EXPECT_NEAR(by.height, given.height, 1e-11);
  EXPECT_NEAR(by.speed, given.speed, 1e-8);
  d.traction.reset();
  d.torque = s.forces.torque;
  by = solved(window, d);
  EXPECT_NEAR(by.height, given.height, 1e-11);
  EXPECT_NEAR(by.speed, given.speed, 1e-8);
  expect_near(by.forces, s.forces, 1e-7 * s.forces.normal);
}

TEST(SteadySolid, SlopesUnderLoadAndTorqueHaveItsRow) {
  const test::SteadyWheel w(small_case());
  SolidWindow window = cambered(w);
  SolidRollingDrive d = drive();
  d.load = 18000.0;
  d.torque = 20.0;
  const SolidRollingSolution s = solved(window, d);
  const double step = 1e-2;
  SolidRollingDrive more = d, less = d;
  *more.torque += step;
  *less.torque -= step;
  const SolidRollingSolution high = solved(window, more), low = solved(window, less);
  const SolidRollingSlope& slope = s.slopes.by_speed;
  EXPECT_NEAR(slope.forces.torque, 1.0, 1e-9);
  EXPECT_NEAR(slope.forces.normal, 0.0, 1e-7);
  EXPECT_NEAR(slope.speed, (high.speed - low.speed) / (2 * step), 1e-6 * std::abs(slope.speed));
  EXPECT_NEAR(slope.forces.lateral, (high.forces.lateral - low.forces.lateral) / (2 * step), 1e-5);
}

TEST(SteadySolid, HasTheSameBitsWithMoreThreads) {
  test::SteadyWheelCase c = small_case();
  const test::SteadyWheel one(c);
  c.threads = 3;
  const test::SteadyWheel three(c);
  SolidWindow a = cambered(one), b = cambered(three);
  const SolidRollingSolution x = solved(a, drive()), y = solved(b, drive());
  EXPECT_EQ(x.force, y.force);
}

TEST(SteadySolid, SaysWhereNothingTouchesOrAllSlides) {
  const test::SteadyWheel w(small_case());
  SolidWindow window(w.harmonics, SlipDifference::bdf2);
  SolidRollingDrive d = drive();
  d.height = 0.302;
  EXPECT_EQ(solve_rolling(window, d).end, RollingEnd::no_contact);
  d = drive();
  d.slip_angle = 0.0;
  d.traction = 0.5 * solved(window, drive()).forces.normal;  // friction bears 0.4
  EXPECT_NE(solve_rolling(window, d).end, RollingEnd::solved);
}

TEST(SteadySolid, ResidualKnowsAWrongForce) {
  const test::SteadyWheel w(small_case());
  SolidWindow window = cambered(w);
  const SolidRollingDrive d = drive();
  const SolidRollingSolution s = solved(window, d);
  SolidRollingPoint p{s.force, s.height, s.speed};
  EXPECT_LE(solid_residual(window.problem(), d.slip_angle, p, d.friction), 1e-10);
  Eigen::Index largest = 0;
  p.force.cwiseAbs().maxCoeff(&largest);
  p.force[largest] *= 1.0 + 1e-6;
  EXPECT_GT(solid_residual(window.problem(), d.slip_angle, p, d.friction), 1e-8);
}

}  // namespace steady_solid_test
