// SPDX-License-Identifier: BSD-3-Clause
/// @file  The readable step of a body on a loaded rim (docs/theory.md, section 10), in the plane
/// and in space: central differences of absolute positions, so that momenta are kept, and contact
/// that is not coupled to the rim. Plane and space differ in their forces, contacts and rim.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/general/readable_step.hpp"
#include "rondo/model/loaded_rim.hpp"

namespace rondo::dynamics {

/// @tparam Of types Vec, Forces, Contacts and Rim, with the members that are used here: PlaneWheel
/// (wheel_integrator.hpp) and SpaceWheel (solid/solid_wheel_integrator.hpp).
template <class Of>
class WheelStep : public ReadableStep {
 public:
  using Vec = typename Of::Vec;

  /// @pre model.rim, no free body, the scheme "symplectic"
  WheelStep(const Model& model, const State& start);

  void fields(State& state) const noexcept override;

 protected:
  typename Of::Contacts contacts_;

 private:
  void make_step(StepEnergy& energy, StepReport& report) noexcept override;
  void velocities(Field& before, Field& after) const noexcept override;
  void save_fields(SavedState& saved) const override;
  void restore_fields(const SavedState& saved) override;
  void move(StepEnergy& energy) noexcept;
  [[nodiscard]] RimForceOf<Vec> find_velocities(Vec gravity) noexcept;
  void find_next() noexcept;
  void add_works(Vec gravity, Works& works) const noexcept;

  using Values = std::span<Vec>;
  using Constants = std::span<const Vec>;
  [[nodiscard]] Vec arm(std::size_t k, Vec u) const noexcept {
    return reference_of<Vec>(model_, k) + u;
  }
  static Vec2 in_plane(Vec2 a) noexcept { return a; }
  static Vec2 in_plane(Vec3 a) noexcept { return a.plane(); }
  /// Writes (after - before)/Δt of the free nodes: velocities relative to the rim        [m/s]
  void find_rates(Constants before, Constants after, Values rate) const noexcept;

