// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid_wheel_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t lateral_numbers = 9;  ///< of a rim that moves, in SavedState::ring

SolidWheelSettings settings_of(const dynamics::Model& model, double law_residual) {
  return {.dt = model.dt,
          .mass_damping = model.mass_damping,
          .stiffness_damping = model.stiffness_damping,
          .law_residual = law_residual};
}

}  // namespace

WheelModel make_solid_model(const SolidRing& ring, std::vector<RingHarmonic> harmonics,
                            const KnownSpins& spins, const WheelViscosity& viscosity) {
  const OneBlasThread one;
  WheelModel wheel;
  wheel.harmonics = std::move(harmonics);
  for (const Vec3 x : ring.place) wheel.radius = std::max(wheel.radius, norm(x.plane()));
  take_viscosity(viscosity, wheel);
  spread_residuals(spins, wheel, [&](double square) -> CreepResidual {
    if (wheel.creep.empty()) return {solid_residual(ring, wheel.harmonics, square), {}, {}};
    return solid_creep_residual(ring, wheel.harmonics, square, wheel.creep);
  });
  return wheel;
}

SolidWheelRun::SolidWheelRun(const dynamics::Model& model, const SolidRing& ring,
                             const WheelModel& wheel, double law_residual, WheelFigures& figures,
                             const dynamics::State& at_start, const HubStart& hub)
    : model_(model),
      ring_(ring),
      law_residual_(law_residual),
      figures_(figures),
      candidate_(dynamics::places_among(model.contact->nodes, model.n_nodes())),
      wheel_(ring, wheel, *model.contact, settings_of(model, law_residual)),
      n_sums_(sums_of(wheel)),
      aside_(hub.aside),
      camber_(model.motion.camber),
      camber_rate_(hub.camber_rate),
      yaw_rate_(hub.yaw_rate) {
  RONDO_DEMAND(model.dt > 0.0 && model.solid, model.dt);
  active_.reserve(model.contact->nodes.size());
  if (model.rim) rim_.emplace(model, SolidWheelSettings{}.theta, wheel.largest_spin);
  begin(at_start);
}

void SolidWheelRun::begin(const dynamics::State& at_start) {
  SolidMotion start = motion_of(0);
  if (rim_) start.plane = rim_->at_start();
  start.plane.angle_next = start.plane.angle;
  start.plane.center_next = start.plane.center;
  start.lateral_next = start.lateral;
  start.plane.spin_next = -model_.motion.angular_velocity.at(0.0);
  start.plane.spin_rate = 0.0;
  wheel_.start(start, at_start.u.space(), at_start.v.space());
  frame_ = dynamics::frame_step(model_.motion, 0, model_.dt);
  if (rim_) {
    rim_->start(wheel_.sums(start), wheel_.force_on_rim(start));
    lateral_ = lateral_rate(0.0);
    lateral_momentum_ = wheel_.lateral_momentum(start, start.plane.spin_next);
    lateral_force_ = wheel_.lateral_force();
    set_frame(start);
  }
  const WheelEnergy energy = wheel_.energy_at_start(!rim_);
  sums_.start(energy);
  ledger_.compare(energy_of(energy));
}

dynamics::StepEnergy SolidWheelRun::energy_of(const WheelEnergy& wheel) const {
  dynamics::StepEnergy energy;
  energy.kinetic = wheel.kinetic;
  energy.strain = wheel.elastic + wheel.residual;
  // The work against the forces, as of full runs, less what the spin softens.
  if (is_viscous()) energy.strain += sums_.internal_work() - wheel.stored;
  if (!rim_) return energy;
  rim_->add_energy(energy);
  const double body = rim_->whole_mass() - model_.rim->mass;
  energy.kinetic += lateral_ * (0.5 * body * lateral_ + lateral_momentum_);
  energy.kinetic_rim += 0.5 * model_.rim->mass * lateral_ * lateral_;
  return energy;
}

/// Mean velocity along t2 over the step from t on, which the tables give.
double SolidWheelRun::lateral_rate(double t) const {
  return model_.motion.advance(t, model_.dt).z / model_.dt;
}

