// SPDX-License-Identifier: BSD-3-Clause
/// V31: free rolling of a compressible cylinder on rigid ground, Dundurs' part of its creep against
/// a half plane, that against closed forms and published numbers (docs/validation.md, V31).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/half_plane.hpp"
#include "support/steady_body.hpp"

namespace v31_bentall_johnson {

using namespace rondo;

namespace {

constexpr double modulus = 5.0e6, radius = 0.3, bore = 0.05, speed = 0.03;

double dundurs(double poissons_ratio) {
  return (1.0 - 2.0 * poissons_ratio) / (2.0 * (1.0 - poissons_ratio));
}

/// Thick, without damping, slow: its waves are 1,000 times as fast.
test::DiskCase cylinder(double poissons_ratio) {
  test::DiskCase c;
  c.disk = {.outer_radius = radius,
            .inner_radius = bore,
            .radial = 96,
            .circumferential = 14400,
            .grading = 2.5,
            .tread = {}};
  c.material = {modulus, poissons_ratio, 1100.0, fem::Plane::strain, fem::Integration::b_bar};
  c.alpha = c.beta = 0.0;
  c.motion.angular_velocity = dynamics::Table(speed / radius);
  return c;
}

/// Creep over a/R, as the contact becomes small, and what a/R adds to it.
struct Creep {
  double small = 0.0, curvature = 0.0;
};

/// From a/R = 0.02 and 0.04.
Creep creep_of(const test::SteadyBody& b, double poissons_ratio, double friction, double share) {
  double value[2];
  const double sizes[] = {0.02, 0.04};
  for (int k = 0; k < 2; ++k) {
    const double a = sizes[k] * radius, plane = modulus / (1.0 - poissons_ratio * poissons_ratio);
    const double load = std::numbers::pi * plane * a * a / (4.0 * radius);
    statics::RollingWindow<2> w = b.window(statics::SlipDifference::upwind);
    const statics::RollingDrive drive{.height = 0.0,
                                      .speed = speed,
                                      .friction = friction,
                                      .load = load,
                                      .traction = share * friction * load,
                                      .torque = {}};
    // Not by powers: nothing takes any, and round-off is all there is of them.
    const statics::RollingSolution s = solve_rolling(w, drive);
    EXPECT_EQ(s.end, statics::RollingEnd::solved);
    EXPECT_LT(rolling_residual(w, s, friction), test::finest_bounds.law);
    value[k] = (1.0 - s.speed / speed) / sizes[k];
  }
  return {2.0 * value[0] - value[1], (value[1] - value[0]) / (sizes[1] - sizes[0])};
}

}  // namespace

/// CONTACT's stored results (aluminium on steel, κ = 2β = 0.2877, a/R = 0.1/25) have 0.1 %.
TEST(BentallJohnson, TheHalfPlaneHasClosedFormsAndPublishedNumbers) {
  const double beta = 0.5 * 0.2877, size = 0.1 / 25.0;
  const auto creep = [&](double friction, double share, int strips = 200) {
    const auto r = test::roll({beta, friction, size, share, strips});
    EXPECT_TRUE(r.solved) << friction << ' ' << share;
    return r.creep;
  };
  EXPECT_NEAR(creep(0.05, 0.0), 4.294e-4, 1e-3 * 4.294e-4);
  EXPECT_NEAR(creep(0.05, 0.75), 5.392e-4, 1e-3 * 5.392e-4);
  EXPECT_NEAR(creep(0.05, -0.75), 2.108e-4, 1e-3 * 2.108e-4);
  EXPECT_NEAR(creep(0.001, 0.0), 0.4574 * 2.0 * beta * size, 3e-3 * 5.26e-4);  // no friction
  EXPECT_NEAR(creep(2.0 * beta, 0.0), test::creep_of_adhesion(beta) * size, 3e-3 * 3.67e-4);
  const auto carter = test::roll({0.0, 0.1, size, 0.6, 400});
  EXPECT_NEAR(carter.creep / (0.1 * size), 1.0 - std::sqrt(0.4), 2e-3);
}

/// 46 and 92 elements to the half width. Where all sticks the shear has its steepest end at the
/// leading edge, and the mesh leaves 0.8 %; elsewhere up to 0.3 %.
TEST(BentallJohnson, ACompressibleCylinderOnRigidGround) {
  constexpr double nu = 0.3;
  const double beta = dundurs(nu), kappa = 2.0 * beta;
  const test::SteadyBody b(cylinder(nu), 1, true);
  const struct {
    double friction, share;  // μ/κ, Q/(μP)
  } rows[] = {{0.0174, 0.0}, {0.174, 0.0}, {0.174, 0.75}, {0.174, -0.75}, {1.0, 0.0}};
  for (const auto& [friction, share] : rows) {
    const Creep found = creep_of(b, nu, friction * kappa, share);
    const auto half_plane = test::roll({beta, friction * kappa, 0.01, share, 200});
    EXPECT_TRUE(half_plane.solved);
    const double expected = half_plane.creep / 0.01;
    EXPECT_NEAR(found.small, expected, 0.01 * expected) << friction << ' ' << share;
    EXPECT_LT(found.curvature, 0.0);  // a rim that is pressed flat is stretched
    RecordProperty(fmt::format("{} {}", friction, share),
                   fmt::format("{:.5f}, half plane {:.5f}, curvature {:.3f}", found.small / kappa,
                               expected / kappa, found.curvature));
  }
}

/// Nothing but curvature is left where ν is a half.
TEST(BentallJohnson, AnIncompressibleCylinderHasCurvatureAlone) {
  constexpr double nu = 0.4999;
  const test::SteadyBody b(cylinder(nu), 1, true);
  const Creep found = creep_of(b, nu, 0.1, 0.0);
  EXPECT_NEAR(found.small, 0.0, 2e-3);  // 0.184 with ν = 0.3
  EXPECT_LT(found.curvature, -0.3);
  RecordProperty("0.4999", fmt::format("{:.5f}, curvature {:.3f}", found.small, found.curvature));
}

}  // namespace v31_bentall_johnson
