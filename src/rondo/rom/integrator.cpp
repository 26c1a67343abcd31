// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/integrator.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/pod/dense.hpp"

namespace rondo::rom {

using dynamics::ContactReport;
using dynamics::StepReport;
using pod::multiply;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

Eigen::Vector2d vector_of(Vec2 v) {
  return {v.x, v.y};
}

Vec2 center_velocity(const dynamics::Motion& motion, double t) {
  return {motion.speed.at(t), motion.height.slope(t)};
}

}  // namespace

ReducedIntegrator::ReducedIntegrator(const IntegratorInput& input, const dynamics::State& start)
    : input_(input),
      candidates_(pod::boundary_rings(input.mesh).point),
      lift_(input.mesh, input.reduced),
      q_(lift_.restrict_to_modes(0.0, start.u, input.model.mass)),
      p_(lift_.restrict_to_modes(0.0, start.v, input.model.mass)) {
  if (!input.lifts) boundary_lift_.emplace(input.mesh, input.reduced);
  if (input.model.contact)
    contact_ = std::make_unique<ContactSolver>(
        input.mesh, input.reduced, input.model.contact->ground,
        contact::CoupledLimits{.most_iterations = input.model.coupled.most_iterations});
  for (VectorXd* v :
       {&q_end_, &p_end_, &carried_, &q_mid_, &p_mid_, &load_, &push_, &work_, &other_})
    v->setZero(q_.size());
  p_mid_ = p_;
  if (input.scheme == StepScheme::central) start_central();
  ledger_.compare(energy());
}

ReducedIntegrator::~ReducedIntegrator() = default;

/// Applies half a push at t = 0: from then on the velocity is that of half steps.
void ReducedIntegrator::start_central() {
  const dynamics::Motion& of = input_.model.motion;
  const dynamics::FrameStep f = dynamics::frame_step(of, 0, input_.model.dt);
  Motion m{};
  m.dt = 0.5 * input_.model.dt;
  m.spin = f.spin;
  m.spin_rate = f.spin_rate;
  m.angle = f.angle;
  m.pull = f.rotation * f.pull.plane();
  if (input_.reduced.frame == rom::ModelFrame::turning) m.pull = f.pull.plane();
  set_load(m);
  StepMatrices half(input_.reduced, {StepScheme::central, m.dt, input_.model.mass_damping,
                                     input_.model.stiffness_damping, 0.0, m.spin, m.spin_rate});
  half.kick(q_, p_, load_, p_end_);
  p_ = p_end_;
}

ReducedIntegrator::Motion ReducedIntegrator::motion_of_step() const {
  const dynamics::Motion& of = input_.model.motion;
  const double dt = input_.model.dt;
  const double t = static_cast<double>(n_) * dt, end = static_cast<double>(n_ + 1) * dt;
  const bool turning = input_.reduced.frame == rom::ModelFrame::turning;
  Motion m{};
  m.dt = dt;
  m.carry = of.turn(t, dt) / dt;
  m.angle_before = of.angle(t);
  m.angle = of.angle(end);
  m.center = of.center(end).plane();
  m.center_before = m.center - of.advance(t, dt).plane();
  if (input_.scheme == StepScheme::central) {
    const dynamics::FrameStep f = dynamics::frame_step(of, n_ + 1, dt);
    m.spin = f.spin;
    m.spin_rate = f.spin_rate;
    m.turn = f.turn;
    m.velocity_before = f.advance_before.plane() / dt;
    m.velocity = f.advance.plane() / dt;
    m.pull = turning ? f.pull.plane() : f.rotation * f.pull.plane();
    return m;
  }
  m.spin = m.carry;
  m.spin_rate = -of.angular_velocity.change(t, dt) / dt;
  m.velocity_before = center_velocity(of, t);
  m.velocity = center_velocity(of, end);
  m.pull = (m.velocity - m.velocity_before) / dt - of.gravity_at(t + 0.5 * dt);
  if (turning) m.pull = rotation(-of.angle(t + 0.5 * dt)) * m.pull;
  return m;
}

