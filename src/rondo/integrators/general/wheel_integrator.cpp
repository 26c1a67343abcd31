// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/wheel_integrator.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/general/step_traps.hpp"
#include "rondo/model/pressure.hpp"

namespace rondo::dynamics {

WheelIntegrator::WheelIntegrator(const Model& model, const State& start)
    : model_(model),
      rim_(model),
      state_(start),
      before_(start.u),
      next_(start.u),
      absolute_(model.n_nodes()),
      internal_(make_internal_force(model, start.u, start.poses)),
      contact_(model) {
  RONDO_DEMAND(model.rim && model.free_bodies.empty() && model.scheme == Scheme::symplectic);
  RONDO_DEMAND(start.u.size() == model.n_nodes() && start.v_next.size() == model.n_nodes() &&
                   !start.rim.empty(),
               start.u.size(), start.v_next.size(), start.rim.size(), model.n_nodes());
  rim_.restore(start.step, start.rim);
  state_.v = Field(model.n_nodes(), 2);
  forces_.all.resize(model.n_nodes());
  if (model.stiffness_damping > 0.0) forces_.damping.resize(model.n_nodes());
  if (!model.pressures.empty()) forces_.load.resize(model.n_nodes());
  const std::span u = start.u.plane(), v_next = start.v_next.plane();
  const std::span next = next_.plane();
  for_free_nodes(model, [&](std::size_t k) {
    next[k] = u[k] + model.dt * v_next[k];
    absolute_[k] = rim_.frame().rotation *
                   velocity_on_rim(rim_, model.dt, model.reference[k] + u[k], next[k] - u[k]);
  });
}

/// Writes the velocities relative to the rim in the half step before u_{n+1}.
void WheelIntegrator::relative_before(std::span<Vec2> velocity) const noexcept {
  RONDO_ASSERT(velocity.size() == model_.n_nodes(), velocity.size(), model_.n_nodes());
  const std::span u = state_.u.plane(), before = before_.plane();
  for_free_nodes(model_, [&](std::size_t k) { velocity[k] = (u[k] - before[k]) / model_.dt; });
}

/// Writes the velocities relative to the rim in the half step after u_{n+1}.
void WheelIntegrator::relative_after(std::span<Vec2> velocity) const noexcept {
  RONDO_ASSERT(velocity.size() == model_.n_nodes(), velocity.size(), model_.n_nodes());
  const std::span u = state_.u.plane(), next = next_.plane();
  for_free_nodes(model_, [&](std::size_t k) { velocity[k] = (next[k] - u[k]) / model_.dt; });
}

/// The rim and u to t_{n+1}; kinetic energy of the half step before.
void WheelIntegrator::move(StepEnergy& energy) noexcept {
  rim_.move();
  state_.frame = rim_.frame();
  std::swap(before_, state_.u);
  std::swap(state_.u, next_);
  const Complex back = conj(state_.frame.rotation);
  const std::span v = state_.v.plane();
  for_free_nodes(model_, [&](std::size_t k) {
    v[k] = back * absolute_[k];
    energy.kinetic += 0.5 * model_.mass[k] * dot(absolute_[k], absolute_[k]);
  });
}

/// q at u_{n+1}, damping at the half step before.
RimForce WheelIntegrator::find_forces(double& strain) noexcept {
  internal_->evaluate(state_.u);
  const std::span<Vec2> relative = state_.v_next.plane();  // not yet of use
  relative_before(relative);
  strain = internal_->half_step_energy(state_.u, relative);
  if (!forces_.damping.empty()) internal_->damping(forces_.damping);
  if (!forces_.load.empty()) pressure_forces(model_, state_.u, state_.frame.time, forces_.load);
  const std::span<const Vec2> gradient = internal_->gradient(), u = state_.u.plane();
  RimForce sum;
  for_free_nodes(model_, [&](std::size_t k) {
    Vec2& q = forces_.all[k];
    q = gradient[k] + model_.mass_damping * model_.mass[k] * relative[k];
    if (!forces_.damping.empty()) q += forces_.damping[k];
    sum.force += q;
    sum.moment += cross(model_.reference[k] + u[k], q);
  });
  const RimForce pressed = pressure_on_rim(model_, forces_.load);
  rim_load_ = pressed;
  return {sum.force + pressed.force, sum.moment + pressed.moment};
}

/// V⁺ = V⁻ + Δt (g - R q/m) + r/m.
ContactReport WheelIntegrator::push(Vec2 gravity) noexcept {
  const std::span v = state_.v.plane(), v_next = state_.v_next.plane();
  for_free_nodes(model_, [&](std::size_t k) {
    Vec2 force = -forces_.all[k];
    if (!forces_.load.empty()) force += forces_.load[k];
    v_next[k] = v[k] + model_.dt * (force / model_.mass[k] + gravity);
  });
  const FrameStep& frame = state_.frame;
  const BodyFrames frames({frame, {{1.0, 0.0}, {0.0, 0.0}}, ContactStep(model_, frame)});
  const ContactReport report = contact_.solve(frames, frame.center.plane(), state_);
  for_free_nodes(model_,
                 [&](std::size_t k) { absolute_[k] += frame.rotation * (v_next[k] - v[k]); });
  return report;
}

/// u_{n+2}.
void WheelIntegrator::find_next() noexcept {
  const std::span u = state_.u.plane(), v_next = state_.v_next.plane(), next = next_.plane();
  std::ranges::copy(u, next.begin());
  for_free_nodes(model_, [&](std::size_t k) {
    next[k] += travel_on_rim(rim_, model_.dt, model_.reference[k] + u[k], v_next[k]);
  });
}

/// (10.5): works of q are on the increment D of a node's place as the rim sees it, less what the
/// rim's own rotation makes of it.
void WheelIntegrator::add_works(Vec2 gravity, Works& w) const noexcept {
  const double dt = model_.dt, alpha = model_.mass_damping;
  const Complex after = rim_.turn(), before = conj(rim_.turn_before());
  const double bend = after.re - before.re;  // cos δ⁺ - cos δ⁻
  const Vec2 center = conj(state_.frame.rotation) * (rim_.velocity() + rim_.velocity_before());
  w.load += 0.5 * dt *
            (dot(center, rim_load_.force) + (rim_.spin() + rim_.spin_before()) * rim_load_.moment);
  const std::span<const Vec2> gradient = internal_->gradient();
  const std::span u_before = before_.plane(), u = state_.u.plane(), next = next_.plane(),
                  v = state_.v.plane(), v_next = state_.v_next.plane();
  for_free_nodes(model_, [&](std::size_t k) {
    const Vec2 was = (u[k] - u_before[k]) / dt, is = (next[k] - u[k]) / dt;
    const Vec2 excess = bend * (model_.reference[k] + u[k]) + dt * (after * is + before * was);
    const Vec2 way = excess + dt * (is + was);  // D
    const Vec2 mean = 0.5 * (v[k] + v_next[k]);
    w.scheme -= 0.5 * dot(gradient[k], excess);
    w.dissipation_mass += 0.5 * alpha * model_.mass[k] * dot(was, way);
    if (!forces_.damping.empty()) w.dissipation_stiffness += 0.5 * dot(forces_.damping[k], way);
    if (!forces_.load.empty()) w.load += dt * dot(mean, forces_.load[k]);
    w.gravity += dt * model_.mass[k] * dot(mean, gravity);
  });
}

StepReport WheelIntegrator::step() noexcept {
  const StepTraps traps;
  ++state_.step;
  StepEnergy energy;
  move(energy);
  const RimForce q = find_forces(energy.strain);
  const Vec2 gravity = conj(state_.frame.rotation) * model_.motion.gravity_at(state_.frame.time);
  StepReport report;
  report.step = state_.step;
  report.contact = push(gravity);
  rim_.take(q);
  state_.frame = rim_.frame();
  find_next();
  energy.kinetic_rim = rim_.energy().kinetic_rim;
  energy.support = rim_.energy().support;
  energy.works = rim_.energy().works;
  add_works(gravity, energy.works);
  add_contact_works(report.contact, energy.works);
  ledger_.add(energy);
  report.frame = state_.frame;
  report.balance = ledger_.last();
  report.material = internal_->material();
  report.rim = rim_.report();
  return report;
}

void WheelIntegrator::advance(std::span<StepReport> reports, State* last) noexcept {
  RONDO_DEMAND(!reports.empty());
  for (StepReport& report : reports) report = step();
  if (!last) return;
  last->step = state_.step;
  last->frame = state_.frame;
  last->u = state_.u;
  last->active = state_.active;
  if (last->v.empty()) return;
  relative_before(last->v);
  if (last->v_next.empty()) return;
  relative_after(last->v_next);
}

void WheelIntegrator::fields(State& state) const noexcept {
  state.u = next_;
  relative_after(state.v_next);
}

SavedState WheelIntegrator::save() const {
  SavedState saved;
  saved.step = state_.step;
  saved.u = next_;
  saved.u_before = state_.u;
  saved.v = absolute_;
  saved.rim = rim_.save();
  internal_->save(saved);
  saved.impulses = contact_.coupled().kept;
  saved.ledger = ledger_.save();
  return saved;
}

void WheelIntegrator::restore(const SavedState& saved) {
  RONDO_DEMAND(saved.u.size() == model_.n_nodes() && saved.v.size() == model_.n_nodes() &&
                   saved.u_before.size() == model_.n_nodes(),
               saved.u.size(), saved.v.size(), saved.u_before.size());
  state_.step = saved.step;
  next_ = saved.u;
  state_.u = saved.u_before;
  absolute_ = to_vector(saved.v.plane());
  rim_.restore(saved.step, saved.rim);
  internal_->restore(saved);
  contact_.coupled().kept = saved.impulses;
  ledger_.restore(saved.ledger);
}

}  // namespace rondo::dynamics
