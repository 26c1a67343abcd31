// SPDX-License-Identifier: BSD-3-Clause
/// @file  Velocity update and ledger terms of a pack of nodes (docs/theory.md, 3.2, 3.4, 5.1, 5.3),
/// for both operators. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/kernels.hpp"
#include "rondo/integrators/fused/kernels/sums.hpp"

namespace {

using rondo::dynamics::kernels::StepFactors;
static_assert(sizeof(Pack) == rondo::dynamics::kernels::lanes * sizeof(double));

/// Plane vectors, or complex numbers, of eight nodes.
struct Vectors {
  Pack x, y;
};

inline Vectors load_vectors(const double* x, std::ptrdiff_t stride) noexcept {
  return {load(x), load(x + stride)};
}
inline void store_vectors(double* x, std::ptrdiff_t stride, Vectors v) noexcept {
  store(x, v.x);
  store(x + stride, v.y);
}
/// a·b + c, lane by lane.
inline Pack add_dot(Vectors a, Vectors b, Pack c) noexcept {
  return fma(a.x, b.x, fma(a.y, b.y, c));
}

/// a × b + c, lane by lane.
inline Pack add_cross(Vectors a, Vectors b, Pack c) noexcept {
  return fma(a.x, b.y, fnma(a.y, b.x, c));
}
inline Vectors plus(Vectors a, Vectors b) noexcept {
  return {a.x + b.x, a.y + b.y};
}
inline Vectors minus(Vectors a, Vectors b) noexcept {
  return {a.x - b.x, a.y - b.y};
}
/// z a + b, a complex z.
inline Vectors add_turned(Vectors z, Vectors a, Vectors b) noexcept {
  return {fma(z.x, a.x, fnma(z.y, a.y, b.x)), fma(z.x, a.y, fma(z.y, a.x, b.y))};
}

inline Vectors first_of(int n, Vectors a, Vectors b) noexcept {
  return {first_lanes(n, a.x, b.x), first_lanes(n, a.y, b.y)};
}

/// StepFactors in every lane.
struct Factors {
  explicit Factors(const StepFactors& f) noexcept
      : dt(all(f.dt)),
        beta_over_dt(all(f.beta_over_dt)),
        rate{all(f.rate_x), all(f.rate_y)},
        inverse{all(f.inverse_x), all(f.inverse_y)},
        drag{all(f.drag_x), all(f.drag_y)} {}
  Pack dt, beta_over_dt;
  Vectors rate, inverse, drag;
};

/// The values that the update of a pack reads. `before` is K u_n, with β only; `frame` is the
/// frame's part without u: Δt[(ṡJ - s²)X + Rᵀ(c̈ - g)]; `load` is a force, of loaded nodes only.
struct Nodes {
  Vectors u, v, force, before, frame, load;
  Pack dt_over_mass;
};

/// v⁺ of (3.4) and its part of the sums.
template <bool Loaded, bool Beta, bool Unsteady>
inline Vectors update(const Factors& f, const Nodes& n, Sums& sums) noexcept {
  Vectors frame = {fma(f.rate.x, n.u.x, n.frame.x), fma(f.rate.x, n.u.y, n.frame.y)};
  if constexpr (Unsteady) frame = {fnma(f.rate.y, n.u.y, frame.x), fma(f.rate.y, n.u.x, frame.y)};
  Vectors elastic = n.force;
  const Vectors change = {n.force.x - n.before.x, n.force.y - n.before.y};
  if constexpr (Beta)
    elastic = {fma(f.beta_over_dt, change.x, elastic.x), fma(f.beta_over_dt, change.y, elastic.y)};
  if constexpr (Loaded) elastic = {elastic.x - n.load.x, elastic.y - n.load.y};
  // -[Δt f/m - drag v⁻]
  Vectors t = {fma(n.dt_over_mass, elastic.x, frame.x), fma(n.dt_over_mass, elastic.y, frame.y)};
  t = {fma(f.drag.x, n.v.x, t.x), fma(f.drag.x, n.v.y, t.y)};
  t = {fnma(f.drag.y, n.v.y, t.x), fma(f.drag.y, n.v.x, t.y)};
  Vectors after = {fnma(f.inverse.x, t.x, n.v.x), fnma(f.inverse.x, t.y, n.v.y)};
  after = {fma(f.inverse.y, t.y, after.x), fnma(f.inverse.y, t.x, after.y)};

  const Vectors twice_mean = {n.v.x + after.x, n.v.y + after.y};
  sums.kinetic = add_dot(n.v, n.v, sums.kinetic);
  sums.frame = add_dot(twice_mean, frame, sums.frame);
  sums.mass = add_dot(twice_mean, twice_mean, sums.mass);
  if constexpr (Beta) {
    sums.strain = add_dot(n.u, n.before, sums.strain);
    sums.stiffness = add_dot(twice_mean, change, sums.stiffness);
  } else {  // u_nᵀ K u_{n+1} is the same, for K is symmetric
    const Vectors u_before = {fnma(f.dt, n.v.x, n.u.x), fnma(f.dt, n.v.y, n.u.y)};
    sums.strain = add_dot(u_before, n.force, sums.strain);
  }
  if constexpr (Loaded) sums.load = add_dot(twice_mean, n.load, sums.load);
  return after;
}

}  // namespace
