// SPDX-License-Identifier: BSD-3-Clause
/// @file  Velocity update, way and ledger terms of a pack of nodes on a loaded rim (docs/theory.md,
/// section 10), for both operators. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/update.hpp"

namespace {

using rondo::dynamics::kernels::lanes;
using rondo::dynamics::kernels::WheelFactors;
using rondo::dynamics::kernels::WheelWay;

/// A vector of the co-rotating frame in the frames of a pack of sectors.
/// @tparam Strip CyclicStrip or SolidStrip
template <class Strip>
inline Vectors to_sectors(const Strip& s, std::ptrdiff_t column, double x, double y) noexcept {
  const Pack cosine = load(s.turn_x + column), sine = load(s.turn_y + column);
  const Pack px = all(x), py = all(y);
  return {fma(py, sine, px * cosine), fnma(px, sine, py * cosine)};
}
/// And back.
template <class Strip>
inline Vectors from_sectors(const Strip& s, std::ptrdiff_t column, Vectors a) noexcept {
  const Pack cosine = load(s.turn_x + column), sine = load(s.turn_y + column);
  return {fnma(a.y, sine, a.x * cosine), fma(a.x, sine, a.y * cosine)};
}

/// Lanes of a pack that are the chunk's own.
template <class Strip>
inline int own_lanes(const Strip& s, std::ptrdiff_t column) noexcept {
  const std::ptrdiff_t left = s.columns - column;
  return left < lanes ? static_cast<int>(left) : lanes;
}

inline Vectors own_of(int own, Vectors a) noexcept {
  const Vectors zero = {all(0.0), all(0.0)};
  return first_of(own, a, zero);
}

/// s a + b
inline Vectors add_times(Pack s, Vectors a, Vectors b) noexcept {
  return {fma(s, a.x, b.x), fma(s, a.y, b.y)};
}
/// Sums over the packs in hand.
struct WheelSums {
  Pack kinetic, strain, force_arm, force_moment, force_after, force_across, force_moved,
      force_turned, mass_mean, mass_moment, change_mean, change_moment;
};

inline WheelSums no_wheel_sums() noexcept {
  const Pack zero = all(0.0);
  return {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
}

/// Vectors that are summed up: in the frames of their nodes, masses included.
struct Resultants {
  Vectors force, change, mass, momentum;
};

inline Resultants no_resultants() noexcept {
  const Vectors zero = {all(0.0), all(0.0)};
  return {zero, zero, zero, zero};
}

/// WheelFactors in every lane.
struct WheelPacks {
  explicit WheelPacks(const WheelFactors& f) noexcept
      : alpha_over_dt(all(f.alpha_over_dt)),
        beta_over_dt(all(f.beta_over_dt)),
        back{all(f.back_x), all(f.back_y)} {}
  Pack alpha_over_dt, beta_over_dt;
  Vectors back;
};

/// The values that the update of a pack reads; `pull` with gravity only.
struct WheelNodes {
  Vectors u, u_before, a, force, before, reference, pull;
  Pack mass, dt_over_mass;
};

/// Sets nodes outside the chunk's own sectors to zero, so that they add nothing to the sums.
inline WheelNodes own_nodes(int own, const WheelNodes& n) noexcept {
  WheelNodes m = n;
  m.u = own_of(own, n.u);
  m.u_before = own_of(own, n.u_before);
  m.a = own_of(own, n.a);
  m.force = own_of(own, n.force);
  m.before = own_of(own, n.before);
  m.pull = own_of(own, n.pull);
  return m;
}

/// a⁺ = a⁻ + Δt (g - q/m) with q = p + β e/Δt + α m d/Δt, and its part of the sums.
template <bool Heavy>
inline Vectors wheel_update(const WheelPacks& f, const WheelNodes& n, WheelSums& s,
                            Resultants& r) noexcept {
  const Vectors before = add_turned(f.back, n.a, n.a);
  const Vectors moved = minus(n.u, n.u_before), change = minus(n.force, n.before);
  const Vectors arm = plus(n.reference, n.u);
  Vectors q = add_times(f.beta_over_dt, change, n.force);
  const Vectors momentum = {n.mass * moved.x, n.mass * moved.y};  // over Δt
  q = add_times(f.alpha_over_dt, momentum, q);
  Vectors after = {fnma(n.dt_over_mass, q.x, before.x), fnma(n.dt_over_mass, q.y, before.y)};
  if constexpr (Heavy) after = plus(after, n.pull);

  const Vectors twice_mean = plus(before, after);
  s.kinetic = fma(n.mass, fma(before.x, before.x, before.y * before.y), s.kinetic);
  s.strain = add_dot(n.u_before, n.force, s.strain);
  s.force_arm = add_dot(arm, n.force, s.force_arm);
  s.force_moment = add_cross(arm, n.force, s.force_moment);
  s.force_after = add_dot(n.force, after, s.force_after);
  s.force_across = add_cross(n.force, after, s.force_across);
  s.force_moved = add_dot(n.force, moved, s.force_moved);
  s.force_turned = add_cross(n.force, moved, s.force_turned);
  s.mass_mean = add_dot(momentum, twice_mean, s.mass_mean);
  s.mass_moment = add_cross(arm, momentum, s.mass_moment);
  s.change_mean = add_dot(change, twice_mean, s.change_mean);
  s.change_moment = add_cross(arm, change, s.change_moment);
  r.force = plus(r.force, n.force);
  r.change = plus(r.change, change);
  r.mass = plus(r.mass, momentum);
  if constexpr (Heavy) r.momentum = add_times(n.mass, twice_mean, r.momentum);
  return after;
}

/// WheelWay in every lane.
struct WayPacks {
  explicit WayPacks(const WheelWay& w) noexcept
      : turn{all(w.turn_x), all(w.turn_y)}, way{all(w.way_x), all(w.way_y)} {}
  Vectors turn, way;
};

/// u_{n+2} = u + (e^{-iδ} - 1) y + Δt e^{-iδ} (a⁺ - h). @param hub h in the frame of the nodes
inline Vectors wheel_way(const WayPacks& w, Vectors hub, Vectors reference, Vectors u,
                         Vectors a) noexcept {
  const Vectors zero = {all(0.0), all(0.0)};
  const Vectors step =
      add_turned(w.turn, plus(reference, u), add_turned(w.way, minus(a, hub), zero));
  return plus(u, step);
}

/// visit(which sum, value) of all.
template <bool Heavy, class Visit>
inline void for_resultants(const Resultants& r, Visit&& visit) noexcept {
  using namespace rondo::dynamics::kernels;
  visit(wheel_force_x, r.force.x);
  visit(wheel_force_y, r.force.y);
  visit(wheel_change_x, r.change.x);
  visit(wheel_change_y, r.change.y);
  visit(wheel_mass_x, r.mass.x);
  visit(wheel_mass_y, r.mass.y);
  if constexpr (Heavy) {
    visit(wheel_momentum_x, r.momentum.x);
    visit(wheel_momentum_y, r.momentum.y);
  }
}
/// visit(which sum, value) of all.
template <class Visit>
inline void for_sums(const WheelSums& s, Visit&& visit) noexcept {
  using namespace rondo::dynamics::kernels;
  visit(wheel_kinetic, s.kinetic);
  visit(wheel_strain, s.strain);
  visit(wheel_force_arm, s.force_arm);
  visit(wheel_force_moment, s.force_moment);
  visit(wheel_force_after, s.force_after);
  visit(wheel_force_across, s.force_across);
  visit(wheel_force_moved, s.force_moved);
  visit(wheel_force_turned, s.force_turned);
  visit(wheel_mass_mean, s.mass_mean);
  visit(wheel_mass_moment, s.mass_moment);
  visit(wheel_change_mean, s.change_mean);
  visit(wheel_change_moment, s.change_moment);
}

}  // namespace
