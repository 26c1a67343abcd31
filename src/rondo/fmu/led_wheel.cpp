// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fmu/led_wheel.hpp"

#include <fmt/format.h>

#include <cmath>

#include "rondo/core/index.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::fmu {
namespace {

std::string in_the_ground(double above, double rim) {
  return fmt::format("its hub is {:.4g} m above the ground, and the rim, of {:.4g} m, is in it",
                     above, rim);
}

class PlaneWheel final : public LedWheel {
 public:
  PlaneWheel(const study::Setup& setup, study::PreparedWheel& wheel, const dynamics::State& start)
      : LedWheel(setup.model), run_(setup.model, *wheel.ring, wheel.model, wheel.figures, start) {}

  void begin(const rom::HubVelocity& from) override {
    sums_ = {};
    from_ = to_ = from;
  }
  const dynamics::StepReport& step(const rom::HubVelocity& to) override {
    run_.lead({to.along.x, to.along.y, to.spin});
    make_step();
    sums_.held += last().rim.force;
    sums_.torque += last().rim.torque;
    sums_.contact += last().contact.impulse.plane() / model_.dt;
    ++sums_.n;
    to_ = to;
    return last();
  }
  /// (F.1), (F.2): forces that hold the hub, without inertia and weight of the rigid body.
  void fill(double height, double width, Values& to) const override {
    const double n = sums_.n, length = n * model_.dt;
    const Vec2 rate = (to_.along - from_.along).plane() / length,
               gravity = model_.motion.gravity_at(0.0);
    const double mass = rim().whole_mass();
    to.force_x = width * (mass * (rate.x - gravity.x) - sums_.held.x / n);
    to.force_up = width * (mass * (rate.y - gravity.y) - sums_.held.y / n);
    to.torque =
        width * (-rim().whole_inertia() * (to_.spin - from_.spin) / length - sums_.torque / n);
    to.contact_force_x = width * sums_.contact.x / n;
    to.contact_force_up = width * sums_.contact.y / n;
    const Vec2 center = last().frame.center.plane();
    to.hub_x = center.x;
    to.hub_height = center.y + height;
    to.hub_angle = -last().frame.angle;
    to.loaded_radius = model_.contact->ground.distance(center);
    to.contact_length = last().contact.length;
  }
  [[nodiscard]] std::string misplaced(double rim) const override {
    const double above = model_.contact->ground.distance(last().frame.center.plane());
    return above > rim ? std::string() : in_the_ground(above, rim);
  }

 private:
  [[nodiscard]] rom::ReducedRun& run() noexcept override { return run_; }
  [[nodiscard]] const rom::ReducedRun& run() const noexcept override { return run_; }

  /// What the steps since the last communication point have added up.
  struct Sums {
    Vec2 held, contact;  ///< forces [N/m]
    double torque = 0.0;
    int n = 0;
  };
  rom::WheelRun run_;
  rom::HubVelocity from_, to_;
  Sums sums_;
};

class SpaceWheel final : public LedWheel {
 public:
  SpaceWheel(const study::Setup& setup, study::PreparedWheel& wheel, const dynamics::State& start,
             const rom::HubStart& hub)
      : LedWheel(setup.model),
        run_(setup.model, *wheel.solid, wheel.model, wheel.law_residual, wheel.figures, start,
             hub) {}

  void begin(const rom::HubVelocity& from) override {
    sums_ = {};
    velocity_ = attitude().from_heading(from.along);
    spin_ = from.spin;
  }
  const dynamics::StepReport& step(const rom::HubVelocity& to) override {
    run_.lead(to);
    make_step();
    add_step(to);
    return last();
  }
  void fill(double height, double /*width*/, Values& to) const override {
    const double n = sums_.n;
    to.force_x = sums_.force.x / n;
    to.force_left = 0.0 - sums_.force.z / n;
    to.force_up = sums_.force.y / n;
    to.moment_x = sums_.moment.x / n;
    to.moment_left = 0.0 - sums_.moment.z / n;
    to.moment_up = sums_.moment.y / n;
    to.torque = sums_.torque / n;
    to.contact_force_x = sums_.contact.x / n;
    to.contact_force_left = 0.0 - sums_.contact.z / n;
    to.contact_force_up = sums_.contact.y / n;
    to.contact_moment_x = sums_.contact_moment.x / n;
    to.contact_moment_left = 0.0 - sums_.contact_moment.z / n;
    to.contact_moment_up = sums_.contact_moment.y / n;
    const Vec3 center = last().frame.center;
    to.hub_x = center.x;
    to.hub_left = 0.0 - center.z;
    to.hub_height = center.y + height;
    to.hub_angle = -last().frame.angle;
    to.camber = run_.camber();
    to.yaw = run_.yaw();
    to.loaded_radius = above() / std::cos(run_.camber());
    to.contact_length = last().contact.length;
  }
  void weigh(Values& to) const override {
    LedWheel::weigh(to);
    double aside = 0.0;
    for (const int k : model_.free) {
      const double z = model_.solid->axial[at(k)];
      aside += model_.mass[at(k)] * z * z;
    }
    to.tyre_inertia_across = 0.5 * to.tyre_inertia + aside;
  }
  [[nodiscard]] std::string misplaced(double rim) const override {
    if (std::abs(run_.camber()) > most_camber)
      return fmt::format("its camber is {:.4g} rad: at most {} either way", run_.camber(),
                         most_camber);
    const double along = above() / std::cos(run_.camber());
    return along > rim ? std::string() : in_the_ground(along, rim);
  }

