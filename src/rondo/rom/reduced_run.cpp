// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/reduced_run.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/base/reduced_wheel.hpp"

namespace rondo::rom {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

ReducedRun::ReducedRun(const dynamics::Model& model, const WheelModel& wheel, double law_residual,
                       std::vector<std::size_t> candidates, WheelFigures& figures)
    : model_(model),
      law_residual_(law_residual),
      candidates_(std::move(candidates)),
      figures_(figures),
      n_sums_(sums_of(wheel)) {
  RONDO_DEMAND(model.dt > 0.0, model.dt);
  active_.reserve(model.contact->nodes.size());
  if (model.rim) rim_.emplace(model, StepSettings().theta, wheel.largest_spin);
}

WheelMotion ReducedRun::motion_of(long long step) const {
  const dynamics::Motion& of = model_.motion;
  const double dt = model_.dt, t = static_cast<double>(step) * dt,
               end = static_cast<double>(step + 1) * dt;
  WheelMotion m;
  m.angle = of.angle(t);
  m.angle_next = of.angle(end);
  m.spin_next = -of.angular_velocity.at(end);
  m.spin_rate = -of.angular_velocity.change(t, dt) / dt;
  m.center_next = of.center(end).plane();
  m.center = m.center_next - of.advance(t, dt).plane();
  m.pull = (of.advance(t, dt) - of.advance(t - dt, dt)).plane() / (dt * dt) -
           of.gravity_at(t + 0.5 * dt);
  return m;
}

WheelMotion ReducedRun::motion_at_start() const {
  WheelMotion start = rim_ ? rim_->at_start() : motion_of(0);
  start.angle_next = start.angle;
  start.center_next = start.center;
  start.spin_next = -model_.motion.angular_velocity.at(0.0);
  start.spin_rate = 0.0;
  return start;
}

void ReducedRun::begin_ledger(const WheelEnergy& at_start) {
  sums_.start(at_start);
  ledger_.compare(energy_of(at_start));
}

dynamics::StepEnergy ReducedRun::energy_of(const WheelEnergy& wheel) const {
  dynamics::StepEnergy energy;
  energy.kinetic = wheel.kinetic;
  energy.strain = wheel.elastic + wheel.residual;
  // The work against the forces, as of full runs, less what the spin softens.
  if (is_viscous()) energy.strain += sums_.internal_work() - wheel.stored;
  if (rim_) rim_->add_energy(energy);
  return energy;
}

dynamics::ActiveContact& ReducedRun::list_contact(int contact_node) {
  active_.emplace_back().candidate = candidates_[at(contact_node)];
  return active_.back();
}

void ReducedRun::report_contact(const WheelOutcome& wheel, dynamics::ContactReport& report) {
  active_.clear();
  report_forces(report);
  report.angular_impulse = model_.dt * wheel.mean_torque;
  report.free_velocity = wheel.free / model_.dt;
  report.residual = wheel.law_residual * report.free_velocity;
  report.clusters = wheel.candidates > 0 ? 1 : 0;
  report.clusters_not_converged = wheel.law_residual <= law_residual_ ? 0 : 1;
  report.cluster_largest = wheel.candidates;
  report.cluster_iterations = wheel.iterations;
  for (const dynamics::ActiveContact& c : active_) {
    ++report.nodes;
    report.sticking += c.status == contact::Status::stick ? 1 : 0;
    report.length += model_.contact->tributary[c.candidate];
    report.penetration = std::max(report.penetration, -c.gap);
  }
  std::ranges::sort(active_, {}, &dynamics::ActiveContact::candidate);
  report.dissipation_friction = wheel.energy.friction;
  report.loss_impact = wheel.energy.arrival;
  report.work_rim = rim_ ? 0.0 : -wheel.energy.rim;
  report.work = report.work_rim - report.dissipation_friction - report.loss_impact;
}

void ReducedRun::count(const WheelOutcome& wheel, double seconds) {
  if (wheel.candidates > 0) ++figures_.contact_steps;
  figures_.iterations += wheel.iterations;
  figures_.iterations_max = std::max(figures_.iterations_max, wheel.iterations);
  figures_.contacts_max = std::max(figures_.contacts_max, static_cast<int>(active_.size()));
  figures_.second_method += wheel.second_method ? 1 : 0;
  figures_.late_friction += wheel.late ? 1 : 0;
  const bool solved = wheel.law_residual <= law_residual_ && !(rim_ && rim_->gave_up());
  figures_.not_converged += solved ? 0 : 1;
  if (rim_) figures_.spin_max = rim_->most_spin();
  figures_.wall_s += seconds;
  figures_.slowest_step_s = std::max(figures_.slowest_step_s, seconds);
}

void ReducedRun::step(dynamics::StepReport& report) {
  const auto begin = Clock::now();
  dynamics::Works works;
  const WheelOutcome& wheel = make_step(works);
  ++n_;
  if (!rim_) frame_ = dynamics::frame_step(model_.motion, n_, model_.dt);
  report = {};
  if (rim_) report.rim = rim_->report();
  report.step = n_;
  report.frame = frame_;
  report_contact(wheel, report.contact);
  dynamics::set_contact_works(report.contact, works);
  works.frame = wheel.energy.frame;
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
  count(wheel, std::chrono::duration<double>(Clock::now() - begin).count());
}

void ReducedRun::advance(std::span<dynamics::StepReport> reports, dynamics::State* last) noexcept {
  RONDO_DEMAND(!reports.empty());
  for (dynamics::StepReport& report : reports) step(report);
  if (last) fill(*last);
}

void ReducedRun::fill(dynamics::State& state) const {
  state.step = n_;
  state.frame = frame_;
  state.active = active_;
  if (state.v.empty()) return contact_displacement(frame_.angle, state.u);
  displacement(frame_.angle, state.u);
  velocity(frame_.angle - 0.5 * frame_.turn_before, state.v);
  if (!state.v_next.empty()) state.v_next = state.v;
}

void ReducedRun::fields(dynamics::State& state) const noexcept {
  displacement(frame_.angle, state.u);
  velocity(frame_.angle - 0.5 * frame_.turn_before, state.v_next);
}

std::size_t ReducedRun::n_beside(const dynamics::Model& model, const WheelModel& wheel,
                                 std::size_t aside) noexcept {
  return sums_of(wheel) + (model.rim ? WheelRim::n_numbers + aside : 0);
}

dynamics::SavedState ReducedRun::save() const {
  dynamics::SavedState saved;
  saved.step = n_;
  saved.ring = save_wheel();
  const auto append = [&](const std::vector<double>& numbers) {
    saved.ring.insert(saved.ring.end(), numbers.begin(), numbers.end());
  };
  if (rim_) {
    append(rim_->save());
    append(save_aside());
  }
  if (is_viscous()) sums_.save(saved.ring);
  saved.ledger = ledger_.save();
  return saved;
}

void ReducedRun::restore(const dynamics::SavedState& saved) {
  n_ = saved.step;
  ledger_.restore(saved.ledger);
  std::span<const double> numbers = saved.ring;
  if (is_viscous()) {
    sums_.restore(numbers.last(n_sums_));
    numbers = numbers.first(numbers.size() - n_sums_);
  }
  const std::size_t of_rim = rim_ ? WheelRim::n_numbers : 0,
                    of_wheel = numbers.size() - of_rim - (rim_ ? save_aside().size() : 0);
  restore_wheel(numbers.first(of_wheel));
  frame_ = dynamics::frame_step(model_.motion, n_, model_.dt);
  if (!rim_) return;
  rim_->restore(n_, numbers.subspan(of_wheel, of_rim));
  frame_ = rim_->frame();
  restore_aside(numbers.subspan(of_wheel + of_rim));
}

}  // namespace rondo::rom
