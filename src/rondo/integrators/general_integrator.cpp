// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general_integrator.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/step_traps.hpp"
#include "rondo/model/corotated.hpp"
#include "rondo/model/operator.hpp"
#include "rondo/model/pressure.hpp"

namespace rondo::dynamics {
namespace {

/// ½ Σ eᵀ p of each free body.
void body_energies(const Model& model, const std::vector<Vec2>& elastic,
                   const std::vector<Vec2>& product, std::vector<double>& energy) noexcept {
  for (std::size_t b = 0; b < energy.size(); ++b) {
    energy[b] = 0.0;
    for (const int node : model.free_bodies[b].nodes) {
      const auto k = static_cast<std::size_t>(node);
      energy[b] += 0.5 * dot(elastic[k], product[k]);
    }
  }
}

}  // namespace

GeneralIntegrator::GeneralIntegrator(const Model& model, const State& start)
    : model_(model),
      state_(start),
      contact_(model),
      elastic_(model.n_nodes()),
      product_(model.n_nodes()),
      before_(model.n_nodes()),
      gradient_(model.n_nodes()),
      gradient_before_(model.n_nodes()),
      damping_(model.stiffness_damping > 0.0 ? model.n_nodes() : 0),
      load_(model.pressures.empty() ? 0 : model.n_nodes()),
      energy_(model.free_bodies.size()),
      energy_before_(model.free_bodies.size()) {
  RONDO_DEMAND(model.free_bodies.empty() || model.scheme == Scheme::symplectic);
  RONDO_DEMAND(model.stiffness.row_start.size() == model.n_nodes() + 1, model.n_nodes());
  RONDO_DEMAND(state_.poses.size() == model.free_bodies.size(), state_.poses.size());
  state_.v.resize(model.n_nodes());
  find_forces();
}

/// Elastic displacements, K e, its energy and gradient at the places that the nodes have.
void GeneralIntegrator::find_forces() noexcept {
  update_poses(model_, state_.u, state_.poses);
  elastic_displacements(model_, state_.u, state_.poses, elastic_);
  apply(model_.stiffness, elastic_, product_, model_.threads);
  to_gradient(model_, elastic_, product_, state_.poses, gradient_);
  body_energies(model_, elastic_, product_, energy_);
}

/// β K ė, turned and balanced like the elastic force, so that it has no moment either (9.6).
void GeneralIntegrator::add_damping() noexcept {
  const double rate = model_.stiffness_damping / model_.dt;
  for_free_nodes(model_, [&](std::size_t k) { before_[k] = rate * (product_[k] - before_[k]); });
  to_gradient(model_, elastic_, before_, state_.poses, damping_);
}

/// u_{n+1}, and ½ vᵀ M v before it.
void GeneralIntegrator::move(double& kinetic) noexcept {
  for_free_nodes(model_, [&](std::size_t k) {
    state_.u[k] += model_.dt * state_.v[k];
    kinetic += 0.5 * model_.mass[k] * dot(state_.v[k], state_.v[k]);
  });
}

/// ½ u_{n+1}ᵀ K u_n; of free bodies the same in terms of energies and their derivatives (9.7).
double GeneralIntegrator::half_step_strain() const noexcept {
  double strain = 0.0;
  for_free_nodes(model_, [&](std::size_t k) {
    if (!in_fixed_frame(model_, k))
      strain += 0.5 * dot(state_.u[k], before_[k]);
    else
      strain -= 0.25 * model_.dt * dot(state_.v[k], gradient_[k] - gradient_before_[k]);
  });
  for (std::size_t b = 0; b < energy_.size(); ++b) strain += 0.5 * (energy_[b] + energy_before_[b]);
  return strain;
}

/// v⁺ = v⁻ + [Δt f/m - drag v⁻]/a, without contact (3.4).
void GeneralIntegrator::free_velocities(const BodyFrames& frames) noexcept {
  const double dt = model_.dt;
  for_free_nodes(model_, [&](std::size_t k) {
    const BodyFrame& f = frames.of(model_, k);
    Vec2 force = -gradient_[k];
    if (!damping_.empty()) force -= damping_[k];
    if (!load_.empty()) force += load_[k];
    const Vec2 acceleration =
        force / model_.mass[k] - frame_acceleration(f.frame, model_.reference[k] + state_.u[k]);
    const Vec2 v = state_.v[k];
    state_.v_next[k] = v + (dt * acceleration - f.update.drag * v) / f.update.a;
  });
}

/// (5.3)
void GeneralIntegrator::add_works(const BodyFrames& frames, Works& w) const noexcept {
  const double dt = model_.dt;
  const bool printed = model_.scheme == Scheme::as_printed;
  for_free_nodes(model_, [&](std::size_t k) {
    const double m = model_.mass[k];
    const FrameStep& frame = frames.of(model_, k).frame;
    const Vec2 v = state_.v[k], mean = 0.5 * (v + state_.v_next[k]);
    w.frame -= dt * m * dot(mean, frame_acceleration(frame, model_.reference[k] + state_.u[k]));
    w.dissipation_mass += dt * model_.mass_damping * m * dot(mean, printed ? v : mean);
    if (!damping_.empty()) w.dissipation_stiffness += dt * dot(mean, damping_[k]);
    if (!load_.empty()) w.load += dt * dot(mean, load_[k]);
    if (printed) w.scheme -= 2.0 * dt * frame.spin * m * dot(mean, turn90(v));
  });
}

/// Where nothing is held, those who look on see the first body's place and rotation.
void GeneralIntegrator::report_frame(StepReport& report) const noexcept {
  report.frame = state_.frame;
  std::size_t n_free = 0;
  for (const FreeBody& body : model_.free_bodies) n_free += body.nodes.size();
  if (n_free != model_.free.size() || state_.poses.empty()) return;
  report.frame.center = state_.poses.front().center;
  report.frame.angle = state_.poses.front().angle;
}

StepReport GeneralIntegrator::step() noexcept {
  const StepTraps traps;
  std::swap(state_.v, state_.v_next);
  std::swap(product_, before_);
  std::swap(gradient_, gradient_before_);
  std::swap(energy_, energy_before_);
  state_.frame = frame_step(model_.motion, ++state_.step, model_.dt);
  const BodyFrames frames(model_, state_.frame);
  StepEnergy energy;
  move(energy.kinetic);
  find_forces();
  energy.strain = half_step_strain();
  if (!damping_.empty()) add_damping();
  if (!load_.empty()) pressure_forces(model_, state_.u, state_.frame.time, load_);
  free_velocities(frames);
  StepReport report;
  report.step = state_.step;
  report_frame(report);
  report.contact = contact_.solve(frames, report.frame.center, state_);
  add_works(frames, energy.works);
  energy.works.contact = report.contact.work;
  energy.works.dissipation_friction = report.contact.dissipation_friction;
  energy.works.loss_impact = report.contact.loss_impact;
  energy.works.rim = report.contact.work_rim;
  ledger_.add(energy);
  report.balance = ledger_.last();
  return report;
}

void GeneralIntegrator::advance(std::span<StepReport> reports, State* last) noexcept {
  for (StepReport& report : reports) report = step();
  if (!last) return;
  last->step = state_.step;
  last->frame = state_.frame;
  last->u = state_.u;
  last->v = state_.v;
  if (!last->v_next.empty()) last->v_next = state_.v_next;
  last->poses = state_.poses;
  last->active = state_.active;
}

void GeneralIntegrator::fields(State& state) const noexcept {
  state.u = state_.u;
  for_free_nodes(model_, [&](std::size_t k) { state.u[k] += model_.dt * state_.v_next[k]; });
  state.v_next = state_.v_next;
}

SavedState GeneralIntegrator::save() const {
  SavedState saved;
  saved.step = state_.step;
  saved.u = state_.u;
  saved.v = state_.v_next;
  saved.force = product_;
  saved.gradient = gradient_;
  saved.energy = energy_;
  saved.poses = state_.poses;
  saved.impulses = contact_.impulses();
  saved.ledger = ledger_.save();
  return saved;
}

void GeneralIntegrator::restore(const SavedState& saved) {
  RONDO_DEMAND(saved.u.size() == model_.n_nodes() && saved.v.size() == model_.n_nodes() &&
                   saved.force.size() == model_.n_nodes() &&
                   saved.gradient.size() == model_.n_nodes(),
               saved.u.size(), saved.v.size(), saved.force.size(), saved.gradient.size());
  RONDO_DEMAND(saved.energy.size() == energy_.size() && saved.poses.size() == energy_.size(),
               saved.energy.size(), saved.poses.size());
  state_.step = saved.step;
  state_.u = saved.u;
  state_.v_next = saved.v;
  product_ = saved.force;
  gradient_ = saved.gradient;
  energy_ = saved.energy;
  state_.poses = saved.poses;
  contact_.set_impulses(saved.impulses);
  ledger_.restore(saved.ledger);
}

}  // namespace rondo::dynamics