  typename Of::Rim rim_;
  // state_ has u_{n+1}, and in v and v_next absolute velocities in the axes of R_{n+1}   [m/s]
  Field before_, next_;        ///< (n) u_n, u_{n+2}                                      [m]
  std::vector<Vec> absolute_;  ///< (n) V of the half step after, fixed frame            [m/s]
  typename Of::Forces forces_;
  RimForceOf<Vec> rim_load_;  ///< of the pressures, by clamped nodes
};

template <class Of>
WheelStep<Of>::WheelStep(const Model& model, const State& start)
    : ReadableStep(model, start),
      contacts_(model),
      rim_(model),
      before_(start.u),
      next_(start.u),
      absolute_(model.n_nodes()),
      forces_(model, start) {
  RONDO_DEMAND(model.rim && model.free_bodies.empty() && model.scheme == Scheme::symplectic);
  RONDO_DEMAND(!start.rim.empty());
  rim_.restore(start.step, start.rim);
  const Constants u = start.u, v = start.v_next;
  const Values next = next_;
  for_free_nodes(model, [&](std::size_t k) {
    next[k] = u[k] + model.dt * v[k];
    absolute_[k] = rim_.frame().rotation * rim_.velocity_of(arm(k, u[k]), next[k] - u[k]);
  });
}

template <class Of>
void WheelStep<Of>::find_rates(Constants before, Constants after, Values rate) const noexcept {
  RONDO_ASSERT(rate.size() == before.size() && after.size() == before.size(), rate.size());
  for_free_nodes(model_, [&](std::size_t k) { rate[k] = (after[k] - before[k]) / model_.dt; });
}

/// The rim and u to t_{n+1}; forces there; energies of the half step before.
template <class Of>
void WheelStep<Of>::move(StepEnergy& energy) noexcept {
  rim_.move();
  state_.frame = rim_.frame();
  std::swap(before_, state_.u);
  std::swap(state_.u, next_);
  const Values relative = state_.v_next;  // overwritten later in the step
  find_rates(before_, state_.u, relative);
  energy.strain = forces_.evaluate(state_.u, relative, state_.frame);
  const Complex back = conj(state_.frame.rotation);
  const Values v = state_.v;
  for_free_nodes(model_, [&](std::size_t k) {
    v[k] = back * absolute_[k];
    energy.kinetic += 0.5 * model_.mass[k] * dot(absolute_[k], absolute_[k]);
  });
}

/// V⁺ = V⁻ + Δt (g - q/m), without contact. @return what q does to the rim
template <class Of>
RimForceOf<typename Of::Vec> WheelStep<Of>::find_velocities(Vec gravity) noexcept {
  const Constants u = state_.u, v = state_.v;
  const Values relative = state_.v_next;
  RimForceOf<Vec> sum;
  for_free_nodes(model_, [&](std::size_t k) {
    const double m = model_.mass[k];
    const Vec q = forces_.gradient(k) + model_.mass_damping * m * relative[k] + forces_.damping(k);
    sum.force += q;
    sum.moment += cross(in_plane(arm(k, u[k])), in_plane(q));
    relative[k] = v[k] + model_.dt * ((forces_.load(k) - q) / m + gravity);
  });
  rim_load_ = forces_.on_rim();
  return {sum.force + rim_load_.force, sum.moment + rim_load_.moment};
}

/// u_{n+2}.
template <class Of>
void WheelStep<Of>::find_next() noexcept {
  const Constants u = state_.u, v_next = state_.v_next;
  const Values next = next_;
  for_free_nodes(model_,
                 [&](std::size_t k) { next[k] = u[k] + rim_.travel(arm(k, u[k]), v_next[k]); });
}

/// (10.5): works of q are on the increment D of a node's place as the rim sees it, less what the
/// rim's own rotation makes of it. Along the axle D is twice the mean travel.
template <class Of>
void WheelStep<Of>::add_works(Vec gravity, Works& w) const noexcept {
  const double dt = model_.dt, alpha = model_.mass_damping;
  const LoadedRim& rim = rim_.plane();
  const Complex after = rim.turn(), before = conj(rim.turn_before());
  const double bend = after.re - before.re;  // cos δ⁺ - cos δ⁻
  const Vec center = conj(state_.frame.rotation) * (rim_.velocity() + rim_.velocity_before());
  w.load += 0.5 * dt *
            (dot(center, rim_load_.force) + (rim.spin() + rim.spin_before()) * rim_load_.moment);
  const Constants u_before = before_, u = state_.u, next = next_, v = state_.v,
                  v_next = state_.v_next;
  for_free_nodes(model_, [&](std::size_t k) {
    const Vec was = (u[k] - u_before[k]) / dt, is = (next[k] - u[k]) / dt;
    const Vec2 excess =
        bend * in_plane(arm(k, u[k])) + dt * (after * in_plane(is) + before * in_plane(was));
    const Vec way = Vec(excess) + dt * (is + was);  // D
    const Vec mean = 0.5 * (v[k] + v_next[k]);
    w.scheme -= 0.5 * dot(in_plane(forces_.gradient(k)), excess);
    w.dissipation_mass += 0.5 * alpha * model_.mass[k] * dot(was, way);
    w.dissipation_stiffness += 0.5 * dot(forces_.damping(k), way);
    w.load += dt * dot(mean, forces_.load(k));
    w.gravity += dt * model_.mass[k] * dot(mean, gravity);
  });
}

template <class Of>
void WheelStep<Of>::make_step(StepEnergy& energy, StepReport& report) noexcept {
  move(energy);
  const Vec gravity = rim_.gravity();
  const RimForceOf<Vec> q = find_velocities(gravity);
  report.contact = contacts_.solve(model_, state_);
  const Constants v = state_.v, v_next = state_.v_next;
  for_free_nodes(
      model_, [&](std::size_t k) { absolute_[k] += state_.frame.rotation * (v_next[k] - v[k]); });
  rim_.take(q);
  state_.frame = rim_.frame();
  find_next();
  const StepEnergy of_rim = rim_.energy();
  energy.kinetic_rim = of_rim.kinetic_rim;
  energy.support = of_rim.support;
  energy.works = of_rim.works;
  add_works(gravity, energy.works);
  add_contact_works(report.contact, energy.works);
  report.frame = state_.frame;
  report.material = forces_.material();
  report.rim = rim_.plane().report();
}

template <class Of>
void WheelStep<Of>::velocities(Field& before, Field& after) const noexcept {
  if (!before.empty()) find_rates(before_, state_.u, before);
  if (!after.empty()) find_rates(state_.u, next_, after);
}

template <class Of>
void WheelStep<Of>::fields(State& state) const noexcept {
  state.u = next_;
  find_rates(state_.u, next_, state.v_next);
}

template <class Of>
void WheelStep<Of>::save_fields(SavedState& saved) const {
  saved.u = next_;
  saved.u_before = state_.u;
  saved.v = absolute_;
  saved.rim = rim_.save();
  forces_.save(saved);
  saved.impulses = contacts_.impulses();
}

template <class Of>
void WheelStep<Of>::restore_fields(const SavedState& saved) {
  RONDO_DEMAND(saved.u_before.size() == model_.n_nodes(), saved.u_before.size());
  next_ = saved.u;
  state_.u = saved.u_before;
  absolute_ = to_vector(Constants(saved.v));
  rim_.restore(saved.step, saved.rim);
  forces_.restore(saved);
  contacts_.set_impulses(saved.impulses);
}

}  // namespace rondo::dynamics
