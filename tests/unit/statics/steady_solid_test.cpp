// SPDX-License-Identifier: BSD-3-Clause
/// Steady rolling in three dimensions, part by part.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

#include "support/solid_steady.hpp"

namespace steady_solid_test {

using namespace rondo;
using namespace rondo::statics;
using test::cambered;
using test::difference;
using test::expect_near;
using test::small_case;
using test::solved;

namespace {

RollingOrder order(double rate, double turn) {
  return {{std::polar(1.0, -turn), 1.0, std::polar(1.0, turn)}, rate, -30.0, 200.0, 2e-5};
}

using ViscousParts = std::vector<fem::ViscousPart<fem::SolidSector>>;

/// Two parts of every other element, with different branches.
ViscousParts viscous_parts(const test::SteadyWheel& w) {
  mesh::Mesh mesh = w.mesh;
  mesh.region_names = {"first", "second"};
  for (std::size_t e = 0; e < mesh.hexahedra.size(); ++e)
    mesh.region.push_back(static_cast<int>(e % 2));
  std::vector<fem::Material> materials(2, test::box_rubber());
  materials[0].branches = {{0.7, 1e-2}};
  materials[1].branches = {{0.4, 1e-3}, {0.2, 1e-1}};
  return fem::viscous_parts<fem::SolidSector>(mesh, materials, fem::ViscousBy::material);
}

/// Z_k as a full matrix, by the definition.
Eigen::MatrixXcd full_matrix(const test::SteadyWheel& w, const RollingOrder& o,
                             const ViscousParts& viscous = {}) {
  const std::complex<double> i{0.0, 1.0}, elastic = 1.0 + i * (o.rate * o.stiffness_damping);
  const auto n = static_cast<Eigen::Index>(3 * w.sector.n_local());
  Eigen::MatrixXcd z = Eigen::MatrixXcd::Zero(n, n);
  for (std::size_t a = 0; a < w.sector.n_local(); ++a) {
    const auto row = static_cast<Eigen::Index>(3 * a);
    for (const auto& e : w.sector.row(a))
      z.block<3, 3>(row, 3 * e.column) += elastic * o.turns[static_cast<std::size_t>(e.shift + 1)] *
                                          Eigen::Map<const Eigen::Matrix3d>(e.block.data());
    for (std::size_t p = 0; p < viscous.size(); ++p)
      for (const auto& e : viscous[p].stiffness.row(a))
        z.block<3, 3>(row, 3 * e.column) += o.viscous[p] *
                                            o.turns[static_cast<std::size_t>(e.shift + 1)] *
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

/// Elimination, factors and the way back, against the inverse of the full matrix.
void expect_full_matrix(const test::SteadyWheel& w, const RollingLayers<3>& layers,
                        const RollingOrder& o, const ViscousParts& parts) {
  std::vector<std::complex<double>> transfers(transfer_size(layers));
  const Eigen::MatrixXcd surface = eliminate(layers, o, std::span(transfers));
  const Eigen::MatrixXcd inverse = full_matrix(w, o, parts).inverse();
  const Eigen::Index n = inverse.rows(), last = surface.rows();
  ASSERT_EQ(last, 12);  // the last rows are the tread's, in this order
  EXPECT_LT((surface - inverse.bottomRightCorner(last, last)).norm(), 1e-12 * inverse.norm());
  const Eigen::VectorXcd force = Eigen::VectorXcd::Random(n),
                         u = RollingFactors<3>(layers, o).solve(layers, force);
  EXPECT_LT((u - inverse * force).norm(), 1e-12 * u.norm());
  Eigen::VectorXcd from_surface = Eigen::VectorXcd::Zero(n), load = from_surface;
  load.tail(last) = force.tail(last);
  from_surface.tail(last) = surface * load.tail(last);
  follow(layers, std::span<const std::complex<double>>(transfers), from_surface);
  EXPECT_LT((from_surface - inverse * load).norm(), 1e-12 * from_surface.norm());
}

}  // namespace

TEST(SteadySolidLayers, EliminateAHarmonicAsItsFullMatrixDoes) {
  const test::SteadyWheel w(small_case());
  RollingOrder o = order(-90.0, 0.5);
  const auto layers = rolling_layers<3>(w.sector, w.harmonics.body().candidates, w.mass);
  EXPECT_EQ(layers.size(), 2U);
  expect_full_matrix(w, layers, o, {});
  const ViscousParts parts = viscous_parts(w);
  for (const auto& part : parts) o.viscous.push_back(fem::branch_modulus(part.branches, o.rate));
  const auto viscous = rolling_layers<3>(w.sector, w.harmonics.body().candidates, w.mass, parts);
  expect_full_matrix(w, viscous, o, parts);
  const Eigen::VectorXcd u =
      Eigen::VectorXcd::Random(static_cast<Eigen::Index>(3 * w.sector.n_local()));
  const RollingNorms norms = norms_of<3>(viscous, o, u);
  RollingOrder without = o, with = o;
  without.viscous = {0.0, 0.0};
  for (const std::size_t p : {0U, 1U}) {
    with.viscous = without.viscous;
    with.viscous[p] = 1.0;
    const std::complex<double> form =
        u.dot((full_matrix(w, with, parts) - full_matrix(w, without, parts)) * u);
    EXPECT_NEAR(norms.viscous[p], form.real(), 1e-12 * norms.stiffness);
    EXPECT_GT(norms.viscous[p], 0.1 * norms.stiffness);
  }
}

/// Three pairs with any numbers, and the same with a third component that nothing acts on.
TEST(SteadyRollingProblem, InSpaceWithoutALateralPartIsThatOfThePlane) {
  constexpr Eigen::Index n = 3;
  RollingProblem<2> plane;
  plane.time = 1e-3;
  plane.pass = 2.0;
  plane.base = Eigen::VectorXd::Random(2 * n);
  plane.matrix = Eigen::MatrixXd::Random(2 * n, 2 * n);
  plane.base_place = Eigen::VectorXd::Random(n);
  plane.matrix_place = Eigen::MatrixXd::Random(n, 2 * n);
  plane.weight = Eigen::VectorXd::Random(2 * n);
  RollingProblem<3> space;
  space.time = plane.time;
  space.pass = plane.pass;
  space.base = Eigen::VectorXd::Zero(3 * n);
  space.matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  space.base_place = Eigen::VectorXd::Zero(2 * n);
  space.matrix_place = Eigen::MatrixXd::Zero(2 * n, 3 * n);
  space.weight = space.base;
  const std::vector<Eigen::Index> in{0, 1, 3, 4, 6, 7}, places{0, 2, 4};
  space.base(in) = plane.base;
  space.matrix(in, in) = plane.matrix;
  space.base_place(places) = plane.base_place;
  space.matrix_place(places, in) = plane.matrix_place;
  space.weight(in) = plane.weight;
  const RollingPoint p{Eigen::VectorXd::Random(2 * n), 0.3, 10.0};
  RollingPoint q{Eigen::VectorXd::Zero(3 * n), p.height, p.speed};
  q.force(in) = p.force;
  expect_near(forces_of(space, q), forces_of(plane, p), 1e-14);
  EXPECT_LT((gaps_and_ways(space, q, {})(in) - gaps_and_ways(plane, p, {})).norm(), 1e-14);
  const TorqueChange a = torque_change(space, q), b = torque_change(plane, p);
  EXPECT_LT((a.row(in) - b.row).norm(), 1e-14);
  EXPECT_NEAR(a.by_height, b.by_height, 1e-14);
}

TEST(SteadySolidHarmonics, AForceIsFeltAsItsSpectrumSays) {
  const test::SteadyWheel w(small_case());
  const RollingHarmonics<3>& h = w.harmonics;
  Eigen::MatrixXd force =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * h.n_candidates()), h.turn());
  force.block<3, 1>(3, 5) << 2.0, -1.0, 3.0;
  const Eigen::MatrixXd u = h.fields(h.spectrum(force, {}), 0.0, false);
  for (const int sample : {5, 6, 4, 60})
    for (std::size_t a = 0; a < h.n_candidates(); ++a) {
      const Eigen::Vector3d found =
          u.block<3, 1>(3 * h.body().candidates[a], sample) - h.displacement(a, sample, {});
      const Eigen::Vector3d expected =
          h.compliance(a, 1, sample - 5) * Eigen::Vector3d{2.0, -1.0, 3.0};
      EXPECT_LT((found - expected).norm(), 1e-14 * u.norm());
    }
}

/// What is in equilibrium at the spin at which it rolls is not displaced by it.
TEST(SteadySolidHarmonics, TheSpinOfTheStateAtRestIsNoLoad) {
  const test::SteadyWheel w(small_case());
  RollingBody<3> body = w.harmonics.body();
  const Eigen::Vector3d whole = w.harmonics.displacement(1, 0, {});
  ASSERT_GT(whole.norm(), 0.0);
  body.rest_spin = body.spin;
  EXPECT_EQ(RollingHarmonics<3>(body).displacement(1, 0, {}).norm(), 0.0);
  body.rest_spin = -0.5 * body.spin;
  const Eigen::Vector3d part = RollingHarmonics<3>(body).displacement(1, 0, {});
  EXPECT_LT((part - 0.75 * whole).norm(), 1e-12 * whole.norm());
}

/// Masses that nothing accelerates do not matter, but for the softening by the spin; without rates
/// a slow wheel shows the same.
TEST(SteadySolidHarmonics, WithoutInertiaASpinningWheelIsThatOfAnInfinitelySlowOne) {
  test::SteadyWheelCase c = small_case();
  c.stiffness_damping = 0.0;
  const test::SteadyWheel fast(c);
  RollingBody<3> body = fast.harmonics.body();
  body.rest_spin = body.spin;
  body.inertia = RollingInertia::none;
  const RollingHarmonics<3> still(body);
  body.spin = body.rest_spin = 1e-4;
  body.inertia = RollingInertia::all;
  const RollingHarmonics<3> slow(body);
  const double size = slow.compliance(1, 1, 0).norm();
  for (const int ahead : {0, 1, 5}) {
    EXPECT_LT((still.compliance(1, 1, ahead) - slow.compliance(1, 1, ahead)).norm(), 3e-4 * size);
    EXPECT_GT((fast.harmonics.compliance(1, 1, ahead) - slow.compliance(1, 1, ahead)).norm(),
              1e-3 * size);
  }
}

/// With one sample the sectors resolve all harmonics; with two the upper half follows at once.
TEST(SteadySolidHarmonics, WavesAreTheHarmonicsUpToHalfTheSectors) {
  for (const int samples : {1, 2}) {
    const test::SteadyWheel w(small_case(samples));
    RollingBody<3> body = w.harmonics.body();
    body.inertia = RollingInertia::waves;
    const RollingHarmonics<3> waves(body);
    body.inertia = RollingInertia::none;
    const RollingHarmonics<3> none(body);
    const auto of_harmonic = [&](const RollingHarmonics<3>& h, int k) {
      NodeMatrix<3> sum = NodeMatrix<3>::Zero();
      for (int m = 0; m < h.turn(); ++m)
        sum += std::cos(2.0 * std::numbers::pi * k * m / h.turn()) * h.compliance(1, 1, m);
      return sum;
    };
    for (int k = 0; k <= w.harmonics.turn() / 2; ++k) {
      const NodeMatrix<3> has = of_harmonic(waves, k);
      const auto& as = 2 * k <= body.stiffness.n_sectors ? w.harmonics : none;
      EXPECT_LT((has - of_harmonic(as, k)).norm(), 1e-10 * has.norm()) << samples << " " << k;
    }
    const int high = w.harmonics.turn() / 2 - 1;
    const NodeMatrix<3> difference = of_harmonic(waves, high) - of_harmonic(w.harmonics, high);
    const bool same = difference.norm() < 1e-9 * of_harmonic(waves, high).norm();
    EXPECT_EQ(same, samples == 1);
  }
}

TEST(SteadySolid, SlopesAreThoseOfDifferences) {
  const test::SteadyWheel w(small_case());
  RollingWindow<3> window = cambered(w, 9.81);
  const RollingDrive d = test::cornering_drive();
  const RollingSolution s = solved(window, d);
  const auto by = [&](double RollingDrive::*what, double step) {
    RollingDrive more = d, less = d;
    more.*what += step;
    less.*what -= step;
    return difference(solved(window, more).forces, solved(window, less).forces, 2.0 * step);
  };
  const double size = s.forces.normal;
  expect_near(s.slopes.by_height.forces, by(&RollingDrive::height, 1e-8), 1e-3 * size);
  expect_near(s.slopes.by_speed.forces, by(&RollingDrive::speed, 1e-6), 1e-6 * size);
  expect_near(s.slopes.by_slip_angle.forces, by(&RollingDrive::slip_angle, 1e-7), 1e-5 * size);
  expect_near(s.slopes.by_friction.forces, by(&RollingDrive::friction, 1e-6), 1e-6 * size);
}

TEST(SteadySolid, MomentsAreThoseOfPlacesAndForces) {
  const test::SteadyWheel w(small_case());
  RollingWindow<3> window = cambered(w);
  const RollingSolution s = solved(window, test::cornering_drive());
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
  RollingWindow<3> window = cambered(w);
  RollingDrive d = test::cornering_drive();
  d.slip_angle = 0.1;
  const RollingSolution s = solved(window, d);
  const RollingPower power = rolling_power(window, s, spectrum_of(window, s));
  EXPECT_GT(power.friction, 1e3);
  EXPECT_LT(std::abs(power.scheme), 0.006 * power.friction);
}

TEST(SteadySolid, LoadTractionAndTorqueComeBackToHeightAndSpeed) {
  const test::SteadyWheel w(small_case());
  RollingWindow<3> window = cambered(w, 9.81);
  const RollingDrive given = test::cornering_drive();
  const RollingSolution s = solved(window, given);
  RollingDrive d = given;
  d.load = s.forces.normal;
  d.height = 0.0;
  RollingSolution by = solved(window, d);
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
  RollingWindow<3> window = cambered(w);
  RollingDrive d = test::cornering_drive();
  d.load = 18000.0;
  d.torque = 20.0;
  const RollingSolution s = solved(window, d);
  const double step = 1e-2;
  RollingDrive more = d, less = d;
  *more.torque += step;
  *less.torque -= step;
  const RollingSolution high = solved(window, more), low = solved(window, less);
  const RollingSlope& slope = s.slopes.by_speed;
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
  RollingWindow<3> a = cambered(one), b = cambered(three);
  const RollingSolution x = solved(a, test::cornering_drive()),
                        y = solved(b, test::cornering_drive());
  EXPECT_EQ(x.force, y.force);
}

TEST(SteadySolid, SaysWhereNothingTouchesOrAllSlides) {
  const test::SteadyWheel w(small_case());
  RollingWindow<3> window(w.harmonics, SlipDifference::bdf2);
  RollingDrive d = test::cornering_drive();
  d.height = 0.302;
  EXPECT_EQ(solve_rolling(window, d).end, RollingEnd::no_contact);
  d = test::cornering_drive();
  d.slip_angle = 0.0;
  d.traction = 0.5 * solved(window, test::cornering_drive()).forces.normal;  // friction bears 0.4
  EXPECT_NE(solve_rolling(window, d).end, RollingEnd::solved);
}

TEST(SteadySolid, ResidualKnowsAWrongForce) {
  const test::SteadyWheel w(small_case());
  RollingWindow<3> window = cambered(w);
  const RollingDrive d = test::cornering_drive();
  const RollingSolution s = solved(window, d);
  RollingPoint p{s.force, s.height, s.speed};
  EXPECT_LE(rolling_residual(window.problem(), p, d.path(), d.friction), 1e-10);
  Eigen::Index largest = 0;
  p.force.cwiseAbs().maxCoeff(&largest);
  p.force[largest] *= 1.0 + 1e-6;
  EXPECT_GT(rolling_residual(window.problem(), p, d.path(), d.friction), 1e-8);
}

}  // namespace steady_solid_test
