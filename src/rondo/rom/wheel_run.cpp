// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

using Clock = std::chrono::steady_clock;

/// The bound of the contact law of all runs.
bool is_solved(const WheelReport& wheel) noexcept {
  return wheel.law_residual <= 1e-9;
}

/// The boundary of each contact node of the first sector, as steps of full runs take it [m].
std::vector<double> lengths_of(const dynamics::Model& model, const Ring& ring) {
  std::vector<double> lengths;
  for (const int row : ring.contact) {
    const auto node = static_cast<int>(ring.stiffness.node(at(row), 0));
    const auto found = std::ranges::find(model.contact->nodes, node);
    RONDO_DEMAND(found != model.contact->nodes.end(), node);
    lengths.push_back(model.contact->tributary[at(found - model.contact->nodes.begin())]);
  }
  return lengths;
}

WheelSettings settings_of(const dynamics::Model& model, const Ring& ring) {
  return {.dt = model.dt,
          .mass_damping = model.mass_damping,
          .stiffness_damping = model.stiffness_damping,
          .friction = model.contact->law.friction,
          .lengths = lengths_of(model, ring)};
}

}  // namespace

WheelModel make_wheel_model(const Ring& ring, std::vector<RingHarmonic> harmonics,
                            const KnownSpins& spins, const WholeMesh* whole,
                            const WheelViscosity& viscosity) {
  const OneBlasThread one;
  WheelModel wheel;
  wheel.harmonics = std::move(harmonics);
  take_viscosity(viscosity, wheel);
  for (const Complex x : ring.place) wheel.radius = std::max(wheel.radius, std::hypot(x.re, x.im));
  const auto residual = [&](double square) -> CreepResidual {
    if (whole) {
      const RingResidual still = whole_residual(ring, *whole, wheel.harmonics, square);
      return {still, wheel.creep.empty() ? RingResidual{} : still, {}};
    }
    if (wheel.creep.empty())
      return {ring_residual(ring, wheel.harmonics, square, ResidualForm::convected), {}, {}};
    return creep_residual(ring, wheel.harmonics, square, wheel.creep);
  };
  spread_residuals(spins, wheel, residual);
  return wheel;
}

void take_viscosity(const WheelViscosity& viscosity, WheelModel& wheel) {
  wheel.branches = viscosity.branches;
  if (!wheel.branches.empty())
    wheel.creep = creep_terms(wheel.branches, viscosity.stiffness_damping);
}

void spread_residuals(const KnownSpins& spins, WheelModel& wheel,
                      const std::function<CreepResidual(double)>& residual) {
  const auto keep = [&](CreepResidual of) {
    wheel.residuals.push_back(std::move(of.at_once));
    if (!wheel.creep.empty()) wheel.later.push_back(std::move(of.later));
    wheel.one_matrix = std::move(of.one_matrix);
  };
  if (!spins.change || spins.most == 0.0) {
    wheel.largest_spin = spins.least;
    wheel.squares = {spins.least * spins.least};
    keep(residual(wheel.squares[0]));
    return;
  }
  const auto place = [](double most, int i) {
    return 0.5 * most * most * (1.0 - std::cos(std::numbers::pi * (2 * i + 1) / 6.0));
  };
  double most = spins.most;
  CreepResidual last = residual(place(most, 2));
  while (!last.at_once.made_static.empty() && most > spins.least) {
    most = std::max(spins.least, 0.9 * most);
    last = residual(place(most, 2));
  }
  wheel.largest_spin = most;
  for (int i = 0; i < 3; ++i) wheel.squares.push_back(place(most, i));
  for (int i = 0; i < 2; ++i) keep(residual(wheel.squares[at(i)]));
  keep(std::move(last));
}

