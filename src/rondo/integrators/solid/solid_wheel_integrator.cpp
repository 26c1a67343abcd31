// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_wheel_integrator.hpp"

#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/general/step_traps.hpp"

namespace rondo::dynamics {

SolidWheelIntegrator::SolidWheelIntegrator(const Model& model, const State& start)
    : model_(model),
      step_(start.step),
      rim_(model),
      before_(to_vector(start.u.space())),
      u_(before_),
      next_(before_),
      v_(model.n_nodes()),
      v_next_(model.n_nodes()),
      absolute_(model.n_nodes()),
      forces_(model, u_),
      contacts_(model) {
  RONDO_DEMAND(model.rim && model.scheme == Scheme::symplectic);
  RONDO_DEMAND(start.v_next.size() == model.n_nodes() && !start.rim.empty(), start.v_next.size(),
               model.n_nodes(), start.rim.size());
  rim_.restore(start.step, start.rim);
  for_free_nodes(model, [&](std::size_t k) {
    next_[k] = u_[k] + model.dt * start.v_next.space()[k];
    absolute_[k] = rim_.frame().rotation * rim_.velocity_of(arm(k), next_[k] - u_[k]);
  });
}

/// The rim and u to t_{n+1}; energy of the half step before.
void SolidWheelIntegrator::move(StepEnergy& energy) noexcept {
  rim_.move();
  std::swap(before_, u_);
  std::swap(u_, next_);
  forces_.evaluate(u_, rim_.frame().time);
  const Complex back = conj(rim_.frame().rotation);
  for_free_nodes(model_, [&](std::size_t k) {
    v_[k] = back * absolute_[k];
    energy.kinetic += 0.5 * model_.mass[k] * dot(absolute_[k], absolute_[k]);
    energy.strain += 0.5 * dot(u_[k], forces_.gradient_before(k));
  });
}

/// V⁺ = V⁻ + Δt (g - q/m) + r/m; what q does to the rim, axes of the wheel.
ContactReport SolidWheelIntegrator::push(Vec3 gravity, Vec3& force, double& moment) noexcept {
  const FrameStep& frame = rim_.frame();
  Vec3 sum;
  for_free_nodes(model_, [&](std::size_t k) {
    const double m = model_.mass[k];
    const Vec3 q =
        forces_.gradient(k) + model_.mass_damping * m * relative_before(k) + forces_.damping(k);
    sum += q;
    moment += cross(arm(k).plane(), q.plane());
    v_next_[k] = v_[k] + model_.dt * ((forces_.load(k) - q) / m + gravity);
  });
  force = frame.rotation * sum;
  const ContactReport report = contacts_.solve(SolidContactStep(model_, frame), u_, v_, v_next_);
  for_free_nodes(model_,
                 [&](std::size_t k) { absolute_[k] += frame.rotation * (v_next_[k] - v_[k]); });
  return report;
}

/// u_{n+2}.
void SolidWheelIntegrator::find_next() noexcept {
  for_free_nodes(model_,
                 [&](std::size_t k) { next_[k] = u_[k] + rim_.travel(arm(k), v_next_[k]); });
}

/// (10.5): along the axle the way that the rim sees is twice the mean travel, and nothing bends.
void SolidWheelIntegrator::add_works(Vec3 gravity, Works& w) const noexcept {
  const double dt = model_.dt, alpha = model_.mass_damping;
  const Complex after = rim_.plane().turn(), before = conj(rim_.plane().turn_before());
  const double bend = after.re - before.re;  // cos δ⁺ - cos δ⁻
  for_free_nodes(model_, [&](std::size_t k) {
    const Vec3 was = relative_before(k), is = relative_after(k);
    const Vec2 excess = bend * arm(k).plane() + dt * (after * is.plane() + before * was.plane());
    const Vec3 way = Vec3(excess, 0.0) + dt * (is + was);  // D
    const Vec3 mean = 0.5 * (v_[k] + v_next_[k]);
    w.scheme -= 0.5 * dot(forces_.gradient(k).plane(), excess);
    w.dissipation_mass += 0.5 * alpha * model_.mass[k] * dot(was, way);
    w.dissipation_stiffness += 0.5 * dot(forces_.damping(k), way);
    w.load += dt * dot(mean, forces_.load(k));
    w.gravity += dt * model_.mass[k] * dot(mean, gravity);
  });
}

StepReport SolidWheelIntegrator::step() noexcept {
  const StepTraps traps;
  ++step_;
  StepEnergy energy;
  move(energy);
  const double time = rim_.frame().time;
  const Vec3 gravity = conj(rim_.frame().rotation) *
                       GroundFrame(model_.motion.camber).to_wheel(model_.motion.gravity_at(time));
  StepReport report;
  report.step = step_;
  Vec3 force;
  double moment = 0.0;
  report.contact = push(gravity, force, moment);
  rim_.take(force, moment);
  find_next();
  const StepEnergy of_rim = rim_.energy();
  energy.kinetic_rim = of_rim.kinetic_rim;
  energy.support = of_rim.support;
  energy.works = of_rim.works;
  add_works(gravity, energy.works);
  add_contact_works(report.contact, energy.works);
  ledger_.add(energy);
  report.frame = rim_.frame();
  report.balance = ledger_.last();
  report.rim = rim_.plane().report();
  return report;
}

void SolidWheelIntegrator::advance(std::span<StepReport> reports, State* last) noexcept {
  RONDO_DEMAND(!reports.empty());
  for (StepReport& report : reports) report = step();
  if (!last) return;
  last->step = step_;
  last->frame = rim_.frame();
  last->u = u_;
  last->active = contacts_.active();
  if (last->v.empty()) return;
  const bool after = !last->v_next.empty();
  for_free_nodes(model_, [&](std::size_t k) {
    const Vec3 was = relative_before(k), is = relative_after(k);
    last->v.space()[k] = was;
    if (after) last->v_next.space()[k] = is;
  });
}

void SolidWheelIntegrator::fields(State& state) const noexcept {
  state.u = next_;
  for_free_nodes(model_, [&](std::size_t k) { state.v_next.space()[k] = relative_after(k); });
}

SavedState SolidWheelIntegrator::save() const {
  SavedState saved;
  saved.step = step_;
  saved.u = next_;
  saved.u_before = u_;
  saved.v = absolute_;
  saved.force = forces_.saved();
  saved.rim = rim_.save();
  saved.impulses = contacts_.impulses();
  saved.ledger = ledger_.save();
  return saved;
}

void SolidWheelIntegrator::restore(const SavedState& saved) {
  RONDO_DEMAND(saved.u.size() == model_.n_nodes() && saved.u_before.size() == model_.n_nodes(),
               saved.u.size(), saved.u_before.size());
  RONDO_DEMAND(saved.v.size() == model_.n_nodes() && !saved.rim.empty(), saved.v.size(),
               saved.rim.size());
  step_ = saved.step;
  next_ = to_vector(saved.u.space());
  u_ = to_vector(saved.u_before.space());
  absolute_ = to_vector(saved.v.space());
  forces_.restore(saved.force);
  rim_.restore(saved.step, saved.rim);
  contacts_.set_impulses(saved.impulses);
  ledger_.restore(saved.ledger);
}

}  // namespace rondo::dynamics
