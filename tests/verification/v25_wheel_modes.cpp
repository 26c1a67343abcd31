// SPDX-License-Identifier: BSD-3-Clause
/// V25: small motions of a standing wheel under its load, rocking, heaving, and to and fro against
/// its own spin. Expected: an eigen-solve of the second variation of its energy about the state of
/// statics (support/loaded_wheel.hpp), and the frequencies of another one (docs/validation.md).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>

#include "support/loaded_wheel.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace v25_wheel_modes {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr double load = 1e5;  // N/m

test::Built standing_wheel() {
  test::DiskCase c;
  c.disk.radial = 12;
  c.disk.circumferential = 180;
  c.alpha = c.beta = 0.0;
  test::Built b = test::build(c);
  RimBody rim;
  rim.free_x = rim.free_y = rim.free_spin = true;
  rim.mass = 100.0;
  rim.inertia = 1.0;
  test::set_rim(b, rim);
  return b;
}

/// A coordinate of a mode, sampled.
struct Course {
  std::vector<double> time, value;

  /// ω of the sinusoid nearest to it, about `near`, by golden sections.
  [[nodiscard]] double frequency(double near) const {
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    double low = 0.999 * near, high = 1.001 * near;
    while (high - low > 1e-11 * near) {
      const double a = high - golden * (high - low), b = low + golden * (high - low);
      (misfit(a) < misfit(b) ? high : low) = misfit(a) < misfit(b) ? b : a;
    }
    return 0.5 * (low + high);
  }

 private:
  [[nodiscard]] double misfit(double omega) const {
    const auto n = static_cast<Eigen::Index>(time.size());
    const Eigen::Map<const Eigen::ArrayXd> t(time.data(), n);
    const Eigen::Map<const Eigen::VectorXd> y(value.data(), n);
    Eigen::MatrixXd a(n, 3);
    a << Eigen::VectorXd::Ones(n), (omega * t).cos().matrix(), (omega * t).sin().matrix();
    return (a * a.householderQr().solve(y) - y).norm();
  }
};

/// The ground's forces are not there in the half step of the start: their impulse is put into v_0.
std::vector<Vec2> without_the_start(const test::Built& b, const std::vector<Vec2>& u) {
  std::vector<Vec2> force(u.size()), v(u.size());
  fem::apply(b.model.stiffness, u, force, 1);
  for_free_nodes(b.model,
                 [&](std::size_t k) { v[k] = (0.5 * b.model.dt / b.model.mass[k]) * force[k]; });
  return v;
}

}  // namespace

/// So small a push (1e-6 m/s, 1e-8 of the load) that the load on the nodes that stick stays the
/// same: the frequency of rocking changes with it.
TEST(WheelModes, FrequenciesUnderLoad) {
  test::Built b = standing_wheel();
  const test::LoadedWheel at = test::load_wheel(b, load, 0.0);
  const auto modes = test::WheelModes::lowest(b, at, 3);
  constexpr std::array expected{12.27286, 263.9443, 351.5368};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(modes[i].omega, expected[i], i == 0 ? 1e-5 : 1e-4);  // one in the last digit
  test::add_ground(b, {}, {5.0, 0.0});
  b.model.motion.speed = Table(1e-6);
  b.model.motion.height = Table(at.height - 1e-11);  // so that all nodes touch
  b.model.rim->force_y = Table(-load * (1.0 + 1e-8));
  test::Stepping run(b, StiffnessOperator::cyclic, at.u, without_the_start(b, at.u));
  const test::FloatingPointTraps traps;
  std::array<Course, 3> courses;
  while (run.report().frame.time < 0.6) {
    run.advance(10);
    ASSERT_EQ(run.report().contact.sticking, static_cast<int>(at.touching.size()));
    for (std::size_t i = 0; i < 3; ++i) {
      courses[i].time.push_back(run.report().frame.time);
      courses[i].value.push_back(test::WheelModes::coordinate(modes[i], b, at, run.state()));
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    // Central differences: ω̃ = (2/Δt) asin(ωΔt/2).
    const double dt = b.model.dt, omega = 2.0 / dt * std::asin(0.5 * modes[i].omega * dt);
    const double found = courses[i].frequency(omega);
    RecordProperty(fmt::format("mode_{}", i), fmt::format("{:.8f} of {:.8f}", found, omega));
    EXPECT_NEAR(found, omega, 1e-7 * omega);
  }
}

}  // namespace v25_wheel_modes
