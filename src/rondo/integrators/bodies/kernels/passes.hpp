// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loops of the step of several bodies over packs of rows. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/bodies/kernels/kernels.hpp"
#include "rondo/integrators/fused/kernels/update.hpp"

namespace {

using rondo::dynamics::kernels::BodyBlock;
using rondo::dynamics::kernels::BodyFields;
using rondo::dynamics::kernels::lanes;

inline Vectors turned_by(Pack x, Pack y, Vectors v) noexcept {
  return {fnma(y, v.y, x * v.x), fma(x, v.y, y * v.x)};
}
/// e = Rᵀ(u - shift) + (Rᵀ - 1) arm.
void elastic_pass(const BodyBlock& b) noexcept {
  const BodyFields& f = *b.fields;
  const Pack turn_x = all(b.pose->turn_x), against_y = all(-b.pose->turn_y);
  const Pack back_x = all(b.pose->back_x), back_y = all(b.pose->back_y);
  const Vectors shift = {all(b.pose->shift_x), all(b.pose->shift_y)};
  for (std::ptrdiff_t pack = b.first_pack; pack < b.last_pack; ++pack) {
    const Vectors u = load_vectors(f.motion + pack * 4 * lanes, lanes);
    const Vectors arm = load_vectors(f.constants + pack * 4 * lanes, lanes);
    const Vectors e =
        add_turned({back_x, back_y}, arm, turned_by(turn_x, against_y, minus(u, shift)));
    store_pairs(f.elastic + pack * 2 * lanes, e.x, e.y);
  }
}

template <bool Beta>
void force_pass(const BodyBlock& b) noexcept {
  using namespace rondo::dynamics::kernels;
  const BodyFields& f = *b.fields;
  Pack moment = all(0.0), change_moment = all(0.0), energy = all(0.0);
  for (std::ptrdiff_t pack = b.first_pack; pack < b.last_pack; ++pack) {
    const std::int64_t first = f.start[pack];
    Vectors p, e;
    row_products(f.start[pack + 1] - first, f.blocks + first * 4 * lanes, f.column + first * lanes,
                 f.elastic, p.x, p.y);
    load_pairs(f.elastic + pack * 2 * lanes, e.x, e.y);
    const Vectors arm = load_vectors(f.constants + pack * 4 * lanes, lanes);
    const Vectors place = plus(arm, e);
    double* force = f.force + pack * (Beta ? 4 : 2) * lanes;
    if constexpr (Beta) {
      const Vectors change = minus(p, load_vectors(force, lanes));
      store_vectors(force + 2 * lanes, lanes, change);
      change_moment = add_cross(place, change, change_moment);
    }
    store_vectors(force, lanes, p);
    moment = add_cross(place, p, moment);
    energy = add_dot(e, p, energy);
  }
  store(b.sums + force_moment * lanes, moment);
  store(b.sums + force_change_moment * lanes, change_moment);
  store(b.sums + force_energy * lanes, energy);
}

/// GroupPose, GroupTurning and StepFactors in every lane.
struct BodyPacks {
  explicit BodyPacks(const BodyBlock& b) noexcept
      : step(*b.step),
        turn_x(all(b.pose->turn_x)),
        turn_y(all(b.pose->turn_y)),
        elastic(all(b.turning->elastic)),
        damping(all(b.turning->damping)),
        pull{all(b.step->pull_x), all(b.step->pull_y)} {}
  Factors step;
  Pack turn_x, turn_y, elastic, damping;
  Vectors pull;
};

struct VelocitySums {
  Pack frame = all(0.0), mass = all(0.0), stiffness = all(0.0), load = all(0.0), before = all(0.0),
       after = all(0.0), strain = all(0.0);