/// Δt (s² x - ṡ j - E (c̈ - g))
void ReducedIntegrator::set_load(const Motion& m) {
  const rom::ReducedModel& rm = input_.reduced;
  load_ = m.dt * (m.spin * m.spin * rm.reference - m.spin_rate * rm.turned_reference);
  load_.noalias() -= m.dt * rm.translation * vector_of(m.pull);
}

void ReducedIntegrator::use_matrices(const Motion& m) {
  const dynamics::Model& model = input_.model;
  const StepMatrixKey key{input_.scheme, m.dt,   model.mass_damping, model.stiffness_damping,
                          m.carry,       m.spin, m.spin_rate};
  if (matrices_ && matrices_->key() == key) return;
  const auto begin = Clock::now();
  matrices_ = std::make_unique<StepMatrices>(input_.reduced, key);
  if (contact_) contact_->forget_matrices();
  ++input_.figures.factored;
  input_.figures.factor_wall_s += seconds_since(begin);
}

void ReducedIntegrator::step(StepReport& report) {
  const auto begin = Clock::now();
  const Motion m = motion_of_step();
  use_matrices(m);
  set_load(m);
  matrices_->advance(q_, p_, load_, q_end_, p_end_, carried_);
  push_.setZero();
  report.contact = {};
  if (contact_) solve_contact(m, report.contact);
  ++n_;
  frame_ = dynamics::frame_step(input_.model.motion, n_, m.dt);
  report.step = n_;
  report.frame = frame_;
  balance(m, report);
  const double seconds = seconds_since(begin);
  input_.figures.wall_s += seconds;
  input_.figures.slowest_step_s = std::max(input_.figures.slowest_step_s, seconds);
}

void ReducedIntegrator::solve_contact(const Motion& m, ContactReport& report) {
  const auto begin = Clock::now();
  const Complex rate{0.0, m.spin}, one{1.0, 0.0};
  FreeStep free{m.dt,
                m.spin,
                {m.angle_before, m.center_before, m.velocity_before, rate, one, &q_, &p_},
                {m.angle, m.center, m.velocity, rate, one, &q_end_, &p_end_}};
  if (input_.scheme == StepScheme::central) {
    // The end of the step is known before its impulses. They act from there on, and the law uses
    // the velocities of the next and the previous step.
    const Complex back = rotation_minus_one(-m.carry * m.dt), on = rotation_minus_one(m.turn);
    free.before = {m.angle,    m.center, m.velocity_before, -(back / m.dt),
                   one + back, &q_end_,  &carried_};
    free.end.turn_rate = on / m.dt;
    free.end.turn = one + on;
  }
  const ContactOutcome outcome = contact_->solve(free, input_.model.contact->law, *matrices_);
  input_.figures.tables = contact_->tables_made();
  if (!contact_->contacts().empty()) {
    for (const PointContact& c : contact_->contacts())
      contact_->table().add_push(c.point, from_frame(c.normal, c.impulse), push_);
    matrices_->add_response(push_, q_end_, p_end_);
    count_solver(outcome, report);
    find_middle();
    const Vec2 moving = input_.scheme == StepScheme::central
                            ? 0.5 * (m.velocity_before + m.velocity)
                            : (m.center - m.center_before) / m.dt;
    count_contacts(m, {conj(contact_->frame_rotation(m.angle)) * moving, q_mid_}, report);
  }
  input_.figures.contact_wall_s += seconds_since(begin);
}

