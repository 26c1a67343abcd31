// SPDX-License-Identifier: BSD-3-Clause
/// V38: a wheel in three dimensions that corners (docs/wheel3d.md): the table of the box wheel, its
/// mirrors, the limit of a plane disk, and its ledger.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "support/solid_wheel.hpp"

namespace rondo::dynamics::v38_cornering {
namespace {

using test::Cornering;

/// Means of the ground's forces over the last sectors that passed.
struct Forces {
  double normal = 0.0, longitudinal = 0.0, lateral = 0.0;  ///< [N]
  double aligning = 0.0, overturning = 0.0, torque = 0.0;  ///< [N·m]
  double ledger = 0.0, law = 0.0;
};

Forces roll(const mesh::Mesh& mesh, const Cornering& c, double end = 0.14) {
  const Model model = test::cornering_model(mesh, c);
  const Field rest(model.n_nodes(), 3);
  const State state = start(model, rest, rest);
  const auto integrator = make_integrator(model, state);
  const double pass = 2.0 * std::numbers::pi / (mesh.n_sectors * c.angular_velocity);
  const double from = end - 24.0 * pass;
  Forces sum;
  double time = 0.0;
  std::array<StepReport, 64> reports;
  const auto steps = static_cast<long long>(end / c.dt);
  for (long long done = 0; done < steps;) {
    const auto n = static_cast<std::size_t>(std::min<long long>(64, steps - done));
    integrator->advance(std::span(reports).first(n));
    done += static_cast<long long>(n);
    for (std::size_t i = 0; i < n; ++i) {
      const StepReport& r = reports[i];
      sum.law = std::max(sum.law, r.contact.residual);
      sum.ledger = r.balance.relative;
      if (r.frame.time < from) continue;
      time += c.dt;
      sum.normal += r.contact.impulse.y;
      sum.longitudinal += r.contact.impulse.x;
      sum.lateral += r.contact.impulse.z;
      sum.aligning += r.contact.moment_aligning;
      sum.overturning += r.contact.moment_overturning;
      sum.torque += r.contact.angular_impulse;
    }
  }
  for (double* f :
       {&sum.normal, &sum.longitudinal, &sum.lateral, &sum.aligning, &sum.overturning, &sum.torque})
    *f /= time;
  return sum;
}

constexpr double degree = std::numbers::pi / 180.0;

/// One of the numbers is met to half a unit of its last printed digit, and a tenth more.
void expect_printed(double found, double printed, double unit) {
  EXPECT_NEAR(found, printed, 0.6 * unit);
}

TEST(V38Cornering, TheTableOfTheBoxWheel) {
  const mesh::Mesh mesh = make_wheel(test::box_wheel());
  struct Row {
    double angle, normal, lateral, aligning, unit;
  };
  for (const Row& row : {Row{0.25, 17785, -400, -8.86, 0.01}, Row{1.0, 17819, -1579, -29.9, 0.1},
                         Row{2.0, 17909, -3041, -44.4, 0.1}, Row{4.0, 18226, -5183, -23.7, 0.1},
                         Row{12.0, 18273, -5463, -0.46, 0.01}}) {
    SCOPED_TRACE(row.angle);
    const Forces f = roll(mesh, {.slip_angle = row.angle * degree});
    expect_printed(f.normal, row.normal, 1.0);
    expect_printed(f.lateral, row.lateral, 1.0);
    expect_printed(f.aligning, row.aligning, row.unit);
    EXPECT_LT(f.ledger, 1e-12);
    EXPECT_LT(f.law, 1e-12);
  }
}

TEST(V38Cornering, StraightOnNothingPullsSideways) {
  const Forces f = roll(make_wheel(test::box_wheel()), {});
  expect_printed(f.normal, 17773.0, 1.0);
  EXPECT_NEAR(f.lateral, 0.0, 1e-9);
  EXPECT_NEAR(f.aligning, 0.0, 1e-10);
  EXPECT_NEAR(f.overturning, 0.0, 1e-9);
}

/// Mirrored in the plane of the wheel, forces along t2 and moments about n and t1 turn round.
void expect_mirrors(const Forces& a, const Forces& b) {
  EXPECT_NEAR(a.normal, b.normal, 1e-9 * a.normal);
  EXPECT_NEAR(a.longitudinal, b.longitudinal, 1e-9 * a.normal);
  EXPECT_NEAR(a.lateral, -b.lateral, 1e-9 * a.normal);
  EXPECT_NEAR(a.aligning, -b.aligning, 1e-10 * a.normal);
  EXPECT_NEAR(a.overturning, -b.overturning, 1e-10 * a.normal);
  EXPECT_NEAR(a.torque, b.torque, 1e-10 * a.normal);
}

TEST(V38Cornering, SlipAngleAndCamberHaveMirrors) {
  const mesh::Mesh mesh = make_wheel(test::box_wheel());
  const Forces slips = roll(mesh, {.slip_angle = 2.0 * degree});
  expect_mirrors(slips, roll(mesh, {.slip_angle = -2.0 * degree}));
  const Forces leans = roll(mesh, {.camber = 4.0 * degree});
  expect_mirrors(leans, roll(mesh, {.camber = -4.0 * degree}));
  expect_printed(leans.lateral, 1465.0, 1.0);
  const Forces both = roll(mesh, {.slip_angle = 1.0 * degree, .camber = 3.0 * degree}, 0.06);
  expect_mirrors(both, roll(mesh, {.slip_angle = -1.0 * degree, .camber = -3.0 * degree}, 0.06));
}

TEST(V38Cornering, WithoutFrictionThereIsNoForceAlongTheGround) {
  const Forces f =
      roll(make_wheel(test::box_wheel()), {.slip_angle = 4.0 * degree, .friction = 0.0}, 0.06);
  EXPECT_EQ(f.lateral, 0.0);
  EXPECT_EQ(f.longitudinal, 0.0);
}

TEST(V38Cornering, DrivenSidewaysItSlidesAlongTheSumOfBothSlips) {
  const Forces f = roll(make_wheel(test::box_wheel()),
                        {.slip_angle = 3.0 * degree, .angular_velocity = 1.06 * 33.76455});
  expect_printed(f.longitudinal, 4029.0, 1.0);
  expect_printed(f.lateral, -3417.0, 1.0);
  expect_printed(f.aligning, 7.9, 0.1);
  EXPECT_NEAR(std::hypot(f.longitudinal, f.lateral) / (0.3 * f.normal), 0.984, 6e-4);
}

/// Nothing moves along the axle, and nothing is moved by what would: each slice is a plane disk.
TEST(V38Cornering, HeldAlongTheAxleItIsThePlaneDisk) {
  mesh::Wheel wheel = test::box_wheel(3, 1);
  const mesh::Mesh solid = make_wheel(wheel), plane = make_disk(wheel.disk);
  const Cornering c{.angular_velocity = 33.0};
  Model a = test::cornering_model(solid, c);
  for (auto& e : a.solid->sector.entries)
    for (const std::size_t coupling : {2U, 5U, 6U, 7U}) e.block[coupling] = 0.0;
  Model b;
  const std::vector<fem::Material> materials{test::box_rubber()};
  b.reference = plane.coordinates;
  b.mass = fem::lumped_mass(plane, materials);
  b.free = fem::free_nodes(plane);
  b.sector = fem::assemble_sector(plane, materials);
  b.stiffness = fem::assemble_stiffness(plane, materials);
  b.stiffness_operator = StiffnessOperator::cyclic;
  b.mass_damping = a.mass_damping;
  b.stiffness_damping = a.stiffness_damping;
  b.dt = a.dt;
  b.motion = a.motion;
  test::touch_flat_ground(plane, a.contact->law, b);
  const auto begin = [](const Model& m) {
    const Field rest(m.n_nodes(), m.components());
    return start(m, rest, rest);
  };
  const State start_a = begin(a), start_b = begin(b);
  const auto step_a = make_integrator(a, start_a), step_b = make_integrator(b, start_b);
  std::array<StepReport, 1> of_a, of_b;
  double largest = 0.0, apart = 0.0;
  for (int n = 0; n < 600; ++n) {
    step_a->advance(of_a);
    step_b->advance(of_b);
    const Vec3 force = of_b[0].contact.impulse;
    largest = std::max(largest, norm(force));
    apart = std::max(apart, norm(of_a[0].contact.impulse / wheel.width - force));
    ASSERT_EQ(of_a[0].contact.nodes, 2 * of_b[0].contact.nodes) << n;
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LE(apart, 1e-11 * largest);
}

}  // namespace
}  // namespace rondo::dynamics::v38_cornering