 private:
  [[nodiscard]] rom::ReducedRun& run() noexcept override { return run_; }
  [[nodiscard]] const rom::ReducedRun& run() const noexcept override { return run_; }

  /// What the steps since the last communication point have added up. Components are along the
  /// heading, out of the ground, and to the right.
  struct Sums {
    Vec3 force, moment, contact, contact_moment;  ///< [N], [N m]
    double torque = 0.0;
    int n = 0;
  };

  [[nodiscard]] rom::WheelAttitude attitude() const noexcept {
    return rom::WheelAttitude(run_.camber(), run_.yaw());
  }
  /// Height of the hub over the ground [m].
  [[nodiscard]] double above() const noexcept {
    return dynamics::distance_in_space(*model_.contact, last().frame.center);
  }
  /// (F.3): what holds the hub, without inertia and weight of the rigid body, and the moments of
  /// the ground about the hub, of which the part about the axle is the torque.
  void add_step(const rom::HubVelocity& to) noexcept {
    const rom::WheelAttitude now = attitude();
    const Vec3 velocity = now.from_heading(to.along), gravity(model_.motion.gravity_at(0.0));
    const rom::HubReport& hub = run_.hub();
    const double dt = model_.dt, camber = run_.camber(), lean = std::tan(camber);
    sums_.force +=
        rim().whole_mass() * now.to_heading((velocity - velocity_) / dt - gravity) - hub.held;
    const double torque = hub.torque - rim().whole_inertia() * (to.spin - spin_) / dt;
    sums_.torque += torque;
    // The axle to the left is (0, -sin γ, -cos γ) along the heading, n and t2.
    sums_.moment +=
        Vec3(hub.moment.x, hub.moment.y, 0.0 - torque / std::cos(camber) - lean * hub.moment.y);
    sums_.contact += hub.force;
    const double height = above();
    sums_.contact_moment += hub.moment + cross({0.0, height, 0.0 - lean * height}, hub.force);
    ++sums_.n;
    velocity_ = velocity;
    spin_ = to.spin;
  }

  rom::SolidWheelRun run_;
  Vec3 velocity_;      ///< of the hub at the end of the last step, fixed axes           [m/s]
  double spin_ = 0.0;  ///< and its spin                                               [rad/s]
  Sums sums_;
};

}  // namespace

void LedWheel::weigh(Values& to) const {
  to.tyre_mass = rim().whole_mass();
  to.tyre_inertia = rim().whole_inertia();
}

rom::HubVelocity velocities(const Values& v) noexcept {
  rom::HubVelocity hub;
  hub.along = {v.hub_velocity_x, v.hub_velocity_up, 0.0 - v.hub_velocity_left};
  hub.spin = -v.hub_angular_velocity;
  hub.camber_rate = v.camber_rate;
  hub.yaw_rate = v.yaw_rate;
  return hub;
}

std::unique_ptr<LedWheel> led_wheel(const study::Setup& setup, study::PreparedWheel& wheel,
                                    const dynamics::State& start, const Values& values) {
  if (!wheel.solid) return std::make_unique<PlaneWheel>(setup, wheel, start);
  const rom::HubStart hub{.aside = 0.0 - values.hub_left_start,
                          .camber_rate = values.camber_rate,
                          .yaw_rate = values.yaw_rate};
  return std::make_unique<SpaceWheel>(setup, wheel, start, hub);
}

}  // namespace rondo::fmu