  void store_to(double* to) const noexcept {
    using namespace rondo::dynamics::kernels;
    store(to + velocity_frame * lanes, frame);
    store(to + velocity_mass * lanes, mass);
    store(to + velocity_stiffness * lanes, stiffness);
    store(to + velocity_load * lanes, load);
    store(to + velocity_power_before * lanes, before);
    store(to + velocity_power_after * lanes, after);
    store(to + velocity_strain * lanes, strain);
  }
};

/// The fields and constants of a pack of nodes.
struct BodyNodes {
  Vectors u, v, arm;
  Pack mass, dt_over_mass;
};

inline BodyNodes nodes_of(const BodyFields& f, std::ptrdiff_t pack) noexcept {
  const double *motion = f.motion + pack * 4 * lanes, *constants = f.constants + pack * 4 * lanes;
  return {load_vectors(motion, lanes), load_vectors(motion + 2 * lanes, lanes),
          load_vectors(constants, lanes), load(constants + 2 * lanes), load(constants + 3 * lanes)};
}

/// Δt times the acceleration of the frame.
template <bool Held>
inline Vectors frame_of(const BodyPacks& c, const BodyNodes& n) noexcept {
  if constexpr (!Held) return c.pull;
  return add_turned(c.step.rate, plus(n.arm, n.u), c.pull);
}

/// The forces of the body's deformation on a pack of nodes, in their frame.
struct InternalForces {
  Vectors product;   ///< p
  Vectors gradient;  ///< (9.5); of held nodes p
  Vectors damping;   ///< (9.6)
};

/// R p - turning m J R arm. @param arm R arm
inline Vectors turned_force(const BodyPacks& c, Vectors p, Pack turning, Vectors arm) noexcept {
  const Vectors force = turned_by(c.turn_x, c.turn_y, p);
  return {fma(turning, arm.y, force.x), fnma(turning, arm.x, force.y)};
}

template <bool Held, bool Beta>
inline InternalForces forces_of(const BodyFields& f, const BodyPacks& c, const BodyNodes& n,
                                std::ptrdiff_t pack) noexcept {
  const double* force = f.force + pack * (Beta ? 4 : 2) * lanes;
  const Vectors p = load_vectors(force, lanes);
  InternalForces forces = {p, p, {all(0.0), all(0.0)}};
  if constexpr (Beta) {
    const Vectors change = load_vectors(force + 2 * lanes, lanes);
    forces.damping = {c.step.beta_over_dt * change.x, c.step.beta_over_dt * change.y};
  }
  if constexpr (!Held) {
    const Vectors arm = turned_by(c.turn_x, c.turn_y, n.arm);
    forces.gradient = turned_force(c, p, n.mass * c.elastic, arm);
    if constexpr (Beta) forces.damping = turned_force(c, forces.damping, n.mass * c.damping, arm);
  }
  return forces;
}

/// v⁺ of a pack and its part of the sums. @param load that acts on it; null: none
template <bool Held, bool Beta>
inline Vectors velocity_of(const BodyPacks& c, const BodyNodes& n, const InternalForces& forces,
                           const double* load, VelocitySums& s) noexcept {
  Vectors whole = forces.gradient;
  if constexpr (Beta) whole = plus(whole, forces.damping);
  if (load) whole = minus(whole, load_vectors(load, lanes));
  const Vectors frame = frame_of<Held>(c, n);
  // -[Δt f/m - drag v⁻]
  Vectors t = {fma(n.dt_over_mass, whole.x, frame.x), fma(n.dt_over_mass, whole.y, frame.y)};
  t = add_turned(c.step.drag, n.v, t);
  const Vectors after = minus(n.v, turned_by(c.step.inverse.x, c.step.inverse.y, t));

  const Vectors twice_mean = plus(n.v, after);
  s.frame = fma(n.mass, add_dot(twice_mean, frame, all(0.0)), s.frame);
  s.mass = fma(n.mass, add_dot(twice_mean, twice_mean, all(0.0)), s.mass);
  if constexpr (Beta) s.stiffness = add_dot(twice_mean, forces.damping, s.stiffness);
  if (load) s.load = add_dot(twice_mean, load_vectors(load, lanes), s.load);
  if constexpr (Held) {
    const Vectors before = {fnma(c.step.dt, n.v.x, n.u.x), fnma(c.step.dt, n.v.y, n.u.y)};
    s.strain = add_dot(before, forces.product, s.strain);
  } else {
    s.before = add_dot(n.v, forces.gradient, s.before);
    s.after = add_dot(after, forces.gradient, s.after);
  }
  return after;
}

/// Finds the forces and the load on the pack, and then v⁺ by them.
template <bool Held, bool Beta>
inline Vectors velocity_of(const BodyFields& f, const BodyPacks& c, const BodyNodes& n,
                           std::ptrdiff_t pack, VelocitySums& s) noexcept {
  const int place = f.load_at ? f.load_at[pack] : -1;
  return velocity_of<Held, Beta>(c, n, forces_of<Held, Beta>(f, c, n, pack),
                                 place < 0 ? nullptr : f.loads + place * 2 * lanes, s);
}

struct MoveSums {
  Pack kinetic = all(0.0);
  Vectors moved = {all(0.0), all(0.0)};
  Pack along = all(0.0), across = all(0.0), fastest = all(0.0);

