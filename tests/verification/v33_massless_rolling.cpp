// SPDX-License-Identifier: BSD-3-Clause
/// V33: the rolling disks of V18 and V20 on contact nodes without mass (docs/theory.md, 3.10), and
/// the critical step. Expected: an independent code of the same scheme on the same meshes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "support/models.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace v33_massless_rolling {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

/// Steps with K_ii and M_i of what has mass: the contact nodes are held.
CriticalStep step_of_massive(const test::Built& b, double beta) {
  return critical_step(b.model.stiffness, b.model.mass, nodes_with_mass(b.model), {beta, 0.0},
                       std::numeric_limits<double>::infinity());
}

test::Built rolling(const test::DiskCase& c, double friction, bool massless) {
  test::Built b = test::build(c);
  test::add_ground(b, test::ledge(), {friction, 0.0});
  if (massless) test::make_contact_massless(b);
  return b;
}

struct Rolled {
  Vec2 force;           ///< mean, of the ground                                      [N/m]
  double noise = 0.0;   ///< rms of F_y above a frequency                             [N/m]
  double impact = 0.0;  ///< loss_impact                                              [J/m]
};

/// rms of the part of `values` above `frequency`: all but the sum of what is below.
double rms_above(const std::vector<double>& values, double mean, double dt, double frequency) {
  const auto n = values.size();
  double power = 0.0;
  for (const double f : values) power += (f - mean) * (f - mean) / static_cast<double>(n);
  const auto last = static_cast<std::size_t>(frequency * static_cast<double>(n) * dt);
  for (std::size_t k = 1; k <= last; ++k) {
    Complex sum;
    const double angle = -2.0 * std::numbers::pi / static_cast<double>(n);
    for (std::size_t j = 0; j < n; ++j)
      sum += (values[j] - mean) * rotation(angle * static_cast<double>(k * j % n));
    power -= 2.0 * norm_squared(sum / static_cast<double>(n));
  }
  return std::sqrt(std::max(power, 0.0));
}

/// Also that law, gaps and energy are kept, at every step.
Rolled roll(const test::Built& b, double from, double end, double frequency) {
  test::Stepping run(b, StiffnessOperator::sparse);
  const test::FloatingPointTraps traps;
  std::vector<double> force_x, force_y;
  double scale = 0.0, residual = 0.0, penetration = 0.0;
  run.advance_to(end, [&](const StepReport& step) {
    scale = std::max(scale, step.contact.free_velocity);
    residual = std::max(residual, step.contact.residual);
    penetration = std::max(penetration, step.contact.penetration);
    EXPECT_EQ(step.contact.clusters_not_converged, 0);
    if (step.frame.time <= from) return;
    force_x.push_back(step.contact.impulse.x / b.model.dt);
    force_y.push_back(step.contact.impulse.y / b.model.dt);
  });
  if (has_massless_contact(b.model)) {
    EXPECT_LT(penetration, 1e-14);
  }
  EXPECT_LT(residual, 1e-11 * scale);
  EXPECT_LT(run.balance().relative, 1e-13);
  Rolled out;
  for (const double f : force_x) out.force.x += f / static_cast<double>(force_x.size());
  for (const double f : force_y) out.force.y += f / static_cast<double>(force_y.size());
  if (frequency > 0.0) out.noise = rms_above(force_y, out.force.y, b.model.dt, frequency);
  out.impact = run.balance().works.loss_impact;
  return out;
}

struct Row {
  const char* name;
  double friction, force_x, force_y;
};

class MasslessRolling : public testing::TestWithParam<Row> {};

}  // namespace

