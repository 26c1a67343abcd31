// SPDX-License-Identifier: BSD-3-Clause
/// V32: elements that are implicit in the explicit step (docs/theory.md, 3.9). A bar with a fine
/// foot hits a wall, a disk with a stiff belt rolls: against the explicit step on the same mesh,
/// and the numbers of an independent program of the same scheme (docs/validation.md).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "support/bars.hpp"
#include "support/implicit.hpp"
#include "support/traps.hpp"

namespace v32_implicit_elements {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr double speed = 10.0;  // of the fall [m/s]
constexpr double full = 300.0;  // ρcv, the pressure of d'Alembert's solution [Pa]
constexpr int fine = 5;         // elements added at the foot
constexpr double courant = 0.9;

/// V2's bar of 100 elements with five finer ones added at its foot.
test::Bar tipped_bar(double height) {
  return {.length = 10.0 + fine * height, .elements = 100 + fine, .courant = courant};
}

mesh::Mesh tipped_mesh(const test::Bar& bar, double height) {
  mesh::Mesh mesh = test::bar_mesh(bar);
  for (int row = 0; row <= bar.elements; ++row)
    for (int i = 0; i < 2; ++i) {
      Vec2& x = mesh.coordinates[static_cast<std::size_t>(2 * row + i)];
      x = {i * 1.0, bar.gap + (row < fine ? row * height : fine * height + 0.1 * (row - fine))};
    }
  mesh.tributary.assign(2, 0.5);
  return mesh;
}

/// Over the ground, in no frame that turns with it. @param implicit the foot
Model tipped_model(double height, bool implicit) {
  const test::Bar bar = tipped_bar(height);
  const mesh::Mesh mesh = tipped_mesh(bar, height);
  const fem::Material material{bar.youngs_modulus, 0.0, bar.density, fem::Plane::stress};
  Model model = test::body_model(mesh, material, 0.0, 0.0, courant);
  model.free_bodies.clear();
  test::add_ground(model, mesh, {}, {});
  if (!implicit) return model;
  std::vector<char> cells(mesh.cells.size());
  std::fill_n(cells.begin(), fine, 1);
  model.implicit = test::implicit_part(mesh, {&material, 1}, cells);
  const CriticalStep critical = test::explicit_step(model, mesh, {&material, 1}, cells, 0.0);
  model.dt = courant * 0.1 / bar.wave_speed();
  EXPECT_NEAR(critical.step, 0.1 / bar.wave_speed(), 5e-4 * critical.step);
  return model;
}

struct Hit {
  long long steps = 0;
  double force_error = 0.0;  ///< rms of r_n/Δt - ρcv while the wave is on its way [Pa]
  double rebound = 0.0;      ///< of the center of mass [m/s]
  double loss = 0.0;         ///< in impacts, of the energy
};

/// @param height of the finest element
Hit hit(const Model& model, double height) {
  const std::vector<Vec2> none(model.n_nodes()), v(model.n_nodes(), Vec2{0.0, -speed});
  const double mass = std::accumulate(model.mass.begin(), model.mass.end(), 0.0);
  test::Stepping run(model, start(model, none, v));
  const test::FloatingPointTraps traps;
  Hit h;
  int samples = 0;
  run.advance_to(2.0, [&](const StepReport& step) {
    if (step.frame.time <= 0.56 || step.frame.time >= 1.12) return;
    h.force_error += std::pow(step.contact.impulse.y / model.dt - full, 2);
    ++samples;
  });
  h.steps = run.report().step;
  h.force_error = std::sqrt(h.force_error / samples);
  h.rebound = test::momentum(model, run.state()).linear.y / mass;
  h.loss = run.balance().works.loss_impact / (0.5 * mass * speed * speed);
  // Round-off of K u, of a bar that flies some meters in the frame its displacements are of.
  EXPECT_LT(run.balance().relative, 1e-12 * 0.02 / height);
  return h;
}

struct TipRow {
  double height;  ///< of a fine element [m]
  bool implicit;
  long long steps;
  double force_error, rebound;
};

class FineTip : public testing::TestWithParam<TipRow> {};

}  // namespace