void ReducedIntegrator::count_solver(const ContactOutcome& outcome, ContactReport& report) {
  StepFigures& figures = input_.figures;
  const auto n_contacts = static_cast<int>(contact_->contacts().size());
  ++figures.contact_steps;
  figures.iterations += outcome.iterations;
  figures.iterations_max = std::max(figures.iterations_max, outcome.iterations);
  figures.contacts_max = std::max(figures.contacts_max, n_contacts);
  figures.more_rows_than_modes += 2 * n_contacts > input_.reduced.size() ? 1 : 0;
  figures.not_converged += outcome.converged ? 0 : 1;
  report.free_velocity = outcome.free_velocity;
  report.residual = outcome.residual * outcome.free_velocity;
  report.clusters = 1;
  report.clusters_not_converged = outcome.converged ? 0 : 1;
  report.cluster_largest = n_contacts;
  report.cluster_iterations = outcome.iterations;
}

void ReducedIntegrator::find_middle() {
  if (input_.scheme == StepScheme::central)
    q_mid_ = q_end_;
  else
    q_mid_ = 0.5 * (q_ + q_end_);
  p_mid_ = 0.5 * (carried_ + p_end_);
}

/// Works use the velocity of the ledger: the mean of those before and after the push.
void ReducedIntegrator::count_contacts(const Motion& m, const Carrier& carrier,
                                       ContactReport& report) {
  const Complex turned = contact_->frame_rotation(m.angle);
  const ContactTable& table = contact_->table();
  for (const PointContact& c : contact_->contacts()) {
    const Vec2 impulse = from_frame(c.normal, c.impulse);
    const Vec2 place = table.point(c.point) + table.at(c.point, q_end_);
    const Vec2 arm = table.point(c.point) + table.at(c.point, carrier.arm);
    const Vec2 velocity = carrier.velocity + m.spin * turn90(arm) + table.at(c.point, p_mid_);
    report.impulse += turned * impulse;
    report.angular_impulse += cross(place, impulse);
    const double gap = input_.model.contact->ground.distance(m.center + turned * place);
    report.penetration = std::max(report.penetration, -gap);
    if (c.impulse.x <= 0.0) continue;
    ++report.nodes;
    report.sticking += c.status == contact::Status::stick ? 1 : 0;
    report.length += table.length(c.point, q_end_);
    report.dissipation_friction -= c.impulse.y * dot(turn90(c.normal), velocity);
    report.loss_impact -= c.impulse.x * dot(c.normal, velocity);
    report.work_rim -= dot(impulse, velocity);
  }
}

/// Energy of the state between two steps. The strain energy of central differences, which they
/// conserve, is ½ q·K q one step later.
dynamics::StepEnergy ReducedIntegrator::energy() {
  dynamics::StepEnergy e;
  other_ = q_;
  if (input_.scheme == StepScheme::central) other_ += input_.model.dt * p_;
  multiply(input_.reduced.stiffness, other_, work_);
  e.kinetic = 0.5 * p_.squaredNorm();
  e.strain = 0.5 * q_.dot(work_);
  return e;
}

/// The balance (R.5): exact for both schemes, as all energies are quadratic.
void ReducedIntegrator::balance(const Motion& m, StepReport& report) {
  const rom::ReducedModel& rm = input_.reduced;
  const dynamics::Model& model = input_.model;
  const bool central = input_.scheme == StepScheme::central;
  const double strain_before = central ? energy().strain : 0.0;
  find_middle();
  dynamics::Works w;
  report.contact.work = push_.dot(p_mid_);
  report.contact.work_rim += report.contact.work;
  w.contact = report.contact.work;
  w.rim = report.contact.work_rim;
  w.dissipation_friction = report.contact.dissipation_friction;
  w.loss_impact = report.contact.loss_impact;
  multiply(rm.turn, q_mid_, work_);
  w.frame = load_.dot(p_mid_) +
            m.dt * (m.spin * m.spin * p_mid_.dot(q_mid_) - m.spin_rate * p_mid_.dot(work_));
  w.dissipation_mass = m.dt * model.mass_damping * p_mid_.squaredNorm();
  multiply(rm.stiffness, central ? carried_ : p_mid_, work_);
  w.dissipation_stiffness = m.dt * model.stiffness_damping * p_mid_.dot(work_);
  // Work of carrying the fields on the strain energy; it is zero if the modes make K D skew.
  if (central) {
    multiply(rm.stiffness, q_end_, work_);
    other_ = q_end_ - m.dt * carried_;
    w.scheme = 0.5 * other_.dot(work_) - strain_before;
  } else {
    multiply(rm.generator, q_mid_, work_);
    multiply(rm.stiffness, q_mid_, other_);
    w.scheme = m.dt * m.spin * other_.dot(work_);
  }
  q_.swap(q_end_);
  p_.swap(p_end_);
  ledger_.add_works(w);
  ledger_.compare(energy());
  report.balance = ledger_.last();
}