WheelRun::WheelRun(const dynamics::Model& model, const Ring& ring, const WheelModel& wheel,
                   WheelFigures& figures, const dynamics::State& at_start)
    : model_(model),
      ring_(ring),
      figures_(figures),
      candidate_(model.n_nodes(), -1),
      wheel_(ring, wheel, model.contact->ground, settings_of(model, ring)),
      n_sums_(sums_of(wheel)) {
  RONDO_DEMAND(model.dt > 0.0, model.dt);
  for (std::size_t i = 0; i < model.contact->nodes.size(); ++i)
    candidate_[at(model.contact->nodes[i])] = static_cast<int>(i);
  active_.reserve(model.contact->nodes.size());
  if (model.rim) rim_.emplace(model, WheelSettings{}.theta, wheel.largest_spin);
  begin(at_start);
}

void WheelRun::begin(const dynamics::State& at_start) {
  WheelMotion start = rim_ ? rim_->at_start() : motion_of(0);
  start.angle_next = start.angle;
  start.center_next = start.center;
  start.center -= model_.motion.advance(0.0, model_.dt).plane();
  start.spin_next = -model_.motion.angular_velocity.at(0.0);
  start.spin_rate = 0.0;
  wheel_.start(start, at_start.u, at_start.v);
  frame_ = dynamics::frame_step(model_.motion, 0, model_.dt);
  if (rim_) {
    rim_->start(wheel_.sums(), wheel_.force_at_start());
    frame_ = rim_->frame();
  }
  const WheelEnergy energy = wheel_.energy_at_start(!rim_);
  sums_.start(energy);
  ledger_.compare(energy_of(energy));
}

dynamics::StepEnergy WheelRun::energy_of(const WheelEnergy& wheel) const {
  dynamics::StepEnergy energy;
  energy.kinetic = wheel.kinetic;
  energy.strain = wheel.elastic + wheel.residual;
  // The work against the forces, as of full runs, less what the spin softens.
  if (is_viscous()) energy.strain += sums_.internal_work() - wheel.stored;
  if (rim_) rim_->add_energy(energy);
  return energy;
}