/// Kinks of the motion are spread over the step that ends there.
SolidMotion SolidWheelRun::motion_of(long long step) const {
  const dynamics::Motion& of = model_.motion;
  const double dt = model_.dt, t = static_cast<double>(step) * dt,
               end = static_cast<double>(step + 1) * dt;
  SolidMotion motion;
  WheelMotion& m = motion.plane;
  m.angle = of.angle(t);
  m.angle_next = of.angle(end);
  m.spin_next = -of.angular_velocity.at(end);
  m.spin_rate = -of.angular_velocity.change(t, dt) / dt;
  const Vec3 way = of.advance(t, dt), center = of.center(end);
  m.center_next = center.plane();
  m.center = m.center_next - way.plane();
  motion.lateral_next = aside_ + center.z;
  motion.lateral = motion.lateral_next - way.z;
  const Vec3 pull = (way - of.advance(t - dt, dt)) / (dt * dt);
  m.pull = pull.plane() - of.gravity_at(t + 0.5 * dt);
  motion.lateral_pull = pull.z;
  motion.attitude = motion.attitude_next = WheelAttitude(camber_, yaw_);
  return motion;
}

std::size_t SolidWheelRun::candidate_of(int contact_node) const noexcept {
  const auto n = static_cast<int>(ring_.contact.size());
  const std::size_t node =
      ring_.stiffness.node(at(ring_.contact[at(contact_node % n)]), at(contact_node / n));
  return at(candidate_[node]);
}

void SolidWheelRun::report_contact(const SolidWheelReport& wheel,
                                   dynamics::ContactReport& report) const {
  const double dt = model_.dt, height = frame_.center.y;
  const WheelAttitude attitude(camber_, yaw_);
  const Vec3 force = attitude.to_heading(wheel.mean.force),
             moment = attitude.to_heading(wheel.mean.moment);
  report.impulse = dt * force;
  report.angular_impulse = dt * wheel.mean_torque;
  report.moment_aligning = dt * moment.y;
  report.moment_overturning = dt * (moment.x + height * force.z);
  report.free_velocity = wheel.free / dt;
  report.residual = wheel.law_residual * report.free_velocity;
  report.clusters = wheel.candidates > 0 ? 1 : 0;
  report.clusters_not_converged = wheel.law_residual <= law_residual_ ? 0 : 1;
  report.cluster_largest = wheel.candidates;
  report.cluster_iterations = wheel.iterations;
  for (const SolidWheelContact& c : wheel.contacts) {
    ++report.nodes;
    report.sticking += c.status == contact::Status::stick ? 1 : 0;
    report.length += model_.contact->tributary[candidate_of(c.node)];
    report.penetration = std::max(report.penetration, -c.moved.x);
  }
  report.dissipation_friction = wheel.energy.friction;
  report.loss_impact = wheel.energy.arrival;
  report.work_rim = rim_ ? 0.0 : -wheel.energy.rim;
  report.work = report.work_rim - report.dissipation_friction - report.loss_impact;
}

void SolidWheelRun::count(const SolidWheelReport& wheel, double seconds) {
  if (wheel.candidates > 0) ++figures_.contact_steps;
  figures_.iterations += wheel.iterations;
  figures_.iterations_max = std::max(figures_.iterations_max, wheel.iterations);
  figures_.contacts_max = std::max(figures_.contacts_max, static_cast<int>(wheel.contacts.size()));
  figures_.pivoted += wheel.by_newton ? 1 : 0;
  figures_.late_friction += wheel.late ? 1 : 0;
  const bool solved = wheel.law_residual <= law_residual_ && !(rim_ && rim_->gave_up());
  figures_.not_converged += solved ? 0 : 1;
  if (rim_) figures_.spin_max = rim_->most_spin();
  figures_.wall_s += seconds;
  figures_.slowest_step_s = std::max(figures_.slowest_step_s, seconds);
}

