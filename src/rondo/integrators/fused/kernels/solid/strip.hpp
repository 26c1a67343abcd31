// SPDX-License-Identifier: BSD-3-Clause
/// @file  Velocity update and ledger terms in three dimensions: the plane's (update.hpp) with the
/// axial component beside. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/solid/product.hpp"
#include "rondo/integrators/fused/kernels/sums.hpp"

namespace {

using rondo::dynamics::kernels::SolidFactors;
using rondo::dynamics::kernels::SolidRow;

/// Vectors of eight nodes: radial, tangential, axial.
struct Space {
  Pack r, t, z;
};

[[gnu::always_inline]] inline Space load_space(const double* x, std::ptrdiff_t stride) noexcept {
  return {load(x), load(x + stride), load(x + 2 * stride)};
}
[[gnu::always_inline]] inline void store_space(double* x, std::ptrdiff_t stride, Space a) noexcept {
  store(x, a.r);
  store(x + stride, a.t);
  store(x + 2 * stride, a.z);
}
/// a·b + c, lane by lane.
[[gnu::always_inline]] inline Pack add_dot(Space a, Space b, Pack c) noexcept {
  return fma(a.r, b.r, fma(a.t, b.t, fma(a.z, b.z, c)));
}
[[gnu::always_inline]] inline Space first_of(int n, Space a, Space b) noexcept {
  return {first_lanes(n, a.r, b.r), first_lanes(n, a.t, b.t), first_lanes(n, a.z, b.z)};
}

/// The values that the update of a pack reads. `before` is K u_n, with β only.
struct SpaceNodes {
  Space u, v, force, before;
};

/// A row in hand: what its nodes share. The acceleration of the frame without u and pull is
/// Δt(ṡJ - s²)X; the pull is that of the row's frame in sector 0.
struct SolidRowInHand {
  double dt_over_mass;
  double frame_r, frame_t;
  double pull_x, pull_y;
  const double* load;  ///< on each of its nodes
};

[[gnu::always_inline]] inline SolidRowInHand row_in_hand(const SolidStrip& s, int r) noexcept {
  const SolidRow& row = s.rows[r];
  const rondo::dynamics::kernels::StepFactors& f = s.step->plane;
  return {row.dt_over_mass,
          f.rate_x * row.x - f.rate_y * row.y,
          f.rate_x * row.y + f.rate_y * row.x,
          f.pull_x * row.turn_x + f.pull_y * row.turn_y,
          f.pull_y * row.turn_x - f.pull_x * row.turn_y,
          s.load[r]};
}

/// Δt times the acceleration of the frame.
template <bool Unsteady>
[[gnu::always_inline]] inline Space frame_of(const SolidStrip& s, const SolidRowInHand& row,
                                             std::ptrdiff_t column, const Space& u) noexcept {
  const rondo::dynamics::kernels::StepFactors& f = s.step->plane;
  Pack r = fma(all(f.rate_x), u.r, all(row.frame_r));
  Pack t = fma(all(f.rate_x), u.t, all(row.frame_t));
  if constexpr (!Unsteady) return {r, t, all(0.0)};
  r = fnma(all(f.rate_y), u.t, r);
  t = fma(all(f.rate_y), u.r, t);
  const Pack cosine = load(s.turn_x + column), sine = load(s.turn_y + column);
  const Pack px = all(row.pull_x), py = all(row.pull_y);
  r = r + fma(py, sine, px * cosine);
  t = t + fnma(px, sine, py * cosine);
  return {r, t, all(s.step->axial_pull)};
}

/// v⁺ and its part of the sums.
template <bool Loaded, bool Beta, bool Unsteady>
[[gnu::always_inline]] inline Space space_update(const SolidStrip& s, const SolidRowInHand& row,
                                                 const SpaceNodes& n, const Space& frame,
                                                 Sums& sums) noexcept {
  const rondo::dynamics::kernels::StepFactors& f = s.step->plane;
  Space elastic = n.force;
  const Space change = {n.force.r - n.before.r, n.force.t - n.before.t, n.force.z - n.before.z};
  if constexpr (Beta) {
    const Pack beta = all(f.beta_over_dt);
    elastic = {fma(beta, change.r, elastic.r), fma(beta, change.t, elastic.t),
               fma(beta, change.z, elastic.z)};
  }
  const Space pressed = {all(row.load[0]), all(row.load[1]), all(row.load[2])};
  if constexpr (Loaded)
    elastic = {elastic.r - pressed.r, elastic.t - pressed.t, elastic.z - pressed.z};
  // -[Δt f/m - drag v⁻]
  const Pack by_mass = all(row.dt_over_mass);
  Pack r = fma(by_mass, elastic.r, frame.r);
  Pack t = fma(by_mass, elastic.t, frame.t);
  Pack z = Unsteady ? fma(by_mass, elastic.z, frame.z) : by_mass * elastic.z;
  r = fma(all(f.drag_x), n.v.r, r);
  t = fma(all(f.drag_x), n.v.t, t);
  z = fma(all(s.step->axial_drag), n.v.z, z);
  r = fnma(all(f.drag_y), n.v.t, r);
  t = fma(all(f.drag_y), n.v.r, t);
  Space after = {fnma(all(f.inverse_x), r, n.v.r), fnma(all(f.inverse_x), t, n.v.t),
                 fnma(all(s.step->axial_inverse), z, n.v.z)};
  after.r = fma(all(f.inverse_y), t, after.r);
  after.t = fnma(all(f.inverse_y), r, after.t);

  const Space twice_mean = {n.v.r + after.r, n.v.t + after.t, n.v.z + after.z};
  sums.kinetic = add_dot(n.v, n.v, sums.kinetic);
  sums.frame = fma(twice_mean.r, frame.r, fma(twice_mean.t, frame.t, sums.frame));
  if constexpr (Unsteady) sums.frame = fma(twice_mean.z, frame.z, sums.frame);
  sums.mass = add_dot(twice_mean, twice_mean, sums.mass);
  if constexpr (Beta) {
    sums.strain = add_dot(n.u, n.before, sums.strain);
    sums.stiffness = add_dot(twice_mean, change, sums.stiffness);
  } else {  // u_nᵀ K u_{n+1} is the same, for K is symmetric
    const Pack dt = all(f.dt);
    const Space u_before = {fnma(dt, n.v.r, n.u.r), fnma(dt, n.v.t, n.u.t), fnma(dt, n.v.z, n.u.z)};
    sums.strain = add_dot(u_before, n.force, sums.strain);
  }
  if constexpr (Loaded) sums.load = add_dot(twice_mean, pressed, sums.load);
  return after;
}

/// Update and sums of one pack of a row. Tail: the last own pack, of which only `columns` count.
template <bool Tail, bool Loaded, bool Beta, bool Unsteady>
[[gnu::always_inline]] inline void space_pack(const SolidStrip& s, const SolidRowInHand& row,
                                              std::ptrdiff_t row_at, std::ptrdiff_t column,
                                              const double* force, Sums& sums) noexcept {
  const std::ptrdiff_t at = row_at + column;
  double* const v = s.velocity + at;
  double* const p = s.force + at;
  SpaceNodes n;
  n.u = load_space(s.now + at, s.stride);
  n.v = load_space(v, s.stride);
  n.force = load_space(force, most_packs * lanes);
  n.before = Beta ? load_space(p, s.stride) : n.force;
  const Space frame = frame_of<Unsteady>(s, row, column, n.u);
  Space after;
  if constexpr (!Tail) {
    after = space_update<Loaded, Beta, Unsteady>(s, row, n, frame, sums);
  } else {
    const int own = s.columns - static_cast<int>(column);
    Sums part = no_sums();
    after = space_update<Loaded, Beta, Unsteady>(s, row, n, frame, part);
    add_first_lanes(own, part, sums);
    if (s.keep_tail) {
      after = first_of(own, after, n.v);
      n.force = first_of(own, n.force, n.before);
    }
  }
  const Pack dt = all(s.step->plane.dt);
  store_space(v, s.stride, after);
  store_space(s.next + at, s.stride,
              {fma(dt, after.r, n.u.r), fma(dt, after.t, n.u.t), fma(dt, after.z, n.u.z)});
  if constexpr (Beta) store_space(p, s.stride, n.force);
}

/// Adds the forces of rubber, cords and air on a pack of a row to those of K. @return u·(K u - 2
/// f), f those of the state: with twice the energy of the faces it is twice the stored one
inline Pack add_swept(const SolidStrip& s, const SolidRow& row, std::ptrdiff_t column,
                      double* force) noexcept {
  const Space u = load_space(s.now + row.at + column, s.stride);
  Space f = load_space(force, most_packs * lanes);
  const Pack linear = add_dot(u, f, all(0.0));
  if (s.rubber && s.has_rubber[column / lanes]) {
    const double* const here = s.rubber + row.rubber + column;
    const Space own = load_space(here, s.stride),
                last = load_space(here + 3 * s.stride - 1, s.stride);
    f = {f.r + (own.r + last.r), f.t + (own.t + last.t), f.z + (own.z + last.z)};
    if (row.swept < 0) store_space(force, most_packs * lanes, f);
  }
  if (row.swept < 0) return linear;
  const double* const here = s.swept + row.swept + column;
  const Space own = load_space(here, s.stride),
              last = load_space(here + 3 * s.stride - 1, s.stride);
  const Space state = {all(row.of_state[0]), all(row.of_state[1]), all(row.of_state[2])};
  f = {f.r + (own.r + last.r - state.r), f.t + (own.t + last.t - state.t),
       f.z + (own.z + last.z - state.z)};
  store_space(force, most_packs * lanes, f);
  return fnma(all(2.0), add_dot(u, state, all(0.0)), linear);
}

/// Σ a·f over the first `own` columns of a pack.
inline Pack work_of(int own, const double* a, std::ptrdiff_t stride, const double* force) noexcept {
  const Pack work = add_dot(load_space(a, stride), load_space(force, most_packs * lanes), all(0.0));
  return own < lanes ? first_lanes(own, work, all(0.0)) : work;
}

/// Work takes the place of the strain energy of K.
inline void add_work_sums(double* to, Pack before, Pack after, Pack linear, Sums& own) noexcept {
  using namespace rondo::dynamics::kernels;
  own.strain = before + after;
  store(to + sum_force_before * lanes, load(to + sum_force_before * lanes) + before);
  store(to + sum_linear * lanes, load(to + sum_linear * lanes) + linear);
}

/// All rows of the strip on the own packs [first, last), at most a group, and on those of the halo
/// that are beside them: `left` and `right`, 0 or 1.
template <bool Loaded, bool Beta, bool Unsteady>
inline void solid_group(const SolidStrip& s, int first, int last, int left, int right,
                        double* sums) noexcept {
  SolidForces force;
  strip_product(s, first - left, last - first + left + right, force);
  const auto place = [&](int pack) { return static_cast<std::ptrdiff_t>(pack) * lanes; };
  for (int r = 0; r < s.n_rows; ++r) {
    const SolidRowInHand row = row_in_hand(s, r);
    const std::ptrdiff_t at = s.rows[r].at;
    const auto f = [&](int pack) { return force.f[r][0] + place(pack - first + left); };
    Sums own = no_sums(), others = no_sums();
    Pack before = all(0.0), after = all(0.0), linear = all(0.0);
    for (int pack = first; s.swept && pack < last; ++pack) {
      double* const p = force.f[r][0] + place(pack - first + left);
      const int here = s.columns - pack * lanes;
      const Pack more = add_swept(s, s.rows[r], place(pack), p);
      linear = linear + (here < lanes ? first_lanes(here, more, all(0.0)) : more);
      before = before + work_of(here, s.velocity + at + place(pack), s.stride, p);
    }
    for (int pack = first; pack < last; ++pack)
      if ((pack + 1) * lanes > s.columns)
        space_pack<true, Loaded, Beta, Unsteady>(s, row, at, place(pack), f(pack), own);
      else
        space_pack<false, Loaded, Beta, Unsteady>(s, row, at, place(pack), f(pack), own);
    for (int pack = first; s.swept && pack < last; ++pack)
      after = after +
              work_of(s.columns - pack * lanes, s.velocity + at + place(pack), s.stride, f(pack));
    if (s.swept) add_work_sums(sums, before, after, linear, own);
    add_row_sums<Loaded>(sums, s.rows[r].mass, own);
    for (int pack = first - left; pack < last + right; pack += last - first + left)
      if (pack < first || pack >= last)
        space_pack<false, Loaded, Beta, Unsteady>(s, row, at, place(pack), f(pack), others);
  }
}

template <bool Loaded, bool Beta, bool Unsteady>
void solid_strip(const SolidStrip& s) noexcept {
  const int own = (s.columns + lanes - 1) / lanes;
  double* sums = s.sums;
  for (int pack = 0; pack < own; pack += solid_packs, sums += s.n_sums * lanes) {
    const bool last = pack + solid_packs >= own;
    solid_group<Loaded, Beta, Unsteady>(s, pack, last ? own : pack + solid_packs,
                                        pack == 0 ? -s.first_pack : 0, last ? s.last_pack - own : 0,
                                        sums);
  }
}

}  // namespace
