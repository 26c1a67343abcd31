// SPDX-License-Identifier: BSD-3-Clause
/// The critical step with a rim that forces move, by runs in flight: bounded below it, growing
/// above the step of the largest frequency that the body and its rim really have.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "rondo/fem/stiffness_product.hpp"
#include "rondo/model/stability/rim_step.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace rim_growth_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

struct Flight {
  int radial, circumferential;
  double mass, inertia;  ///< of the rim without the bonded nodes
  double alpha = 0.0, beta = 0.0;
};

class Wheel {
 public:
  explicit Wheel(const Flight& of) {
    test::DiskCase c;
    c.disk.radial = of.radial;
    c.disk.circumferential = of.circumferential;
    c.alpha = of.alpha;
    c.beta = of.beta;
    built_ = test::build(c);
    RimBody rim;
    rim.free_x = rim.free_y = rim.free_spin = true;
    rim.mass = of.mass;
    rim.inertia = of.inertia;
    test::set_rim(built_, rim);
    damping_ = {of.beta, of.alpha};
  }

  [[nodiscard]] CriticalStep bound() const {
    const Model& m = built_.model;
    RimDofs rim;
    rim.inertia = {m.rim->mass, m.rim->mass, m.rim->inertia};
    const auto product = [&](std::span<const Vec2> u, std::span<Vec2> out) {
      fem::apply(m.stiffness, u, out, 1);
    };
    return with_rim(built_.critical, fem::assemble_sector(built_.mesh, built_.materials), m.mass,
                    rim_frequencies(product, m.mass, m.reference, m.free, rim), damping_);
  }

  /// By powers of what forces do to places, from below: to some 1e-4.
  [[nodiscard]] double largest_frequency() const {
    const Model& m = built_.model;
    std::vector<Vec2> z = random_field(1), u(z.size()), q(z.size());
    Vec2 c{0.3, -0.2};
    double theta = 0.5, square = 0.0;
    for (int i = 0; i < 3000; ++i) {
      double energy = m.rim->mass * dot(c, c) + m.rim->inertia * theta * theta;
      for_free_nodes(m, [&](std::size_t k) {
        u[k] = z[k] - c - theta * turn90(m.reference[k]);
        energy += m.mass[k] * dot(z[k], z[k]);
      });
      fem::apply(m.stiffness, u, q, 1);
      const double scale = 1.0 / std::sqrt(energy);
      Vec2 sum;
      double moment = 0.0, work = 0.0;
      for_free_nodes(m, [&](std::size_t k) {
        sum += q[k];
        moment += cross(m.reference[k], q[k]);
        work += dot(u[k], q[k]);
        z[k] = (scale / m.mass[k]) * q[k];
      });
      c = -(scale / m.rim->mass) * sum;
      theta = -(scale / m.rim->inertia) * moment;
      square = work / energy;
    }
    return std::sqrt(square);
  }
  [[nodiscard]] double step_of(double omega) const { return critical_step_of(omega, damping_); }

  /// Kinetic energy over that of the start, the largest of the run: up to 1e12.
  [[nodiscard]] double growth(double dt, StiffnessOperator of) {
    const test::NoStepTraps no_traps;  // above the bound a wheel may leave what numbers can hold
    built_.model.dt = dt;
    const std::vector<Vec2> none(built_.model.n_nodes());
    test::Stepping run(built_, of, none, random_field(2));
    run.advance(1);
    const double start = kinetic(run.report());
    double largest = 0.0;
    for (int n = 0; n < 20000 && largest < 1e12 * start && std::isfinite(largest); n += 10)
      run.advance(10, [&](const StepReport& r) { largest = std::max(largest, kinetic(r)); });
    return largest / start;
  }

 private:
  static double kinetic(const StepReport& r) { return r.balance.kinetic + r.balance.kinetic_rim; }
  [[nodiscard]] std::vector<Vec2> random_field(unsigned seed) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(-1.0, 1.0);
    std::vector<Vec2> v(built_.model.n_nodes());
    for (Vec2& of : v) of = {x(random), x(random)};
    return v;
  }

  test::Built built_;
  LaggedDamping damping_;
};

class RimGrowth : public testing::TestWithParam<StiffnessOperator> {};

}  // namespace

/// The bound is sharp on 6×90, whatever the rim weighs. On 1×12 with a rim that weighs no more than
/// its bonded nodes it is above what body and rim have: there the run grows above the step of that.
TEST_P(RimGrowth, StableBelowTheBoundGrowingAboveWhatThereIs) {
  for (const Flight& f :
       {Flight{1, 12, 0.0, 0.0}, Flight{1, 12, 1.0, 0.02}, Flight{1, 12, 100.0, 1.0},
        Flight{1, 12, 0.0, 0.0, 200.0, 2e-5}, Flight{6, 90, 0.0, 0.0}, Flight{6, 90, 1.0, 0.02},
        Flight{6, 90, 0.0, 0.0, 200.0, 2e-5}}) {
    SCOPED_TRACE(testing::Message() << f.radial << " layers, rim " << f.mass << ", α " << f.alpha);
    Wheel wheel(f);
    const CriticalStep bound = wheel.bound();
    const double omega = wheel.largest_frequency();
    EXPECT_GE(bound.omega, omega * (1.0 - 1e-12));
    EXPECT_LE(bound.omega, omega * (f.radial == 1 ? 1.3 : 1.005));
    EXPECT_LT(wheel.growth(0.99 * bound.step, GetParam()), 10.0);
    EXPECT_GT(wheel.growth(1.01 * wheel.step_of(omega), GetParam()), 1e9);
    if (f.radial > 1) {
      EXPECT_GT(wheel.growth(1.01 * bound.step, GetParam()), 1e9);
    }
  }
}

/// α is lagged and shortens the step, on the wheel of V22: by 3 %.
TEST_P(RimGrowth, StrongMassDampingShortensTheStep) {
  Wheel wheel({12, 180, 100.0, 1.0, 4000.0, 2e-5});
  const CriticalStep bound = wheel.bound();
  EXPECT_LT(bound.step, 0.97 * critical_step_of(bound.omega, {2e-5, 0.0}));
  EXPECT_LT(wheel.growth(0.999 * bound.step, GetParam()), 10.0);
  EXPECT_GT(wheel.growth(1.001 * bound.step, GetParam()), 1e9);
}

/// A rim that is light moves against the body: what α damps is faster than what it weighs.
TEST_P(RimGrowth, ALightRimIsDampedByMoreThanAlpha) {
  Wheel wheel({6, 90, 1.0, 0.02, 4000.0, 0.0});
  const CriticalStep bound = wheel.bound();
  EXPECT_GT(wheel.growth(0.2 * wheel.step_of(bound.omega), GetParam()), 1e9);
  EXPECT_LT(wheel.growth(0.999 * bound.step, GetParam()), 10.0);
  EXPECT_GT(wheel.growth(1.01 * bound.step, GetParam()), 100.0);  // a turn in a step has an end
}

INSTANTIATE_TEST_SUITE_P(Both, RimGrowth, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });

}  // namespace rim_growth_test
