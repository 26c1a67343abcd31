// SPDX-License-Identifier: BSD-3-Clause
/// @file  A wheel whose rim is moved by forces, V22 to V25: the base case of all of them, and the
/// quantities measured from its steps.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "rondo/analysis/build/build.hpp"
#include "rondo/case/case.hpp"
#include "support/stepping.hpp"

namespace rondo::test {

/// Changes of the case, like those of --set.
using Settings = std::vector<std::string>;

/// The wheel rolls at 10 m/s under 150 kN/m.
inline const std::string wheel_text = R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 12
circumferential = 180
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = 33.7
speed = 10.0
height = 0.30
[rim]
free = ["height", "angular_velocity"]
mass = 100.0
inertia = 1.0
force_y = [[0, 0], [0.01, -1.5e5]]
[rim.support.y]
damping = 6.0e4
[ground]
profile = "flat"
friction = 0.6
[time]
end = 1.0
)";

inline Settings with(Settings a, const Settings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Means over a time window, with equal weights of the steps.
struct WheelMeans {
  double spin = 0.0;   ///< ω, > 0 clockwise                                       [rad/s]
  double speed = 0.0;  ///< V                                                      [m/s]
  double height = 0.0;
  Vec2 force;      ///< of the ground                                      [N/m]
  Vec2 hub_force;  ///< of the reactions on the center                           [N/m]
  double hub_torque = 0.0;
  int steps = 0;

  void see(const dynamics::StepReport& report, double dt) {
    ++steps;
    const double k = 1.0 / steps;
    const auto add = [k](auto& mean, auto value) { mean += k * (value - mean); };
    add(spin, report.rim.spin);
    add(speed, report.rim.velocity.x);
    add(height, report.frame.center.y);
    add(force, (1.0 / dt) * report.contact.impulse.plane());
    add(hub_force, report.rim.force);
    add(hub_torque, report.rim.torque);
  }
};

/// A least-squares line through V(t).
class SpeedFit {
 public:
  void see(const dynamics::StepReport& report) {
    const double t = report.frame.time - origin, v = report.rim.velocity.x;
    n_ += 1.0, t_ += t, v_ += v, tt_ += t * t, tv_ += t * v;
  }
  [[nodiscard]] double acceleration() const { return (n_ * tv_ - t_ * v_) / (n_ * tt_ - t_ * t_); }

 private:
  static constexpr double origin = 0.4;  // close to the windows [s]
  double n_ = 0.0, t_ = 0.0, v_ = 0.0, tt_ = 0.0, tv_ = 0.0;
};

/// A run with the operator and the step size of the case.
class Wheel {
 public:
  explicit Wheel(const Settings& settings)
      : setup_(study::build(study::read_case_text("wheel.toml", wheel_text, settings), 1)),
        run_(setup_.model, dynamics::start(setup_.model, setup_.displacement, setup_.velocity)) {}

  /// Calls look(report) for the steps after `from` up to the first one at or after `to`, at which a
  /// run to that time ends; earlier steps are skipped [s].
  template <class Look>
  void look(double from, double to, Look&& look) {
    run_.advance_to(to, [&](const dynamics::StepReport& report) {
      if (report.frame.time > from) look(report);
    });
  }
  WheelMeans means(double from, double to) {
    WheelMeans m;
    look(from, to, [&](const dynamics::StepReport& report) { m.see(report, dt()); });
    return m;
  }
  double acceleration(double from, double to) {
    SpeedFit fit;
    look(from, to, [&](const dynamics::StepReport& report) { fit.see(report); });
    return fit.acceleration();
  }

  [[nodiscard]] double dt() const { return setup_.model.dt; }
  [[nodiscard]] const study::Setup& setup() const { return setup_; }
  [[nodiscard]] Stepping& run() { return run_; }

 private:
  study::Setup setup_;
  Stepping run_;
};

}  // namespace rondo::test