TEST_P(FineTip, OfABarThatHitsAWall) {
  const TipRow& row = GetParam();
  const Hit h = hit(tipped_model(row.height, row.implicit), row.height);
  RecordProperty("force_error", fmt::format("{:.4f}", h.force_error));
  RecordProperty("rebound", fmt::format("{:.6f}", h.rebound));
  RecordProperty("loss", fmt::format("{:.6f}", h.loss));
  EXPECT_EQ(h.steps, row.steps);
  EXPECT_NEAR(h.force_error, row.force_error, 0.051 * (row.force_error > 100.0 ? 1.0 : 0.1));
  EXPECT_NEAR(h.rebound, row.rebound, 5.1e-5);
}

INSTANTIATE_TEST_SUITE_P(All, FineTip,
                         testing::Values(TipRow{0.01, false, 6587, 140.4, 9.8882},
                                         TipRow{0.01, true, 667, 6.94, 9.9166},
                                         TipRow{0.002, false, 32925, 259.8, 9.8778},
                                         TipRow{0.002, true, 667, 24.3, 9.9139}),
                         [](const auto& p) {
                           return fmt::format("{}_{}", p.param.implicit ? "implicit" : "explicit",
                                              p.param.height < 0.005 ? "fiftieth" : "tenth");
                         });

TEST(FineTip, LosesWhatTheFootHasAndWhatItsNeighboursDo) {
  EXPECT_NEAR(hit(tipped_model(0.01, true), 0.01).loss, 0.00455, 5e-6);
}

namespace {

/// The smooth disk with a belt of 8 GPa in its tenth layer of twelve, of the same density.
test::Built belted(test::DiskCase& c, bool implicit) {
  c = test::rolling_disk(12, 180);
  c.beta = 0.0;
  c.motion.height = Table({{0.0, 0.31}, {0.02, 0.29}});
  c.motion.start_x = 0.0;
  test::Built b = test::build(c);
  fem::Material belt = c.material;
  belt.youngs_modulus = 8.0e9;
  const std::vector<char> cells = test::cells_of_layers(b.mesh, {10});
  test::set_region(b, c, cells, belt);
  if (implicit) test::set_implicit(b, c, cells);
  test::add_ground(b, {}, {0.3, 0.0});
  return b;
}

struct Roll {
  long long steps = 0;
  Vec2 force;  ///< mean over 0.05 s < t <= 0.06 s [N/m]
  double relative = 0.0;
};

Roll roll(bool implicit, StiffnessOperator of) {
  test::DiskCase c;
  const test::Built b = belted(c, implicit);
  test::Stepping run(b, of);
  const test::FloatingPointTraps traps;
  Roll r;
  double time = 0.0;
  run.advance_to(0.06, [&](const StepReport& step) {
    if (step.frame.time <= 0.05) return;
    r.force += step.contact.impulse.plane();
    time += b.model.dt;
  });
  r.force = r.force / time;
  r.steps = run.report().step;
  r.relative = run.balance().relative;
  return r;
}

class Belt : public testing::TestWithParam<StiffnessOperator> {};

}  // namespace

TEST_P(Belt, RollsWithATenthOfTheSteps) {
  const Roll plain = roll(false, StiffnessOperator::cyclic), implicit = roll(true, GetParam());
  RecordProperty("steps", fmt::format("{} {}", plain.steps, implicit.steps));
  RecordProperty("force_y", fmt::format("{:.2f} {:.2f}", plain.force.y, implicit.force.y));
  RecordProperty("force_x", fmt::format("{:.2f} {:.2f}", plain.force.x, implicit.force.x));
  RecordProperty("ledger", fmt::format("{:.3g}", implicit.relative));
  EXPECT_GT(static_cast<double>(plain.steps), 9.0 * static_cast<double>(implicit.steps));
  EXPECT_NEAR(static_cast<double>(plain.steps), 17725.0, 10.0);  // the step is found to 5e-4
  EXPECT_NEAR(static_cast<double>(implicit.steps), 1865.0, 1.0);
  EXPECT_NEAR(plain.force.y, 2.69593e5, 60.0);  // of its ripple, by a window a step longer
  // The mean over ten nodes that pass scatters with the step: 2.6886e5 to 2.6916e5 at 0.78 to 0.82
  // of the critical one, and tends to that of the explicit step.
  EXPECT_NEAR(implicit.force.y, 2.69060e5, 200.0);
  EXPECT_NEAR(implicit.force.y, plain.force.y, 0.003 * plain.force.y);
  EXPECT_NEAR(implicit.force.x, plain.force.x, 0.01 * std::abs(plain.force.x));
  EXPECT_LT(implicit.relative, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Both, Belt, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });

namespace {

struct Variant {
  const char* name;
  int layer;  ///< that is implicit, of three
  double beta, spin;
  bool contact;
};

class ImplicitLimit : public testing::TestWithParam<std::tuple<Variant, StiffnessOperator>> {};

/// As V13, but that the undamped body with a stiff layer at the ground does not roll: a polygon, at
/// a fixed height, takes up energy without end. Largest energy over the run, of a start with random
/// velocities.
double largest_energy(const std::tuple<Variant, StiffnessOperator>& of, double safety, int steps) {
  const Variant& v = std::get<0>(of);
  auto c = test::rubber_annulus(3, 36);
  c.beta = v.beta;
  c.safety = safety;
  c.motion.angular_velocity = Table(v.spin);
  c.motion.speed = Table(0.3 * v.spin);
  c.motion.height = Table(0.298);
  test::Built b = test::build(c);
  const std::vector<char> cells = test::cells_of_layers(b.mesh, {v.layer});
  fem::Material stiff = c.material;
  stiff.youngs_modulus *= 400.0;
  test::set_region(b, c, cells, stiff);
  const double plain = b.critical.step;
  test::set_implicit(b, c, cells);
  EXPECT_GT(b.critical.step, 5.0 * plain);
  if (v.contact) test::add_ground(b, {}, {0.3, 0.0});
  std::mt19937 random(11);
  std::uniform_real_distribution<double> x(-1.0, 1.0);
  std::vector<Vec2> u0(b.model.n_nodes()), v0(b.model.n_nodes());
  for (Vec2& velocity : v0) velocity = {x(random), x(random)};
  // The energy of an implicit node is ½ Δt²/4 K_I v² more than its kinetic one: not to begin with.
  for (const int node : b.model.implicit->nodes) v0[static_cast<std::size_t>(node)] = {};
  const test::NoStepTraps no_traps;
  test::Stepping run(b, std::get<1>(of), u0, v0);
  double largest = 0.0;
  const auto look = [&](const StepReport& s) { largest = std::max(largest, s.balance.kinetic); };
  for (int n = 0; n < steps && std::isfinite(largest) && largest < 1e30; n += 50)
    run.advance(50, look);
  return largest;
}

}  // namespace

TEST_P(ImplicitLimit, StableBelowDivergentAboveTheStepOfTheOthers) {
  const double reference = largest_energy(GetParam(), 0.5, 10000);
  EXPECT_LT(largest_energy(GetParam(), 0.99, 10000), 10.0 * reference);
  EXPECT_GT(largest_energy(GetParam(), 1.01, 10000), 1e9 * reference);
}

INSTANTIATE_TEST_SUITE_P(Implicit, ImplicitLimit,
                         testing::Combine(testing::Values(Variant{"plain", 2, 0.0, 0.0, false},
                                                          Variant{"damped", 2, 1e-5, 0.0, false},
                                                          Variant{"rim", 1, 2e-5, 50.0, true},
                                                          Variant{"inside", 2, 0.0, 50.0, true},
                                                          Variant{"ground", 3, 0.0, 0.0, true},
                                                          Variant{"all", 3, 2e-5, 50.0, true}),
                                          testing::ValuesIn(test::both_operators)),
                         [](const auto& p) {
                           return test::name(std::get<0>(p.param).name, std::get<1>(p.param));
                         });

}  // namespace v32_implicit_elements
