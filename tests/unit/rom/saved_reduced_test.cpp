// SPDX-License-Identifier: BSD-3-Clause
/// What goes on from a saved state has the bits of what was never stopped.
#include "rondo/rom/saved_reduced.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "rondo/rom/integrator.hpp"
#include "whole_space.hpp"

namespace saved_reduced_test {

using namespace rondo;
using namespace rondo::rom;
using namespace rondo::rom::test;

namespace {

constexpr long long steps = 30;
/// Every fifth column is left out: with more of them there are points that the ground cannot push.
constexpr Index fewer = 5;

dynamics::State start_of(const Reduced& r) {
  const std::vector<Vec2> none(r.full.model.n_nodes());
  return dynamics::start(r.full.model, none, none);
}

Reduced on_rim(dynamics::RimBody rim) {
  DiskCase c = rondo::test::rolling_disk(2, 48);
  c.motion.start_x = -0.1;
  c.motion.height = dynamics::Table(0.3);
  c.motion.gravity = dynamics::Table(9.81);
  Reduced r = whole_space(c, {}, fewer);
  rim.mass = 60.0;
  rim.inertia = 1.0;
  rondo::test::set_rim(r.full, rim);
  r.model.rim = make_rim_modes(r.full.mesh, r.full.model.mass, r.model);
  rondo::test::add_ground(r.full, rondo::test::ledge(), {0.4, 0.2});
  r.full.model.dt *= 10.0;
  return r;
}

Reduced loaded() {
  dynamics::RimBody rim;
  rim.free_y = rim.free_spin = true;
  rim.force_y = dynamics::Table({{0.0, 0.0}, {0.002, -1.5e5}});
  rim.brake = dynamics::Table({{0.0, 0.0}, {0.003, 5e3}});
  rim.support_y = {1e5, 4e4, 0.31};
  return on_rim(rim);
}

using Lead = std::function<RimVector(long long step, double dt)>;

/// All numbers that a step leaves, one after another.
void add_numbers(const dynamics::StepReport& r, std::vector<double>& to) {
  const dynamics::Works& w = r.balance.works;
  for (const double value : {static_cast<double>(r.step),
                             r.frame.angle,
                             r.frame.spin,
                             r.frame.center.x,
                             r.frame.center.y,
                             r.frame.turn_before,
                             r.frame.advance_before.y,
                             r.contact.impulse.x,
                             r.contact.impulse.y,
                             r.contact.angular_impulse,
                             r.contact.dissipation_friction,
                             static_cast<double>(r.contact.nodes),
                             r.rim.force.x,
                             r.rim.force.y,
                             r.rim.torque,
                             r.rim.spin,
                             r.rim.velocity.y,
                             r.balance.kinetic,
                             r.balance.strain,
                             r.balance.residual,
                             w.scheme,
                             w.held,
                             w.dissipation_stiffness})
    to.push_back(value);
}

std::vector<double> make_steps(ReducedIntegrator& of, long long from, long long to, double dt,
                               const Lead& lead) {
  std::vector<double> numbers;
  std::vector<dynamics::StepReport> report(1);
  for (long long n = from; n < to; ++n) {
    if (lead) of.lead(lead(n + 1, dt));
    of.advance(report);
    add_numbers(report[0], numbers);
  }
  for (const VectorXd* v : {&of.displacement(), &of.velocity(), &of.state_velocity()})
    numbers.insert(numbers.end(), v->begin(), v->end());
  numbers.push_back(of.state_velocity_angle());
  return numbers;
}

/// Another integrator, and the same one after it has gone on, both from the cut.
void expect_same_bits(Reduced r, const Lead& lead = {}, long long whole = steps) {
  const long long cut = whole / 2 + 1;
  const double dt = r.full.model.dt;
  const dynamics::State state = start_of(r);
  ReducedIntegrator first = r.start(state);
  make_steps(first, 0, cut, dt, lead);
  const SavedReducedState saved = first.save();
  const std::vector<double> expected = make_steps(first, cut, whole, dt, lead);
  const bool touched = std::ranges::any_of(expected, [](double x) { return std::abs(x) > 1e-3; });
  ASSERT_TRUE(touched);
  ReducedIntegrator second = r.start(state);
  ASSERT_TRUE(second.fits(saved));
  second.restore(saved);
  EXPECT_EQ(make_steps(second, cut, whole, dt, lead), expected);
  first.restore(saved);
  EXPECT_EQ(make_steps(first, cut, whole, dt, lead), expected);
  EXPECT_GT(first.contacts().size(), 0U);
}

TEST(SavedReducedState, GoesOnToTheSameBits) {
  expect_same_bits(pressed({}, fewer));
  expect_same_bits(pressed({ContactForm::nodes}, fewer));
  expect_same_bits(pressed({ContactForm::nodes, ModelFrame::turning, StepScheme::central}), {},
                   10 * steps);
}

TEST(SavedReducedState, GoesOnWithARimThatMoves) {
  expect_same_bits(loaded());
}

TEST(SavedReducedState, GoesOnWithARimThatIsLed) {
  expect_same_bits(on_rim({}), [](long long n, double dt) {
    const double t = static_cast<double>(n) * dt;
    return RimVector(10.0, -0.5 * std::min(t, 1e-2) / 1e-2, -33.0 - 200.0 * t);
  });
}

TEST(SavedReducedState, TheStartIsOneToo) {
  Reduced r = loaded();
  const dynamics::State state = start_of(r);
  ReducedIntegrator first = r.start(state), second = r.start(state);
  const SavedReducedState saved = first.save();
  const std::vector<double> expected = make_steps(first, 0, steps, r.full.model.dt, {});
  make_steps(second, 0, 5, r.full.model.dt, {});
  second.restore(saved);
  EXPECT_EQ(make_steps(second, 0, steps, r.full.model.dt, {}), expected);
}

TEST(SavedReducedState, OfAnotherModelDoesNotFit) {
  Reduced here = loaded(), other = pressed({}, fewer);
  ReducedIntegrator a = here.start(start_of(here)), b = other.start(start_of(other));
  SavedReducedState saved = a.save();
  EXPECT_TRUE(a.fits(saved));
  EXPECT_FALSE(b.fits(saved));
  saved.contact->impulses.emplace_back(1000000, Vec2{});
  EXPECT_FALSE(a.fits(saved));
}

/// Tables are found by their phases: two of one, or more than there is room for, have no place.
TEST(SavedReducedState, PhasesThatAreOneDoNotFit) {
  Reduced r = pressed({ContactForm::nodes}, fewer);
  ReducedIntegrator of = r.start(start_of(r));
  make_steps(of, 0, 5, r.full.model.dt, {});
  const SavedReducedState saved = of.save();
  ASSERT_TRUE(of.fits(saved));
  SavedReducedState twice = saved, many = saved, none = saved;
  twice.contact->phases.push_back(saved.contact->phases.front());
  EXPECT_FALSE(of.fits(twice));
  for (int k = 0; k < 1100; ++k) many.contact->phases.push_back({2.0 + 1e-3 * k, 0, {}});
  EXPECT_FALSE(of.fits(many));
  none.contact->phases.front().share = std::nan("");
  EXPECT_FALSE(of.fits(none));
}

/// A rim that is led goes where the mean of its velocities takes it, and what holds it is what the
/// momentum of the whole says.
TEST(LedRim, GoesWithItsVelocities) {
  Reduced r = on_rim({});
  const double dt = r.full.model.dt;
  ReducedIntegrator of = r.start(start_of(r));
  std::vector<dynamics::StepReport> report(1);
  const double start = r.full.model.motion.angular_velocity.at(0.0);
  double height = 0.3, before = 0.0;
  for (int n = 1; n <= 20; ++n) {
    const double v = 0.01 * n * n;
    of.lead(RimVector(10.0, v, -33.0));
    of.advance(report);
    height += 0.5 * dt * (before + v);
    before = v;
    EXPECT_NEAR(report[0].frame.center.y, height, 1e-15);
    EXPECT_EQ(report[0].rim.velocity.y, v);
    EXPECT_EQ(report[0].rim.spin, 33.0);
    EXPECT_NEAR(report[0].frame.angle, -33.0 * n * dt - 0.5 * dt * (start - 33.0), 1e-12);
    EXPECT_LT(report[0].balance.relative, 1e-12);
  }
}

}  // namespace

}  // namespace saved_reduced_test