  /// u_{n+2}
  Vectors add(const BodyNodes& n, Vectors v, Pack dt, Vectors shift) noexcept {
    const Vectors u = {fma(dt, v.x, n.u.x), fma(dt, v.y, n.u.y)};
    const Vectors d = minus(u, shift), weighted = {n.mass * d.x, n.mass * d.y};
    const Pack squared = add_dot(v, v, all(0.0));
    kinetic = fma(n.mass, squared, kinetic);
    fastest = larger(squared, fastest);
    moved = plus(moved, weighted);
    along = add_dot(n.arm, weighted, along);
    across = add_cross(n.arm, weighted, across);
    return u;
  }
  void store_to(double* to) const noexcept {
    using namespace rondo::dynamics::kernels;
    store(to + move_kinetic * lanes, kinetic);
    store(to + move_x * lanes, moved.x);
    store(to + move_y * lanes, moved.y);
    store(to + move_along * lanes, along);
    store(to + move_across * lanes, across);
    store(to + move_fastest * lanes, fastest);
  }
};

inline Vectors shift_of(const BodyBlock& b) noexcept {
  return {all(b.pose->shift_x), all(b.pose->shift_y)};
}

void move_pass(const BodyBlock& b) noexcept {
  const Pack dt = all(b.step->dt);
  const Vectors shift = shift_of(b);
  MoveSums sums;
  for (std::ptrdiff_t pack = b.first_pack; pack < b.last_pack; ++pack) {
    const BodyNodes n = nodes_of(*b.fields, pack);
    store_vectors(b.fields->motion + pack * 4 * lanes, lanes, sums.add(n, n.v, dt, shift));
  }
  sums.store_to(b.sums);
}

template <bool Held, bool Beta>
void velocity_pass(const BodyBlock& b) noexcept {
  const BodyPacks c(b);
  VelocitySums sums;
  for (std::ptrdiff_t pack = b.first_pack; pack < b.last_pack; ++pack) {
    const BodyNodes n = nodes_of(*b.fields, pack);
    store_vectors(b.fields->motion + (pack * 4 + 2) * lanes, lanes,
                  velocity_of<Held, Beta>(*b.fields, c, n, pack, sums));
  }
  sums.store_to(b.sums);
}

template <bool Held, bool Beta>
void velocity_and_move_pass(const BodyBlock& b) noexcept {
  const BodyPacks c(b);
  const Vectors shift = shift_of(b);
  VelocitySums sums;
  MoveSums way;
  for (std::ptrdiff_t pack = b.first_pack; pack < b.last_pack; ++pack) {
    const BodyNodes n = nodes_of(*b.fields, pack);
    const Vectors after = velocity_of<Held, Beta>(*b.fields, c, n, pack, sums);
    double* motion = b.fields->motion + pack * 4 * lanes;
    store_vectors(motion, lanes, way.add(n, after, c.step.dt, shift));
    store_vectors(motion + 2 * lanes, lanes, after);
  }
  sums.store_to(b.sums);
  way.store_to(b.sums + rondo::dynamics::kernels::n_velocity_sums * lanes);
}

constexpr rondo::dynamics::kernels::BodyTable body_table(const char* name) noexcept {
  return {name,
          elastic_pass,
          {force_pass<false>, force_pass<true>},
          {{velocity_pass<false, false>, velocity_pass<false, true>},
           {velocity_pass<true, false>, velocity_pass<true, true>}},
          move_pass,
          {{velocity_and_move_pass<false, false>, velocity_and_move_pass<false, true>},
           {velocity_and_move_pass<true, false>, velocity_and_move_pass<true, true>}}};
}

}  // namespace
