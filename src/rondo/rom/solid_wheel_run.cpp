// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid_wheel_run.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/rom/wheel/base/ring_candidates.hpp"

namespace rondo::rom {
namespace {

constexpr std::size_t lateral_numbers = 9;  ///< of a rim that moves, in SavedState::ring

SolidWheelSettings settings_of(const dynamics::Model& model, double law_residual) {
  return {{.dt = model.dt,
           .mass_damping = model.mass_damping,
           .stiffness_damping = model.stiffness_damping},
          law_residual};
}

}  // namespace

SolidWheelRun::SolidWheelRun(const dynamics::Model& model, const SolidRing& ring,
                             const WheelModel& wheel, double law_residual, WheelFigures& figures,
                             const dynamics::State& at_start, const HubStart& hub)
    : ReducedRun(model, wheel, law_residual, candidates_of(ring, *model.contact), figures),
      wheel_(ring, wheel, *model.contact, settings_of(model, law_residual)),
      aside_(hub.aside),
      camber_(model.motion.camber),
      camber_rate_(hub.camber_rate),
      yaw_rate_(hub.yaw_rate) {
  RONDO_DEMAND(model.solid);
  SolidMotion start = in_space(motion_at_start(), 0);
  start.lateral_next = start.lateral;
  wheel_.start(start, at_start.u.space(), at_start.v.space());
  frame_ = dynamics::frame_step(model.motion, 0, model.dt);
  if (rim_) {
    rim_->start(wheel_.sums(start), wheel_.force_on_rim(start));
    lateral_ = lateral_rate(0.0);
    lateral_momentum_ = wheel_.lateral_momentum(start, start.plane.spin_next);
    lateral_force_ = wheel_.lateral_force();
    set_frame(start);
  }
  begin_ledger(wheel_.energy_at_start(!rim_));
}

dynamics::StepEnergy SolidWheelRun::energy_of(const WheelEnergy& wheel) const {
  dynamics::StepEnergy energy = ReducedRun::energy_of(wheel);
  if (!rim_) return energy;
  const double body = rim_->whole_mass() - model_.rim->mass;
  energy.kinetic += lateral_ * (0.5 * body * lateral_ + lateral_momentum_);
  energy.kinetic_rim += 0.5 * model_.rim->mass * lateral_ * lateral_;
  return energy;
}

/// Mean velocity along t2 over the step from t on, which the tables give.
double SolidWheelRun::lateral_rate(double t) const {
  return model_.motion.advance(t, model_.dt).z / model_.dt;
}

/// The motion along t2 and the attitude that the tables give for a step, beside one in the plane.
SolidMotion SolidWheelRun::in_space(const WheelMotion& plane, long long step) const {
  const dynamics::Motion& of = model_.motion;
  const double dt = model_.dt, t = static_cast<double>(step) * dt,
               end = static_cast<double>(step + 1) * dt;
  const double way = of.advance(t, dt).z;
  SolidMotion motion;
  motion.plane = plane;
  motion.lateral_next = aside_ + of.center(end).z;
  motion.lateral = motion.lateral_next - way;
  motion.lateral_pull = (way - of.advance(t - dt, dt).z) / (dt * dt);
  motion.attitude = motion.attitude_next = WheelAttitude(camber_, yaw_);
  return motion;
}

void SolidWheelRun::report_forces(dynamics::ContactReport& report) {
  const double dt = model_.dt, height = frame_.center.y;
  const WheelAttitude attitude(camber_, yaw_);
  const Vec3 force = attitude.to_heading(report_.mean.force),
             moment = attitude.to_heading(report_.mean.moment);
  report.impulse = dt * force;
  report.moment_aligning = dt * moment.y;
  report.moment_overturning = dt * (moment.x + height * force.z);
  for (const SolidWheelContact& c : report_.contacts) {
    dynamics::ActiveContact& a = list_contact(c.node);
    a.space = c.frame;
    a.gap = c.moved.x;
    a.impulse = dt * c.frame.to(c.force);
    a.friction = c.friction;
    a.status = c.status;
  }
}

/// How a hub that is led turns about the axes of the ground in the step.
void SolidWheelRun::turn_hub(SolidMotion& motion) {
  if (!led_) return;
  const double dt = model_.dt, before = camber_;
  const Vec2 mean = 0.5 * Vec2{camber_rate_ + led_->camber_rate, yaw_rate_ + led_->yaw_rate};
  const Vec2 change = Vec2{led_->camber_rate - camber_rate_, led_->yaw_rate - yaw_rate_} / dt;
  camber_ += dt * mean.x;
  yaw_ += dt * mean.y;
  camber_rate_ = led_->camber_rate;
  yaw_rate_ = led_->yaw_rate;
  motion.attitude_next = WheelAttitude(camber_, yaw_);
  const double lean = std::cos(0.5 * (before + camber_));
  motion.turning = {-mean.x, lean * mean.y};
  motion.turning_rate = {-change.x, lean * change.y};
}

/// A step on a rim that moves along t1 and n, and along t2 as its tables say. The velocity along t2
/// goes to its new value in the step; what holds it does the work of force and inertia.
void SolidWheelRun::step_on_rim(dynamics::Works& works) {
  const double dt = model_.dt, before = lateral_;
  const double theta = StepSettings().theta;
  SolidMotion motion = in_space({}, n_);
  turn_hub(motion);
  Vec3 aim{0.0, 0.0, lateral_rate(static_cast<double>(n_) * dt)};
  if (led_) {
    aim = motion.attitude_next.from_heading(led_->along);
    rim_->lead({aim.x, aim.y, led_->spin});
  }
  lateral_ = aim.z;
  const double mean = 0.5 * (before + lateral_), change = lateral_ - before;
  motion.lateral = frame_.center.z;
  motion.lateral_next = motion.lateral + dt * mean;
  motion.lateral_pull = change / dt;
  rim_->lean(std::tan(camber_) * motion.lateral_pull);
  report_ = wheel_.step(n_, *rim_, motion, works);
  const SolidWheelReport& wheel = report_;
  const double momentum = wheel.lateral_momentum,
               held = rim_->whole_mass() * change + momentum - lateral_momentum_;
  const double force = theta * wheel.end.force.z + (1.0 - theta) * lateral_force_;
  works.held += mean * (held - dt * force) + wheel.turning_inertia - wheel.turning_work;
  works.scheme += change * (0.5 * (momentum + lateral_momentum_) - wheel.lateral_middle) +
                  dt * force * mean - wheel.lateral_work;
  const dynamics::RimReport& rim = rim_->report();
  hub_.held = motion.attitude_next.to_heading({rim.force.x, rim.force.y, held / dt - force});
  hub_.torque = -rim.torque;
  hub_.force = motion.attitude_next.to_heading(wheel.mean.force);
  hub_.moment = motion.attitude_next.to_heading(wheel.mean.moment);
  lateral_momentum_ = momentum;
  lateral_force_ = wheel.end.force.z;
  set_frame(motion);
}

/// The frame of a rim that moves, after a step.
void SolidWheelRun::set_frame(const SolidMotion& motion) {
  frame_ = rim_->frame();
  frame_.slip_angle = model_.motion.slip_angle.at(frame_.time);
  frame_.center.z = motion.lateral_next;
  frame_.advance_before.z = motion.lateral_next - motion.lateral;
}

const WheelOutcome& SolidWheelRun::make_step(dynamics::Works& works) {
  if (rim_)
    step_on_rim(works);
  else
    report_ = wheel_.step(in_space(motion_of(n_), n_));
  works.load = report_.load;
  return report_;
}

std::size_t SolidWheelRun::n_numbers(const dynamics::Model& model, const SolidRing& ring,
                                     const WheelModel& wheel) noexcept {
  return SolidWheel::n_numbers(ring, wheel) + n_beside(model, wheel, lateral_numbers);
}

bool SolidWheelRun::is_saved(const dynamics::Model& model, const SolidRing& ring,
                             const WheelModel& wheel, std::span<const double> numbers) noexcept {
  return numbers.size() == n_numbers(model, ring, wheel) &&
         SolidWheel::is_saved(ring, wheel, numbers.first(SolidWheel::n_numbers(ring, wheel))) &&
         std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

std::vector<double> SolidWheelRun::save_aside() const {
  return {lateral_,
          lateral_momentum_,
          lateral_force_,
          frame_.center.z,
          frame_.advance_before.z,
          camber_,
          yaw_,
          camber_rate_,
          yaw_rate_};
}

void SolidWheelRun::restore_aside(std::span<const double> aside) {
  lateral_ = aside[0];
  lateral_momentum_ = aside[1];
  lateral_force_ = aside[2];
  camber_ = aside[5];
  yaw_ = aside[6];
  camber_rate_ = aside[7];
  yaw_rate_ = aside[8];
  SolidMotion motion;
  motion.lateral_next = aside[3];
  motion.lateral = aside[3] - aside[4];
  set_frame(motion);
}

}  // namespace rondo::rom