/// Kinks of the motion are spread over the step that ends there.
WheelMotion WheelRun::motion_of(long long step) const {
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

int WheelRun::node_of(int contact_node) const noexcept {
  const auto n = static_cast<int>(ring_.contact.size());
  return static_cast<int>(
      ring_.stiffness.node(at(ring_.contact[at(contact_node % n)]), at(contact_node / n)));
}

void WheelRun::report_contact(const WheelReport& wheel, dynamics::ContactReport& report) const {
  const double dt = model_.dt;
  report.impulse = dt * wheel.mean_force;
  report.angular_impulse = dt * wheel.mean_torque;
  report.free_velocity = wheel.free / dt;
  report.residual = wheel.law_residual * report.free_velocity;
  report.clusters = wheel.candidates > 0 ? 1 : 0;
  report.clusters_not_converged = is_solved(wheel) ? 0 : 1;
  report.cluster_largest = wheel.candidates;
  report.cluster_iterations = wheel.iterations;
  for (const WheelContact& c : wheel.contacts) {
    ++report.nodes;
    report.sticking += c.status == contact::Status::stick ? 1 : 0;
    report.length += model_.contact->tributary[at(candidate_[at(node_of(c.node))])];
    report.penetration = std::max(report.penetration, -c.gap);
  }
  report.dissipation_friction = wheel.energy.friction;
  report.loss_impact = wheel.energy.arrival;
  report.work_rim = rim_ ? 0.0 : -wheel.energy.rim;
  report.work = report.work_rim - report.dissipation_friction - report.loss_impact;
}

void WheelRun::count(const WheelReport& wheel, double seconds) {
  if (wheel.candidates > 0) ++figures_.contact_steps;
  figures_.iterations += wheel.iterations;
  figures_.iterations_max = std::max(figures_.iterations_max, wheel.iterations);
  figures_.contacts_max = std::max(figures_.contacts_max, static_cast<int>(wheel.contacts.size()));
  figures_.pivoted += wheel.pivoted ? 1 : 0;
  figures_.late_friction += wheel.late ? 1 : 0;
  figures_.not_converged += is_solved(wheel) && !(rim_ && rim_->gave_up()) ? 0 : 1;
  if (rim_) figures_.spin_max = rim_->most_spin();
  figures_.wall_s += seconds;
  figures_.slowest_step_s = std::max(figures_.slowest_step_s, seconds);
}

void WheelRun::step(dynamics::StepReport& report) {
  const auto begin = Clock::now();
  dynamics::Works works;
  const WheelReport wheel = rim_ ? wheel_.step(n_, *rim_, works) : wheel_.step(motion_of(n_));
  ++n_;
  frame_ = rim_ ? rim_->frame() : dynamics::frame_step(model_.motion, n_, model_.dt);
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
  active_.clear();
  for (const WheelContact& c : wheel.contacts) {
    dynamics::ActiveContact a;
    a.candidate = at(candidate_[at(node_of(c.node))]);
    a.normal = c.normal;
    a.gap = c.gap;
    a.impulse = model_.dt * to_frame(c.normal, c.force);
    a.status = c.status;
    active_.push_back(a);
  }
  std::ranges::sort(active_, {}, &dynamics::ActiveContact::candidate);
  count(wheel, std::chrono::duration<double>(Clock::now() - begin).count());
}

void WheelRun::fill(dynamics::State& state) const {
  state.step = n_;
  state.frame = frame_;
  if (state.v.empty())
    wheel_.contact_displacement(frame_.angle, state.u);
  else
    wheel_.displacement(frame_.angle, state.u);
  state.active = active_;
  const double middle = frame_.angle - 0.5 * frame_.turn_before;
  if (!state.v.empty()) wheel_.velocity(middle, state.v);
  if (!state.v_next.empty()) state.v_next = state.v;
}

void WheelRun::advance(std::span<dynamics::StepReport> reports, dynamics::State* last) noexcept {
  RONDO_DEMAND(!reports.empty());
  for (dynamics::StepReport& report : reports) step(report);
  if (last) fill(*last);
}

void WheelRun::fields(dynamics::State& state) const noexcept {
  wheel_.displacement(frame_.angle, state.u);
  wheel_.velocity(frame_.angle - 0.5 * frame_.turn_before, state.v_next);
}

std::size_t WheelRun::n_numbers(const dynamics::Model& model, const Ring& ring,
                                const WheelModel& wheel) noexcept {
  return RingWheel::n_numbers(ring, wheel, model.contact->law.friction) + sums_of(wheel) +
         (model.rim ? WheelRim::n_numbers : 0);
}

bool WheelRun::is_saved(const dynamics::Model& model, const Ring& ring, const WheelModel& wheel,
                        std::span<const double> numbers) noexcept {
  const contact::Friction& friction = model.contact->law.friction;
  return numbers.size() == n_numbers(model, ring, wheel) &&
         RingWheel::is_saved(ring, wheel, friction,
                             numbers.first(RingWheel::n_numbers(ring, wheel, friction))) &&
         std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

dynamics::SavedState WheelRun::save() const {
  dynamics::SavedState saved;
  saved.step = n_;
  saved.ring = wheel_.save();
  if (rim_) {
    const std::vector<double> rim = rim_->save();
    saved.ring.insert(saved.ring.end(), rim.begin(), rim.end());
  }
  if (is_viscous()) sums_.save(saved.ring);
  saved.ledger = ledger_.save();
  return saved;
}

void WheelRun::restore(const dynamics::SavedState& saved) {
  n_ = saved.step;
  std::span<const double> numbers = saved.ring;
  if (is_viscous()) {
    sums_.restore(numbers.last(n_sums_));
    numbers = numbers.first(numbers.size() - n_sums_);
  }
  const std::size_t of_rim = rim_ ? WheelRim::n_numbers : 0;
  wheel_.restore(numbers.first(numbers.size() - of_rim));
  if (rim_) rim_->restore(n_, numbers.last(of_rim));
  ledger_.restore(saved.ledger);
  frame_ = rim_ ? rim_->frame() : dynamics::frame_step(model_.motion, n_, model_.dt);
}

}  // namespace rondo::rom
