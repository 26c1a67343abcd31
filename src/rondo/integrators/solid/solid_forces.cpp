// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_forces.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::dynamics {

SolidForces::SolidForces(const Model& model, const State& start)
    : model_(model), now_(model.n_nodes()), before_(model.n_nodes()) {
  RONDO_DEMAND(model.solid && model.solid->axial.size() == model.n_nodes());
  if (!model.solid->pressures.empty()) load_.resize(model.n_nodes());
  rest_ = rest_forces(model);
  const std::span<const Vec3> u = start.u;
  if (model.solid->swept) swept_.emplace(swept_wheel(model));
  if (!model.solid->viscous.empty())
    branches_.emplace(model.solid->viscous, u, model.dt, model.threads);
  const double stored = find(u, start.frame.angle);
  if (keeps_work()) work_.start(u, stored);
  report_.internal_work = report_.stored_energy = stored;
}

double SolidForces::find(std::span<const Vec3> u, double angle) noexcept {
  if (swept_) return swept_->find(u, angle, now_);
  fem::apply(model_.solid->sector, u, now_);
  double stored = 0.0;
  if (branches_) for_free_nodes(model_, [&](std::size_t k) { stored += 0.5 * dot(u[k], now_[k]); });
  return stored;
}

double SolidForces::add_work(std::span<const Vec3> u, double stored) noexcept {
  const double half = work_.add(model_, u, before_, now_);
  report_.internal_work = work_.value();
  report_.stored_energy = stored;
  report_.dissipation_viscous = loss_.value();
  if (has_window(model_)) {
    window_work_.add(swept_->window_work());
    report_.window_work = window_work_.value();
  }
  return half;
}

void SolidForces::save(SavedState& saved) const {
  saved.force = now_;
  const CompensatedSum& work = work_.sum();
  if (keeps_work())
    saved.internal_work = {work.sum(), work.correction(), loss_.sum(), loss_.correction()};
  if (branches_) saved.branches = branches_->save();
  if (!has_window(model_)) return;
  saved.window = {window_work_.sum(), window_work_.correction()};
  swept_->save(saved.window);
}

void SolidForces::restore(const SavedState& saved) {
  RONDO_DEMAND(saved.force.size() == model_.n_nodes(), saved.force.size(), model_.n_nodes());
  now_ = to_vector(saved.force.space());
  if (!keeps_work()) return;
  RONDO_DEMAND(saved.internal_work.size() == 4, saved.internal_work.size());
  const Field& u = model_.rim ? saved.u_before : saved.u;
  work_.restore(u.space(), {saved.internal_work[0], saved.internal_work[1]});
  loss_ = {saved.internal_work[2], saved.internal_work[3]};
  if (branches_) branches_->restore(work_.u(), saved.branches);
  if (!has_window(model_)) return;
  RONDO_DEMAND(saved.window.size() == window_numbers(model_), saved.window.size());
  window_work_ = {saved.window[0], saved.window[1]};
  swept_->restore(std::span(saved.window).subspan(2));
}

double SolidForces::evaluate(std::span<const Vec3> u, std::span<const Vec3> /*v*/,
                             const FrameStep& frame) noexcept {
  RONDO_ASSERT(u.size() == now_.size(), u.size(), now_.size());
  std::swap(now_, before_);
  double stored = find(u, frame.angle);
  if (branches_) {
    branches_->move(u);
    const std::span<const Vec3> more = branches_->force();
    for_free_nodes(model_, [&](std::size_t k) { now_[k] += more[k]; });
    stored += branches_->stored();
    loss_.add(branches_->lost());
  }
  if (!load_.empty()) solid_pressure_forces(model_, frame.time, load_);
  moment_ = rest_moment(rest_, u);
  if (keeps_work()) return add_work(u, stored);
  double energy = 0.0;
  for_free_nodes(model_, [&](std::size_t k) { energy += 0.5 * dot(u[k], before_[k]); });
  return energy;
}

std::vector<Vec3> rest_forces(const Model& model) {
  const fem::SolidSector& k = model.solid->sector;
  std::vector<Vec3> all;
  for (const SolidPressure& p : model.solid->pressures) {
    if (!p.of_rest) continue;
    all.resize(model.n_nodes());
    for (std::size_t j = 0; j < k.turn.size(); ++j)
      for (std::size_t a = 0; a < k.n_local(); ++a) all[k.node(a, j)] += k.turn[j] * p.force[a];
  }
  return all;
}

/// They are along x, so that x itself adds nothing.
double rest_moment(std::span<const Vec3> rest, std::span<const Vec3> u) noexcept {
  double moment = 0.0;
  RONDO_ASSERT(rest.empty() || rest.size() == u.size(), rest.size(), u.size());
  for (std::size_t k = 0; k < rest.size(); ++k) moment -= cross(u[k].plane(), rest[k].plane());
  return moment;
}

void solid_pressure_forces(const Model& model, double time, std::span<Vec3> load) noexcept {
  const fem::SolidSector& k = model.solid->sector;
  std::ranges::fill(load, Vec3{});
  RONDO_ASSERT(load.size() == model.n_nodes(), load.size(), model.n_nodes());
  for (const SolidPressure& p : model.solid->pressures) {
    RONDO_ASSERT(p.force.size() == k.n_local(), p.force.size(), k.n_local());
    const double pressure = p.pressure.at(time);
    for (std::size_t j = 0; j < k.turn.size(); ++j)
      for (std::size_t a = 0; a < k.n_local(); ++a)
        load[k.node(a, j)] += pressure * (k.turn[j] * p.force[a]);
  }
}

}  // namespace rondo::dynamics