void ReducedIntegrator::fill_contacts(double angle,
                                      std::vector<dynamics::ActiveContact>& active) const {
  active.clear();
  if (!contact_) return;
  const rom::ReducedModel& rm = input_.reduced;
  const int n = rm.n_sectors;
  const Complex turned = contact_->frame_rotation(angle);
  const auto add = [&](int material, double share, const PointContact& c) {
    dynamics::ActiveContact a;
    a.candidate = static_cast<std::size_t>(candidates_[at(material)]);
    a.normal = turned * c.normal;
    a.impulse = share * c.impulse;
    a.status = c.status;
    active.push_back(a);
  };
  // A point fixed in space lies between two nodes, which share its impulse; the sum is unchanged.
  const double sectors_back = angle / (2.0 * std::numbers::pi) * n;
  const auto whole = static_cast<long long>(std::floor(sectors_back));
  const double part = sectors_back - static_cast<double>(whole);
  const auto within = [&](long long sector) { return static_cast<int>(((sector % n) + n) % n); };
  for (const PointContact& c : contact_->contacts()) {
    if (c.impulse.x <= 0.0) continue;
    if (rm.form == rom::ContactForm::nodes) {
      add(c.material, 1.0, c);
      continue;
    }
    for (int sector = 0; sector < n; ++sector) {
      const double weight = rm.weights(sector, c.point);
      if (weight == 0.0) continue;
      if (part < 1.0) add(within(sector - whole), weight * (1.0 - part), c);
      if (part > 0.0) add(within(sector - whole - 1), weight * part, c);
    }
  }
  // Combine entries of the same node and facet.
  const auto before = [](const auto& a, const auto& b) {
    return a.candidate != b.candidate ? a.candidate < b.candidate : a.normal.x < b.normal.x;
  };
  std::ranges::stable_sort(active, before);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < active.size(); ++k) {
    const bool same = kept > 0 && active[kept - 1].candidate == active[k].candidate &&
                      active[kept - 1].normal == active[k].normal;
    if (same)
      active[kept - 1].impulse += active[k].impulse;
    else
      active[kept++] = active[k];
  }
  active.resize(kept);
}

double ReducedIntegrator::state_velocity_angle() const noexcept {
  if (input_.scheme == StepScheme::central) return frame_.angle;
  return input_.model.motion.angle(frame_.time - 0.5 * input_.model.dt);
}

void ReducedIntegrator::lift(dynamics::State& state) const noexcept {
  lift_.lift(frame_.angle, q_, state.u);
  lift_.lift(state_velocity_angle(), state_velocity(), state.v);
}

void ReducedIntegrator::fill(dynamics::State& state) {
  state.step = n_;
  state.frame = frame_;
  if (boundary_lift_)
    boundary_lift_->lift(frame_.angle, q_, state.u);
  else
    lift(state);
  fill_contacts(frame_.angle, state.active);
}

void ReducedIntegrator::advance(std::span<StepReport> reports, dynamics::State* last) noexcept {
  for (StepReport& report : reports) step(report);
  if (last) fill(*last);
}

void ReducedIntegrator::fields(dynamics::State& state) const noexcept {
  lift_.lift(frame_.angle, q_, state.u);
  lift_.lift(frame_.angle, p_, state.v_next);
}

}  // namespace rondo::rom