void SolidWheelRun::list_contacts(const SolidWheelReport& wheel) {
  active_.clear();
  for (const SolidWheelContact& c : wheel.contacts) {
    dynamics::ActiveContact a;
    a.candidate = candidate_of(c.node);
    a.space = c.frame;
    a.gap = c.moved.x;
    a.impulse = model_.dt * c.frame.to(c.force);
    a.friction = c.friction;
    a.status = c.status;
    active_.push_back(a);
  }
  std::ranges::sort(active_, {}, &dynamics::ActiveContact::candidate);
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
SolidWheelReport SolidWheelRun::step_on_rim(dynamics::Works& works) {
  const double dt = model_.dt, before = lateral_;
  const double theta = settings_of(model_, law_residual_).theta;
  SolidMotion motion = motion_of(n_);
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
  const SolidWheelReport wheel = wheel_.step(n_, *rim_, motion, works);
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
  return wheel;
}

/// The frame of a rim that moves, after a step.
void SolidWheelRun::set_frame(const SolidMotion& motion) {
  frame_ = rim_->frame();
  frame_.slip_angle = model_.motion.slip_angle.at(frame_.time);
  frame_.center.z = motion.lateral_next;
  frame_.advance_before.z = motion.lateral_next - motion.lateral;
}

void SolidWheelRun::step(dynamics::StepReport& report) {
  const auto begin = Clock::now();
  dynamics::Works works;
  const SolidWheelReport wheel = rim_ ? step_on_rim(works) : wheel_.step(motion_of(n_));
  ++n_;
  if (!rim_) frame_ = dynamics::frame_step(model_.motion, n_, model_.dt);
  report = {};
  if (rim_) report.rim = rim_->report();
  report.step = n_;
  report.frame = frame_;
  report_contact(wheel, report.contact);
  dynamics::set_contact_works(report.contact, works);
  works.frame = wheel.energy.frame;
  works.load = wheel.load;
  works.dissipation_mass = wheel.energy.by_mass;
  works.dissipation_stiffness = wheel.energy.by_stiffness + wheel.energy.by_residual;
  works.scheme += wheel.energy.scheme;
  ledger_.add_works(works);
  if (is_viscous()) {
    sums_.add(wheel.energy);
    sums_.report(wheel.energy, report.material);
  }
  ledger_.compare(energy_of(wheel.energy));
  report.balance = ledger_.last();
  list_contacts(wheel);
  count(wheel, std::chrono::duration<double>(Clock::now() - begin).count());
}

void SolidWheelRun::fill(dynamics::State& state) const {
  state.step = n_;
  state.frame = frame_;
  state.active = active_;
  if (state.v.empty()) {
    wheel_.contact_displacement(frame_.angle, state.u.space());
    return;
  }
  wheel_.displacement(frame_.angle, state.u.space());
  wheel_.velocity(frame_.angle - 0.5 * frame_.turn_before, state.v.space());
  if (!state.v_next.empty()) state.v_next = state.v;
}

void SolidWheelRun::advance(std::span<dynamics::StepReport> reports,
                            dynamics::State* last) noexcept {
  RONDO_DEMAND(!reports.empty());
  for (dynamics::StepReport& report : reports) step(report);
  if (last) fill(*last);
}

void SolidWheelRun::fields(dynamics::State& state) const noexcept {
  wheel_.displacement(frame_.angle, state.u.space());
  wheel_.velocity(frame_.angle - 0.5 * frame_.turn_before, state.v_next.space());
}

std::size_t SolidWheelRun::n_numbers(const dynamics::Model& model, const SolidRing& ring,
                                     const WheelModel& wheel) noexcept {
  return SolidWheel::n_numbers(ring, wheel) + sums_of(wheel) +
         (model.rim ? WheelRim::n_numbers + lateral_numbers : 0);
}

bool SolidWheelRun::is_saved(const dynamics::Model& model, const SolidRing& ring,
                             const WheelModel& wheel, std::span<const double> numbers) noexcept {
  return numbers.size() == n_numbers(model, ring, wheel) &&
         SolidWheel::is_saved(ring, wheel, numbers.first(SolidWheel::n_numbers(ring, wheel))) &&
         std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

dynamics::SavedState SolidWheelRun::save() const {
  dynamics::SavedState saved;
  saved.step = n_;
  saved.ring = wheel_.save();
  if (rim_) {
    const std::vector<double> rim = rim_->save();
    saved.ring.insert(saved.ring.end(), rim.begin(), rim.end());
    saved.ring.insert(saved.ring.end(),
                      {lateral_, lateral_momentum_, lateral_force_, frame_.center.z,
                       frame_.advance_before.z, camber_, yaw_, camber_rate_, yaw_rate_});
  }
  if (is_viscous()) sums_.save(saved.ring);
  saved.ledger = ledger_.save();
  return saved;
}

void SolidWheelRun::restore(const dynamics::SavedState& saved) {
  n_ = saved.step;
  std::span<const double> numbers = saved.ring;
  ledger_.restore(saved.ledger);
  if (is_viscous()) {
    sums_.restore(numbers.last(n_sums_));
    numbers = numbers.first(numbers.size() - n_sums_);
  }
  if (!rim_) {
    wheel_.restore(numbers);
    frame_ = dynamics::frame_step(model_.motion, n_, model_.dt);
    return;
  }
  const auto aside = numbers.last(lateral_numbers);
  numbers = numbers.first(numbers.size() - lateral_numbers);
  rim_->restore(n_, numbers.last(WheelRim::n_numbers));
  wheel_.restore(numbers.first(numbers.size() - WheelRim::n_numbers));
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
