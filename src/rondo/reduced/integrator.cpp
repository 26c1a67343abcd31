// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/reduced/integrator.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "rondo/core/contract.hpp"

namespace rondo::reduced {

using dynamics::ContactReport;
using dynamics::StepReport;

/// The frame over one step.
struct ReducedIntegrator::Motion {
  double dt, spin, spin_rate;
  Vec2 center, advance, velocity_before, velocity;
  Vec2 pull;  ///< c̈ - g, fixed frame [m/s2]
};

namespace {

VectorXd vector_of(Vec2 v) {
  return Eigen::Vector2d(v.x, v.y);
}

Vec2 center_velocity(const dynamics::Motion& motion, double t) {
  return {motion.speed.at(t), motion.height.slope(t)};
}

}  // namespace

ReducedIntegrator::ReducedIntegrator(const IntegratorInput& input, const dynamics::State& start)
    : input_(input),
      candidates_(reduction::boundary_rings(input.mesh).point),
      lift_(input.mesh, input.reduced),
      q_(lift_.restrict_to_modes(0.0, start.u, input.model.mass)),
      p_(lift_.restrict_to_modes(0.0, start.v, input.model.mass)),
      before_(2 * q_.size()),
      mid_(2 * q_.size()),
      force_(VectorXd::Zero(q_.size())) {
  if (input.model.contact)
    contact_ = std::make_unique<ContactSolver>(
        input.reduced, input.model.contact->ground,
        contact::CoupledLimits{.most_iterations = input.model.coupled.most_iterations});
  mid_ << q_, p_;
  const dynamics::StepEnergy at_start = energy();
  ledger_.compare(at_start.kinetic, at_start.strain);
}

ReducedIntegrator::~ReducedIntegrator() = default;

dynamics::SavedState ReducedIntegrator::save() const {
  RONDO_DEMAND(false, n_);
  return {};
}

void ReducedIntegrator::restore(const dynamics::SavedState& saved) {
  RONDO_DEMAND(false, saved.step);
}

ReducedIntegrator::Motion ReducedIntegrator::motion_of_step() const {
  const dynamics::Motion& of = input_.model.motion;
  const double dt = input_.model.dt;
  const double t = static_cast<double>(n_) * dt, end = static_cast<double>(n_ + 1) * dt;
  Motion m{};
  m.dt = dt;
  m.spin = of.turn(t, dt) / dt;
  m.spin_rate = -of.angular_velocity.change(t, dt) / dt;
  m.center = of.center(end);
  m.advance = of.advance(t, dt);
  m.velocity_before = center_velocity(of, t);
  m.velocity = center_velocity(of, end);
  m.pull = (m.velocity - m.velocity_before) / dt + Vec2{0.0, of.gravity.at(t + 0.5 * dt)};
  return m;
}

void ReducedIntegrator::use_matrices(const Motion& m) {
  const dynamics::Model& model = input_.model;
  const StepMatrixKey key{m.dt, model.mass_damping, model.stiffness_damping, m.spin, m.spin_rate};
  if (matrices_ && matrices_->key() == key) return;
  const auto begin = std::chrono::steady_clock::now();
  matrices_ = std::make_unique<SpinMatrices>(input_.reduced, key);
  ++input_.figures.factored;
  input_.figures.factor_wall_s +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void ReducedIntegrator::step(StepReport& report) {
  const reduction::ReducedModel& rm = input_.reduced;
  const Index r = rm.size();
  const Motion m = motion_of_step();
  use_matrices(m);
  before_ << q_, p_;
  VectorXd right = before_;
  right.tail(r) += 0.5 * m.dt *
                   (m.spin * m.spin * rm.reference - m.spin_rate * rm.turned_reference -
                    rm.translation * vector_of(m.pull));
  mid_.noalias() = matrices_->inverse() * right;
  force_.setZero();
  report.contact = {};
  if (contact_) solve_contact(m, report.contact);
  q_ = 2.0 * mid_.head(r) - before_.head(r);
  p_ = 2.0 * mid_.tail(r) - before_.tail(r);
  ++n_;
  frame_ = dynamics::frame_step(input_.model.motion, n_, m.dt);
  report.step = n_;
  report.frame = frame_;
  balance(m, report);
}

void ReducedIntegrator::solve_contact(const Motion& m, ContactReport& report) {
  const reduction::ReducedModel& rm = input_.reduced;
  const Index r = rm.size();
  const VectorXd q = 2.0 * mid_.head(r) - before_.head(r);
  const VectorXd p = 2.0 * mid_.tail(r) - before_.tail(r);
  const FreeStep free{m.dt,       m.spin, m.center, m.advance, m.velocity_before,
                      m.velocity, &q_,    &p_,      &q,        &p};
  const ContactOutcome outcome = contact_->solve(free, input_.model.contact->law, *matrices_);
  if (contact_->contacts().empty()) return;
  for (const PointContact& c : contact_->contacts())
    force_ += rm.rows.middleRows(2 * c.point, 2).transpose() * vector_of(c.normal * c.impulse);
  mid_.noalias() += 0.5 * (matrices_->inverse().rightCols(r) * force_);
  count_contact(m, outcome, report);
}

void ReducedIntegrator::count_contact(const Motion& m, const ContactOutcome& outcome,
                                      ContactReport& report) {
  const reduction::ReducedModel& rm = input_.reduced;
  const Index r = rm.size();
  const auto n_contacts = static_cast<int>(contact_->contacts().size());
  ++input_.figures.contact_steps;
  input_.figures.iterations += outcome.iterations;
  input_.figures.iterations_max = std::max(input_.figures.iterations_max, outcome.iterations);
  input_.figures.contacts_max = std::max(input_.figures.contacts_max, n_contacts);
  input_.figures.more_rows_than_modes += 2 * n_contacts > r ? 1 : 0;
  input_.figures.not_converged += outcome.converged ? 0 : 1;
  report.free_velocity = outcome.free_velocity;
  report.residual = outcome.residual * outcome.free_velocity;
  report.clusters = 1;
  report.clusters_not_converged = outcome.converged ? 0 : 1;
  report.cluster_largest = n_contacts;
  report.cluster_iterations = outcome.iterations;
  const VectorXd q = 2.0 * mid_.head(r) - before_.head(r);
  for (const PointContact& c : contact_->contacts()) {
    const auto rows = rm.rows.middleRows(2 * c.point, 2);
    const Eigen::Vector2d end = rows * q, half = rows * mid_.head(r), moving = rows * mid_.tail(r);
    const Vec2 arm = rm.contact_points[static_cast<std::size_t>(c.point)];
    const Vec2 impulse = c.normal * c.impulse;
    const Vec2 place = arm + Vec2{end[0], end[1]};
    const Vec2 velocity = m.advance / m.dt + m.spin * turn90(arm + Vec2{half[0], half[1]}) +
                          Vec2{moving[0], moving[1]};
    report.impulse += impulse;
    report.angular_impulse += cross(place, impulse);
    const double gap = input_.model.contact->ground.distance(m.center + place);
    report.penetration = std::max(report.penetration, -gap);
    if (c.impulse.x <= 0.0) continue;
    ++report.nodes;
    report.sticking += c.status == contact::Status::stick ? 1 : 0;
    report.length += rm.contact_share[static_cast<std::size_t>(c.point)];
    report.dissipation_friction -= c.impulse.y * dot(turn90(c.normal), velocity);
    report.loss_impact -= c.impulse.x * dot(c.normal, velocity);
    report.work_rim -= dot(impulse, velocity);
  }
}

/// Before the step to come.
dynamics::StepEnergy ReducedIntegrator::energy() const {
  dynamics::StepEnergy e;
  e.kinetic = 0.5 * p_.squaredNorm();
  e.strain = 0.5 * q_.dot(input_.reduced.stiffness * q_);
  return e;
}

/// The balance (R.5): exact for the midpoint rule, as all energies are quadratic.
void ReducedIntegrator::balance(const Motion& m, StepReport& report) {
  const reduction::ReducedModel& rm = input_.reduced;
  const dynamics::Model& model = input_.model;
  const auto q = mid_.head(rm.size()), p = mid_.tail(rm.size());
  report.contact.work = force_.dot(p);
  report.contact.work_rim += report.contact.work;
  const VectorXd kp = rm.stiffness * p, kq = rm.stiffness * q;
  dynamics::StepEnergy e = energy();
  e.works.frame = m.dt * (p.dot(m.spin * m.spin * (rm.reference + q) -
                                m.spin_rate * (rm.turned_reference + rm.turn * q) -
                                rm.translation * vector_of(m.pull)));
  e.works.contact = report.contact.work;
  e.works.rim = report.contact.work_rim;
  e.works.dissipation_friction = report.contact.dissipation_friction;
  e.works.loss_impact = report.contact.loss_impact;
  e.works.dissipation_mass = m.dt * model.mass_damping * p.squaredNorm();
  e.works.dissipation_stiffness = m.dt * model.stiffness_damping * p.dot(kp);
  e.works.scheme = m.dt * m.spin * kq.dot(rm.generator * q);
  ledger_.add_works(e.works);
  ledger_.compare(e.kinetic, e.strain);
  report.balance = ledger_.last();
}

void ReducedIntegrator::fill_contacts(double angle,
                                      std::vector<dynamics::ActiveContact>& active) const {
  active.clear();
  if (!contact_) return;
  const int n = input_.reduced.n_sectors, stride = input_.reduced.stride;
  constexpr double turn = 2.0 * std::numbers::pi;
  // The material of a point lies between two nodes: each gets its share, so that the sum stays.
  const double sectors_back = angle / turn * n;
  for (const PointContact& c : contact_->contacts()) {
    if (c.impulse.x <= 0.0) continue;
    const double place = c.point * stride - sectors_back;
    const auto first = static_cast<long long>(std::ceil(place - stride));
    for (long long sector = first; static_cast<double>(sector) < place + stride; ++sector) {
      const double share = reduction::contact_weight(static_cast<double>(sector) - place, stride);
      if (share <= 0.0) continue;
      dynamics::ActiveContact a;
      const auto within = static_cast<std::size_t>(((sector % n) + n) % n);
      a.candidate = static_cast<std::size_t>(candidates_[within]);
      a.normal = c.normal;
      a.impulse = share * c.impulse;
      a.status = c.status;
      active.push_back(a);
    }
  }
  std::stable_sort(active.begin(), active.end(),
                   [](const auto& a, const auto& b) { return a.candidate < b.candidate; });
}

void ReducedIntegrator::fill(dynamics::State& state) {
  const Index r = input_.reduced.size();
  state.step = n_;
  state.frame = frame_;
  lift_.lift(frame_.angle, q_, state.u);
  const double half = frame_.time - 0.5 * input_.model.dt;
  lift_.lift(input_.model.motion.angle(half), mid_.tail(r), state.v);
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

}  // namespace rondo::reduced
