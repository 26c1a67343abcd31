// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/stepper.hpp"

#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/threads.hpp"
#include "rondo/dynamics/operator.hpp"

namespace rondo::dynamics {
namespace {

template <class Body>
void for_free_nodes(const Model& model, Body&& body) noexcept {
  for_blocks(model.free.size(), model.threads,
             [&](std::size_t begin, std::size_t end, std::size_t) {
               for (std::size_t i = begin; i < end; ++i)
                 body(static_cast<std::size_t>(model.free[i]));
             });
}

/// f/m at t_{n+1} (3.2): -(K u + β K v)/m - (ṡJ - s²)(X + u) - Rᵀ(c̈ - g).
struct Acceleration {
  const Model& model;
  const State& state;
  Vec2 rate;  ///< ṡJ - s²

  Vec2 operator()(std::size_t k, Vec2 stiffness_rate) const noexcept {
    const Vec2 elastic = state.force[k] + model.stiffness_damping * stiffness_rate;
    const Vec2 inertia = rate * (model.reference[k] + state.u[k]) + state.frame.pull;
    return -(elastic / model.mass[k]) - inertia;
  }
};

Acceleration acceleration(const Model& model, const State& state) noexcept {
  const FrameStep& f = state.frame;
  return {model, state, {-f.spin * f.spin, f.spin_rate}};
}

void advance_displacement(const Model& model, State& state) noexcept {
  for_free_nodes(model, [&](std::size_t k) { state.u[k] += model.dt * state.v[k]; });
}

/// v⁺ = v⁻ + [Δt f/m - drag v⁻]/a, without contact (3.4). The increment form does not drift.
void free_velocities(const Model& model, State& state, const VelocityUpdate& update) noexcept {
  const Acceleration f = acceleration(model, state);
  const Vec2 inverse = Vec2{1.0, 0.0} / update.a;
  for_free_nodes(model, [&](std::size_t k) {
    const Vec2 v = state.v[k];
    const Vec2 stiffness_rate = (state.force[k] - state.force_before[k]) / model.dt;  // K v⁻
    state.v_next[k] = v + inverse * (model.dt * f(k, stiffness_rate) - update.drag * v);
  });
}

}  // namespace

State start(const Model& model, std::span<const Vec2> u0, std::span<const Vec2> v0) {
  RONDO_DEMAND(u0.size() == model.n_nodes() && v0.size() == model.n_nodes(), u0.size(), v0.size());
  RONDO_DEMAND(model.dt > 0.0, model.dt);
  State state(model);
  state.frame = frame_step(model.motion, 0, model.dt);
  for (const int node : model.free) {
    const auto k = static_cast<std::size_t>(node);
    state.u[k] = u0[k];
    state.v[k] = v0[k];
  }
  std::vector<Vec2> stiffness_rate(model.n_nodes());
  apply(model.stiffness, state.u, state.force, model.threads);
  apply(model.stiffness, state.v, stiffness_rate, model.threads);
  const double half = 0.5 * model.dt;
  const VelocityUpdate update =
      velocity_update(model.scheme, half, model.mass_damping, state.frame.spin);
  const Acceleration f = acceleration(model, state);
  for_free_nodes(model, [&](std::size_t k) {
    const Vec2 v = state.v[k];
    state.v_next[k] = v + (half * f(k, stiffness_rate[k]) - update.drag * v) / update.a;
  });
  return state;
}

ContactReport advance(const Model& model, State& state, Ledger& ledger) noexcept {
  std::swap(state.v, state.v_next);
  std::swap(state.force, state.force_before);
  state.frame = frame_step(model.motion, ++state.step, model.dt);
  advance_displacement(model, state);
  ledger.balance(model, state);
  apply(model.stiffness, state.u, state.force, model.threads);
  const VelocityUpdate update =
      velocity_update(model.scheme, model.dt, model.mass_damping, state.frame.spin);
  free_velocities(model, state, update);
  const ContactReport report =
      model.contact ? contact_phase(model, state, update) : ContactReport{};
  ledger.add_works(model, state);
  return report;
}

}  // namespace rondo::dynamics
