// SPDX-License-Identifier: BSD-3-Clause
/// @file  Velocity update, way and ledger terms of a wheel in three dimensions on a loaded rim: the
/// plane's (wheel_update.hpp) with the axial component beside. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/solid/strip.hpp"
#include "rondo/integrators/fused/kernels/wheel_update.hpp"

namespace {

/// Sums of a row that the plane does not have, without the mass.
struct AxialSums {
  Pack force, change, moved, twice_mean, load, rest, force_moved;
};

/// Sums of a row: resultants as vectors of its frame in sector 0.
struct SolidWheelSums {
  WheelSums plane = no_wheel_sums();
  Resultants resultants = no_resultants();
  AxialSums axial = {all(0.0), all(0.0), all(0.0), all(0.0), all(0.0), all(0.0), all(0.0)};
};

inline Vectors plane_of(Space a) noexcept {
  return {a.r, a.t};
}

/// a⁺ along the axle, and its part of the sums: they are those of wheel_update(). @param pull with
/// the load of the node
inline Pack axial_update(const WheelFactors& f, const SolidRow& row, const SpaceNodes& n,
                         Pack u_before, Pack pull, SolidWheelSums& s) noexcept {
  const Pack mass = all(row.mass), change = n.force.z - n.before.z;
  const Pack moved = n.u.z - u_before, momentum = mass * moved;
  Pack q = fma(all(f.beta_over_dt), change, n.force.z);
  q = fma(all(f.alpha_over_dt), momentum, q);
  const Pack after = fnma(all(row.dt_over_mass), q, n.v.z) + pull;
  const Pack twice_mean = n.v.z + after;
  s.plane.kinetic = fma(mass, n.v.z * n.v.z, s.plane.kinetic);
  s.plane.strain = fma(u_before, n.force.z, s.plane.strain);
  s.plane.mass_mean = fma(momentum, twice_mean, s.plane.mass_mean);
  s.plane.change_mean = fma(change, twice_mean, s.plane.change_mean);
  s.axial.force = s.axial.force + n.force.z;
  s.axial.change = s.axial.change + change;
  s.axial.moved = s.axial.moved + moved;
  s.axial.force_moved = fma(n.force.z, moved, s.axial.force_moved);
  s.axial.twice_mean = s.axial.twice_mean + twice_mean;
  return after;
}

/// Sets nodes outside the chunk's own sectors to zero, so that they add nothing to the sums.
inline void keep_own(int own, SpaceNodes& n, Space& u_before, Space& pull) noexcept {
  const Space zero = {all(0.0), all(0.0), all(0.0)};
  n.u = first_of(own, n.u, zero);
  n.v = first_of(own, n.v, zero);
  n.force = first_of(own, n.force, zero);
  n.before = first_of(own, n.before, zero);
  u_before = first_of(own, u_before, zero);
  pull = first_of(own, pull, zero);
}

/// Gravity and the load of the row, as they change the velocity of its nodes.
inline Space pull_of(const SolidStrip& s, int r, std::ptrdiff_t column) noexcept {
  const SolidRow& row = s.rows[r];
  const WheelFactors& f = *s.wheel;
  const Vectors pull = to_sectors(s, column, f.pull_x * row.turn_x + f.pull_y * row.turn_y,
                                  f.pull_y * row.turn_x - f.pull_x * row.turn_y);
  const double h = row.dt_over_mass;
  return {pull.x + all(h * s.load[r][0]), pull.y + all(h * s.load[r][1]),
          all(f.pull_z + h * s.load[r][2])};
}

/// Update and sums of one pack of a row.
inline void solid_wheel_pack(const SolidStrip& s, const WheelPacks& f, int r, std::ptrdiff_t column,
                             const double* force, SolidWheelSums& sums) noexcept {
  const SolidRow& row = s.rows[r];
  const std::ptrdiff_t at = row.at + column;
  double* const a = s.velocity + at;
  double* const p = s.force + at;
  SpaceNodes n = {load_space(s.now + at, s.stride), load_space(a, s.stride),
                  load_space(force, most_packs * lanes), load_space(p, s.stride)};
  Space u_before = load_space(s.next + at, s.stride), pull = pull_of(s, r, column);
  const int own = own_lanes(s, column);
  if (own < lanes) keep_own(own, n, u_before, pull);
  const WheelNodes plane = {plane_of(n.u),     plane_of(u_before), plane_of(n.v),
                            plane_of(n.force), plane_of(n.before), {all(row.x), all(row.y)},
                            plane_of(pull),    all(row.mass),      all(row.dt_over_mass)};
  Resultants resultants = no_resultants();
  const Vectors after = wheel_update<true>(f, plane, sums.plane, resultants);
  Resultants& all_of = sums.resultants;
  all_of.force = plus(all_of.force, from_sectors(s, column, resultants.force));
  all_of.change = plus(all_of.change, from_sectors(s, column, resultants.change));
  all_of.mass = plus(all_of.mass, from_sectors(s, column, resultants.mass));
  all_of.momentum = plus(all_of.momentum, from_sectors(s, column, resultants.momentum));
  // The rotation by δ⁻ leaves what is along the axle.
  const Space end = {after.x, after.y, axial_update(*s.wheel, row, n, u_before.z, pull.z, sums)};
  const Vectors back = add_turned(f.back, plane.a, plane.a);
  const Space load_of = {all(s.load[r][0]), all(s.load[r][1]), all(s.load[r][2])};
  sums.axial.load =
      add_dot(load_of, {back.x + end.r, back.y + end.t, n.v.z + end.z}, sums.axial.load);
  sums.axial.rest = fma(n.u.r, all(row.rest_y), fnma(n.u.t, all(row.rest_x), sums.axial.rest));
  store_space(a, s.stride, end);
  store_space(p, s.stride, n.force);
}

/// Adds the sums of a row to those of its group.
inline void add_row(const SolidRow& row, const SolidWheelSums& s, double* sums) noexcept {
  using namespace rondo::dynamics::kernels;
  const auto add = [&](int k, Pack value) {
    store(sums + k * lanes, load(sums + k * lanes) + value);
  };
  const Vectors turn = {all(row.turn_x), all(row.turn_y)}, none = {all(0.0), all(0.0)};
  const auto turned = [&](Vectors a) { return add_turned(turn, a, none); };
  const Resultants& r = s.resultants;
  for_resultants<true>(
      Resultants{turned(r.force), turned(r.change), turned(r.mass), turned(r.momentum)}, add);
  for_sums(s.plane, add);
  const Pack mass = all(row.mass);
  add(wheel_force_z, s.axial.force);
  add(wheel_change_z, s.axial.change);
  add(wheel_mass_z, mass * s.axial.moved);
  add(wheel_momentum_z, mass * s.axial.twice_mean);
  add(wheel_load, s.axial.load);
  add(wheel_rest, s.axial.rest);
  add(wheel_force_moved_z, s.axial.force_moved);
}

/// Adds the forces of cords and air, p_n·d, and what add_swept() gives.
inline void add_work(const SolidStrip& s, int r, std::ptrdiff_t column, double* force, Pack& work,
                     Pack& linear) noexcept {
  const SolidRow& row = s.rows[r];
  const std::ptrdiff_t at = row.at + column;
  const Pack zero = all(0.0), more = add_swept(s, row, column, force);
  const Space u = load_space(s.now + at, s.stride), last = load_space(s.next + at, s.stride);
  const Space moved = {u.r - last.r, u.t - last.t, u.z - last.z};
  const Pack way = add_dot(load_space(s.force + at, s.stride), moved, zero);
  const int own = own_lanes(s, column);
  work = work + (own < lanes ? first_lanes(own, way, zero) : way);
  linear = linear + (own < lanes ? first_lanes(own, more, zero) : more);
}

void solid_wheel_strip(const SolidStrip& s) noexcept {
  using rondo::dynamics::kernels::wheel_linear;
  const WheelPacks f(*s.wheel);
  const int own = (s.columns + lanes - 1) / lanes;
  double* sums = s.sums;
  for (int first = 0; first < own; first += solid_packs, sums += s.n_sums * lanes) {
    const int last = first + solid_packs < own ? first + solid_packs : own;
    SolidForces force;
    strip_product(s, first, last - first, force);
    for (int r = 0; r < s.n_rows; ++r) {
      SolidWheelSums row;
      Pack work = all(0.0), linear = all(0.0);
      for (int pack = first; s.swept && pack < last; ++pack)
        add_work(s, r, static_cast<std::ptrdiff_t>(pack) * lanes,
                 force.f[r][0] + static_cast<std::ptrdiff_t>(pack - first) * lanes, work, linear);
      for (int pack = first; pack < last; ++pack)
        solid_wheel_pack(s, f, r, static_cast<std::ptrdiff_t>(pack) * lanes,
                         force.f[r][0] + static_cast<std::ptrdiff_t>(pack - first) * lanes, row);
      if (s.swept) {
        row.plane.strain = work;
        store(sums + wheel_linear * lanes, load(sums + wheel_linear * lanes) + linear);
      }
      add_row(s.rows[r], row, sums);
    }
  }
}

void solid_wheel_way(const SolidStrip& s) noexcept {
  const WheelWay& w = *s.way;
  const WayPacks way(w);
  const Space zero = {all(0.0), all(0.0), all(0.0)};
  const int own = (s.columns + lanes - 1) / lanes;
  for (int r = 0; r < s.n_rows; ++r) {
    const SolidRow& row = s.rows[r];
    const double hub_x = w.hub_x * row.turn_x + w.hub_y * row.turn_y,
                 hub_y = w.hub_y * row.turn_x - w.hub_x * row.turn_y;
    for (int pack = 0; pack < own; ++pack) {
      const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(pack) * lanes, at = row.at + column;
      const Space now = load_space(s.now + at, s.stride), a = load_space(s.velocity + at, s.stride);
      const Vectors u = wheel_way(way, to_sectors(s, column, hub_x, hub_y),
                                  {all(row.x), all(row.y)}, plane_of(now), plane_of(a));
      const Space next = {u.x, u.y, fma(all(w.dt), a.z - all(w.hub_z), now.z)};
      store_space(s.next + at, s.stride, first_of(own_lanes(s, column), next, zero));
    }
  }
}

}  // namespace