TEST_P(MasslessRolling, MeanForces) {
  const Row& row = GetParam();
  const Rolled found =
      roll(rolling(test::rolling_disk(12, 180), row.friction, true), 0.095, 0.12, 0.0);
  RecordProperty("force_y", fmt::format("{:.6g}", found.force.y));
  RecordProperty("force_x", fmt::format("{:.6g}", found.force.x));
  // A digit of the figures that are given: the two codes differ in step and start.
  EXPECT_NEAR(found.force.y, row.force_y, 1e-4 * row.force_y);
  EXPECT_NEAR(found.force.x, row.force_x, 4e-4 * std::abs(row.force_x) + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, MasslessRolling,
                         testing::Values(Row{"frictionless", 0.0, 0.0, 1.89672e5},
                                         Row{"friction_2", 0.2, -1.8243e4, 1.89911e5},
                                         Row{"friction_4", 0.4, -2.1883e4, 1.90095e5},
                                         Row{"friction_6", 0.6, -2.3071e4, 1.90230e5}),
                         [](const auto& p) { return p.param.name; });

/// Above twice the frequency of the nodes the force is noise of their arrivals.
TEST(MasslessNoise, OfTheSmoothDisk) {
  const test::DiskCase c = test::rolling_disk(12, 180);
  const double twice = 2.0 * 180.0 * 33.333333 / (2.0 * std::numbers::pi);
  const Rolled lumped = roll(rolling(c, 0.3, false), 0.1, 0.2, twice);
  const Rolled found = roll(rolling(c, 0.3, true), 0.1, 0.2, twice);
  RecordProperty("noise", fmt::format("{:.1f} of {:.1f}", found.noise, lumped.noise));
  RecordProperty("impact", fmt::format("{:.4f} of {:.4f}", found.impact, lumped.impact));
  EXPECT_NEAR(found.force.y, 1.90018e5, 1e-4 * 1.90018e5);
  EXPECT_NEAR(found.force.x, -2.0714e4, 4e-4 * 2.0714e4);
  EXPECT_NEAR(lumped.noise, 416.0, 2.0);
  EXPECT_NEAR(found.noise, 135.0, 2.0);
  EXPECT_NEAR(lumped.impact, 6.348, 5e-3);
  // The independent code loses 0.1565 J/m: 0.06 less while the disk climbs the fillet, where it
  // takes the normal elsewhere. On the flat both lose 1.25 J/m a second.
  EXPECT_GT(found.impact, 0.0);
  EXPECT_LT(found.impact, 0.04 * lumped.impact);
}

TEST(MasslessNoise, OfTheTread) {
  test::DiskCase c = test::rolling_disk(9, 0);
  c.disk.tread = mesh::Tread{60, 0.02, 3, 1, 2};
  const Rolled lumped = roll(rolling(c, 0.3, false), 0.1, 0.2, 6000.0);
  const Rolled found = roll(rolling(c, 0.3, true), 0.1, 0.2, 6000.0);
  RecordProperty("noise", fmt::format("{:.1f} of {:.1f}", found.noise, lumped.noise));
  RecordProperty("impact", fmt::format("{:.4f} of {:.4f}", found.impact, lumped.impact));
  EXPECT_NEAR(found.force.y, 1.72297e5, 1e-4 * 1.72297e5);
  EXPECT_NEAR(found.force.x, -1.9587e4, 4e-4 * 1.9587e4);
  EXPECT_NEAR(lumped.noise, 265.0, 2.0);
  EXPECT_NEAR(found.noise, 51.0, 1.0);
  EXPECT_NEAR(lumped.impact, 3.81, 0.01);
  EXPECT_LT(found.impact, 0.04 * lumped.impact);
  EXPECT_GT(found.impact, 0.0);
}

namespace {

struct Variant {
  const char* name;
  double beta, spin;
};

class MasslessLimit : public testing::TestWithParam<Variant> {};

/// Largest kinetic energy of a start with random velocities, which hold every mode; as in V13. The
/// fastest mode is one of the elements at the rim, which are the narrowest: what the contact nodes
/// do, held or free, does not count there.
double largest_energy(const Variant& v, double safety) {
  test::DiskCase c = test::rolling_disk(6, 48);
  c.alpha = 0.0;
  c.beta = v.beta;
  c.motion.angular_velocity = Table(v.spin);
  c.motion.speed = Table(0.3 * v.spin);
  c.motion.height = Table(0.298);
  test::Built b = test::build(c);
  test::add_ground(b, {}, {0.3, 0.0});
  test::make_contact_massless(b);
  b.model.dt = safety * step_of_massive(b, v.beta).step;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> x(-1.0, 1.0);
  std::vector<Vec2> u0(b.model.n_nodes()), v0(b.model.n_nodes());
  for (Vec2& velocity : v0) velocity = {x(random), x(random)};
  test::Stepping run(b, StiffnessOperator::sparse, u0, v0);
  double largest = 0.0;
  const auto look = [&](const StepReport& s) { largest = std::max(largest, s.balance.kinetic); };
  for (int n = 0; n < 20000 && std::isfinite(largest) && largest < 1e30; n += 50)
    run.advance(50, look);
  return largest;
}

}  // namespace

TEST_P(MasslessLimit, StableBelowDivergentAbove) {
  const double reference = largest_energy(GetParam(), 0.5);
  EXPECT_LT(largest_energy(GetParam(), 0.99), 10.0 * reference);
  EXPECT_GT(largest_energy(GetParam(), 1.01), 1e9 * reference);
}

INSTANTIATE_TEST_SUITE_P(All, MasslessLimit,
                         testing::Values(Variant{"plain", 0.0, 0.0}, Variant{"damped", 1e-5, 0.0},
                                         Variant{"spinning", 0.0, 50.0},
                                         Variant{"all", 2e-5, 50.0}),
                         [](const auto& p) { return p.param.name; });

/// Never below that of the lumped mass; some times as long where the outermost layers are the
/// finest.
TEST(MasslessStep, IsLongerWhereTheMeshIsGradedTowardsTheRim) {
  for (const auto& [grading, least, most] :
       {std::tuple{1.0, 1.0, 1.1}, std::tuple{1.8, 1.0, 2.0}, std::tuple{3.0, 2.0, 3.2}}) {
    test::DiskCase c = test::rolling_disk(12, 180);
    c.disk.grading = grading;
    c.beta = 0.0;
    const test::Built b = rolling(c, 0.3, true);
    const double ratio = step_of_massive(b, 0.0).step / b.critical.step;
    RecordProperty(fmt::format("ratio_{}", grading), fmt::format("{:.4f}", ratio));
    EXPECT_GE(ratio, least) << grading;
    EXPECT_LE(ratio, most) << grading;
  }
}

}  // namespace v33_massless_rolling
