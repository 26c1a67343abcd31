// SPDX-License-Identifier: BSD-3-Clause
/// The reduced step with a free rim (docs/reduced.md, 12).
#include <chrono>

#include "rondo/pod/dense.hpp"
#include "rondo/rom/integrator.hpp"

namespace rondo::rom {

using dynamics::ContactReport;
using dynamics::StepReport;
using pod::multiply;

void ReducedIntegrator::step_on_rim(StepReport& report) {
  rim_->begin(n_, q_);
  Motion m{};
  m.dt = input_.model.dt;
  m.carry = m.spin = rim_->matrix_spin();
  use_matrices(m);
  rim_->use(*matrices_);
  carried_ = p_;
  do {
    rim_->try_step(*matrices_, q_, p_, q_end_, p_end_);
    push_.setZero();
    report.contact = {};
    if (contact_) press_on_rim(report.contact);
    find_middle();
  } while (!rim_->settled(p_mid_));
  input_.figures.not_converged += rim_->gave_up() ? 1 : 0;
  ++n_;
  balance_on_rim(report);
  report.step = n_;
  report.frame = frame_ = rim_->frame();
  report.rim = rim_->report();
  RimExtents& rim = input_.figures.rim;
  rim.spin.take(report.rim.spin);
  rim.speed.take(report.rim.velocity.x);
  rim.height.take(frame_.center.y);
}

void ReducedIntegrator::press_on_rim(ContactReport& report) {
  const auto begin = std::chrono::steady_clock::now();
  const auto body = [](const RimVector& v, double angle, Vec2 center, const VectorXd& q,
                       const VectorXd& p) {
    return BodyState{angle, center, {v[0], v[1]}, {0.0, v[2]}, {1.0, 0.0}, &q, &p};
  };
  const FreeStep free{
      input_.model.dt,
      rim_->matrix_spin(),
      body(rim_->velocity(), rim_->angle(), rim_->center(), q_, p_),
      body(rim_->velocity_end(), rim_->angle_ahead(), rim_->center_end(), q_end_, p_end_),
      &rim_->response(),
      &rim_->arm_modes()};
  const ContactOutcome outcome = contact_->solve(free, input_.model.contact->law, *matrices_);
  input_.figures.tables = contact_->tables_made();
  if (!contact_->contacts().empty()) {
    const ContactTable& table = contact_->table();
    RimVector direct = RimVector::Zero();
    for (const PointContact& c : contact_->contacts()) {
      const Vec2 impulse = from_frame(c.normal, c.impulse);
      table.add_push(c.point, impulse, push_);
      const Vec2 arm = table.point(c.point) + table.at(c.point, rim_->arm_modes());
      direct += RimVector(impulse.x, impulse.y, cross(arm, impulse));
    }
    rim_->push(*matrices_, push_, direct, q_end_, p_end_);
    count_solver(outcome, report);
    find_middle();
    Motion m{};
    const RimVector v = rim_->velocity_mean();
    m.spin = v[2];
    m.center = rim_->center_end();
    count_contacts(m, {{v[0], v[1]}, rim_->arm_modes()}, report);
  }
  input_.figures.contact_wall_s +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The balance (R.9): all energies are absolute, and include that of the rim.
void ReducedIntegrator::balance_on_rim(StepReport& report) {
  const ReducedModel& rm = input_.reduced;
  const dynamics::Model& model = input_.model;
  dynamics::Works w;
  ContactReport& contact = report.contact;
  w.dissipation_friction = contact.dissipation_friction;
  w.loss_impact = contact.loss_impact;
  contact.work_rim = 0.0;
  w.contact = contact.work = -contact.dissipation_friction - contact.loss_impact;
  w.dissipation_mass = model.dt * model.mass_damping * p_mid_.squaredNorm();
  multiply(rm.stiffness, p_mid_, work_);
  w.dissipation_stiffness = model.dt * model.stiffness_damping * p_mid_.dot(work_);
  multiply(rm.rim->carry, q_mid_, work_);
  multiply(rm.stiffness, q_mid_, other_);
  w.scheme = model.dt * rim_->matrix_spin() * other_.dot(work_);
  rim_->finish(q_, p_, q_end_, p_end_, w);
  q_.swap(q_end_);
  p_.swap(p_end_);
  ledger_.add_works(w);
  ledger_.compare(energy());
  report.balance = ledger_.last();
}

}  // namespace rondo::rom
