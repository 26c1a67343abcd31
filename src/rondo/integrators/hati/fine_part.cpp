// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/hati/fine_part.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/stiffness_product.hpp"

namespace rondo::dynamics {
namespace {

/// A as a body of its own, with the general step.
Model model_of(const Model& whole) {
  RONDO_DEMAND(whole.subdomains && whole.scheme == Scheme::hati && !whole.rim &&
               whole.free_bodies.empty() && !whole.surfaces && whole.pressures.empty() &&
               !has_friction_law(whole));
  const Subdomains& parts = *whole.subdomains;
  Model m;
  m.reference = whole.reference;
  m.mass = parts.fine.mass;
  m.free = parts.fine.free;
  m.stiffness = parts.fine.stiffness;
  m.mass_damping = whole.mass_damping;
  m.stiffness_damping = whole.stiffness_damping;
  m.motion = whole.motion;
  m.contact = whole.contact;
  m.body = whole.body;
  m.coupled = whole.coupled;
  m.dt = explicit_step(whole);
  m.threads = whole.threads;
  return m;
}

}  // namespace

FinePart::FinePart(const Model& whole, const PartFields& start)
    : model_(model_of(whole)),
      interface_(whole.subdomains->interface),
      ratio_(whole.subdomains->ratio),
      fields_{Field(model_.n_nodes(), 2), Field(model_.n_nodes(), 2)},
      state_(model_),
      contact_(model_),
      contacts_(at(ratio_)),
      contacts_before_(at(ratio_)),
      force_(model_.n_nodes()),
      rate_(model_.stiffness_damping > 0.0 ? model_.n_nodes() : 0),
      nowhere_(model_.n_nodes()),
      travel_(interface_.size()) {
  RONDO_DEMAND(ratio_ >= 1 && model_.mass.size() == model_.n_nodes() &&
                   start.u.size() == model_.n_nodes() &&
                   model_.stiffness.row_start.size() == model_.n_nodes() + 1,
               ratio_, model_.mass.size(), start.u.size(), model_.n_nodes());
  RONDO_ASSERT(std::ranges::includes(model_.free, interface_), model_.free.size(),
               interface_.size());  // both ascending
  for_free_nodes(model_, [&](std::size_t k) {
    fields_.u.plane()[k] = start.u.plane()[k];
    fields_.v.plane()[k] = start.v.plane()[k];
  });
}

void FinePart::set(PartFields fields, contact::KeptImpulses impulses) {
  RONDO_DEMAND(fields.u.size() == model_.n_nodes() && fields.v.size() == model_.n_nodes(),
               fields.u.size(), fields.v.size(), model_.n_nodes());
  fields_ = std::move(fields);
  kept_ = std::move(impulses);
}

void FinePart::attempt(long long n, std::span<const Vec2> multiplier) {
  RONDO_ASSERT(n >= 1, n);
  state_.u = fields_.u;
  state_.v = fields_.v;
  contact_.coupled().kept = kept_;
  std::swap(contacts_, contacts_before_);
  std::fill(travel_.begin(), travel_.end(), Vec2{});
  works_ = {};
  pull_ = {};
  for (int j = 1; j <= ratio_; ++j) {
    state_.step = (n - 1) * ratio_ + j;
    state_.frame = middle_frame_step(model_.motion, state_.step, model_.dt);
    const BodyFrame frame(model_, state_.frame);
    pull_ += state_.frame.pull.plane() / ratio_;
    move_half();
    find_forces(multiplier);
    find_free_velocities(frame, model_.reference);
    solve_contacts(BodyFrames(frame), contacts_[at(j - 1)]);
    add_travel(travel_);
    add_works(state_.frame);
    std::swap(state_.v, state_.v_next);
    move_half();
  }
}

void FinePart::accept() {
  std::swap(fields_.u, state_.u);
  std::swap(fields_.v, state_.v);
  kept_ = contact_.coupled().kept;
}

/// u += δ/2 v
void FinePart::move_half() noexcept {
  const double half = 0.5 * model_.dt;
  const std::span u = state_.u.plane(), v = state_.v.plane();
  for_free_nodes(model_, [&](std::size_t k) { u[k] += half * v[k]; });
}

void FinePart::find_forces(std::span<const Vec2> multiplier) noexcept {
  RONDO_ASSERT(multiplier.size() == interface_.size(), multiplier.size(), interface_.size());
  apply(model_.stiffness, state_.u, force_, model_.threads);
  if (!rate_.empty()) {
    apply(model_.stiffness, state_.v, rate_, model_.threads);
    const double beta = model_.stiffness_damping;
    for_free_nodes(model_, [&](std::size_t k) { force_[k] += beta * rate_[k]; });
  }
  for (std::size_t i = 0; i < interface_.size(); ++i) force_[at(interface_[i])] -= multiplier[i];
}

/// v⁺ = v⁻ + [δ f/m - drag v⁻]/a, without contact (3.4). @param reference X: 0 for what is linear
void FinePart::find_free_velocities(const BodyFrame& frame,
                                    std::span<const Vec2> reference) noexcept {
  const std::span u = state_.u.plane(), v = state_.v.plane(), v_next = state_.v_next.plane();
  for_free_nodes(model_, [&](std::size_t k) {
    const Vec2 acceleration =
        -(force_[k] / model_.mass[k]) - frame_acceleration(frame.frame, reference[k] + u[k]);
    v_next[k] = v[k] + (model_.dt * acceleration - frame.update.drag * v[k]) / frame.update.a;
  });
}

void FinePart::solve_contacts(const BodyFrames& frames, FineContact& found) {
  found.report = contact_.solve(frames, state_.frame.center.plane(), state_);
  found.active = state_.active;
  works_.contact += found.report.work;
  works_.dissipation_friction += found.report.dissipation_friction;
  works_.loss_impact += found.report.loss_impact;
  works_.rim += found.report.work_rim;
}

/// δ v̄ of the interface.
void FinePart::add_travel(std::span<Vec2> travel) const noexcept {
  RONDO_ASSERT(travel.size() == interface_.size(), travel.size(), interface_.size());
  const double half = 0.5 * model_.dt;
  const std::span v = state_.v.plane(), v_next = state_.v_next.plane();
  for (std::size_t i = 0; i < interface_.size(); ++i) {
    const std::size_t k = at(interface_[i]);
    travel[i] += half * (v[k] + v_next[k]);
  }
}

/// (5.3) of a kick, without that of the multiplier.
void FinePart::add_works(const FrameStep& frame) noexcept {
  const double dt = model_.dt, alpha = model_.mass_damping, beta = model_.stiffness_damping;
  const std::span u = state_.u.plane(), v = state_.v.plane(), v_next = state_.v_next.plane();
  for_free_nodes(model_, [&](std::size_t k) {
    const double m = model_.mass[k];
    const Vec2 mean = 0.5 * (v[k] + v_next[k]);
    works_.frame -= dt * m * dot(mean, frame_acceleration(frame, model_.reference[k] + u[k]));
    works_.dissipation_mass += dt * alpha * m * dot(mean, mean);
    if (!rate_.empty()) works_.dissipation_stiffness += dt * beta * dot(mean, rate_[k]);
  });
}

/// (12.4): ½ vᵀ(M - δ²/4 K)v + ½ uᵀK u
void FinePart::add_energy(double& kinetic, double& strain) {
  const double quarter = 0.25 * model_.dt * model_.dt;
  const std::span u = fields_.u.plane(), v = fields_.v.plane();
  apply(model_.stiffness, v, force_, model_.threads);
  for_free_nodes(model_, [&](std::size_t k) {
    kinetic += 0.5 * dot(v[k], model_.mass[k] * v[k] - quarter * force_[k]);
  });
  apply(model_.stiffness, u, force_, model_.threads);
  for_free_nodes(model_, [&](std::size_t k) { strain += 0.5 * dot(u[k], force_[k]); });
}

bool FinePart::same_impulses() const noexcept {
  const auto same = [](const FineContact& a, const FineContact& b) {
    return std::ranges::equal(a.active, b.active, [](const auto& p, const auto& q) {
      return p.candidate == q.candidate && p.impulse == q.impulse && p.normal == q.normal;
    });
  };
  return std::ranges::equal(contacts_, contacts_before_, same);
}

void FinePart::respond(std::span<const Vec2> multiplier, std::span<Vec2> travel) {
  std::ranges::fill(state_.u.plane(), Vec2{});
  std::ranges::fill(state_.v.plane(), Vec2{});
  std::fill(travel.begin(), travel.end(), Vec2{});
  FrameStep only_spin;
  only_spin.spin = -model_.motion.angular_velocity.at(0.0);
  const BodyFrame frame(model_, only_spin);
  for (int j = 0; j < ratio_; ++j) {
    move_half();
    find_forces(multiplier);
    find_free_velocities(frame, nowhere_);
    add_travel(travel);
    std::swap(state_.v, state_.v_next);
    move_half();
  }
}

}  // namespace rondo::dynamics
