// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::dynamics {

Ledger::Ledger(const Model& model)
    : energy_sums_(model.free.size()), work_sums_(model.free.size()) {}

void Ledger::balance(const Model& model, const State& state) noexcept {
  const auto energy = energy_sums_.sum(model.threads, [&](std::size_t i) {
    const auto k = static_cast<std::size_t>(model.free[i]);
    return std::array<double, 2>{0.5 * model.mass[k] * dot(state.v[k], state.v[k]),
                                 0.5 * dot(state.u[k], state.force_before[k])};
  });
  Balance& b = balance_;
  b.kinetic = energy[0];
  b.strain = energy[1];
  if (!started_) start_ = b.kinetic + b.strain;
  started_ = true;
  b.works = {frame_.value(), contact_.value(), friction_.value(),  impact_.value(),
             rim_.value(),   mass_.value(),    stiffness_.value(), scheme_.value()};
  const Works& w = b.works;
  CompensatedSum rest;
  for (const double term : {b.kinetic, b.strain, -start_, -w.frame, -w.contact, w.dissipation_mass,
                            w.dissipation_stiffness, -w.scheme})
    rest.add(term);
  b.residual = rest.value();
  const double works = std::abs(w.frame) + std::abs(w.contact) + std::abs(w.dissipation_mass) +
                       std::abs(w.dissipation_stiffness);
  b.exchanged = std::max(b.exchanged, std::abs(b.kinetic + b.strain) + works + std::abs(w.scheme));
  b.otherwise = std::max(b.otherwise, std::abs(start_) + works);
  if (b.residual != 0.0) b.relative = std::max(b.relative, std::abs(b.residual) / b.exchanged);
}

void Ledger::add_works(const Model& model, const State& state) noexcept {
  const FrameStep& f = state.frame;
  const double dt = model.dt, alpha = model.mass_damping, beta = model.stiffness_damping;
  const bool printed = model.scheme == Scheme::as_printed;
  const Vec2 rate = {-f.spin * f.spin, f.spin_rate};  // ṡJ - s²
  const auto works = work_sums_.sum(model.threads, [&](std::size_t i) {
    const auto k = static_cast<std::size_t>(model.free[i]);
    const double m = model.mass[k];
    const Vec2 v = state.v[k];
    const Vec2 mean = 0.5 * (v + state.v_next[k]);
    const Vec2 inertia = rate * (model.reference[k] + state.u[k]) + f.pull;
    const Vec2 stiffness_rate = (state.force[k] - state.force_before[k]) / dt;  // K v⁻
    return std::array<double, 4>{-dt * m * dot(mean, inertia),
                                 dt * alpha * m * dot(mean, printed ? v : mean),
                                 dt * beta * dot(mean, stiffness_rate),
                                 printed ? -2.0 * dt * f.spin * m * dot(mean, turn90(v)) : 0.0};
  });
  frame_.add(works[0]);
  mass_.add(works[1]);
  stiffness_.add(works[2]);
  scheme_.add(works[3]);
  add_contact(model, state);
}

void Ledger::add_contact(const Model& model, const State& state) noexcept {
  for (const ActiveContact& c : state.active) {
    const auto k = static_cast<std::size_t>(model.contact->nodes[c.candidate]);
    const Vec2 impulse = conj(state.frame.rotation) * (c.normal * c.impulse);  // turning frame
    const double work = dot(impulse, 0.5 * (state.v[k] + state.v_next[k]));
    const Vec2 mean = 0.5 * (c.before + c.after);
    contact_.add(work);
    friction_.add(-c.impulse.y * mean.y);
    impact_.add(-c.impulse.x * mean.x);
    rim_.add(work - dot(c.impulse, mean));
  }
}

}  // namespace rondo::dynamics
