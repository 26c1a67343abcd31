// SPDX-License-Identifier: BSD-3-Clause
/// @file  The quadrilateral of rubber with one point and an additional stiffness against the motion
/// that the point does not see (docs/rubber.md, 1.3): ½ V/3 4μ [(A·q)²/|A_X|⁴ + (B·q)²/|B_X|⁴] with
/// x = c + A ξ + B η + H ξη and q = H - F H_X. In the axes A, B of the element a rigid rotation
/// causes no strain. T as in numbers.hpp.
#pragma once
#include "rondo/fem/hyperelastic/quadrilateral.hpp"

namespace rondo::fem::hyperelastic {

/// The part of the twist that the deformation at the center does not explain.
template <class T>
struct Hourglass {
  T along, across;        ///< of H_X = along A_X + across B_X
  Pair<T> excess;         ///< q                                                          [m]
  Pair<T> a, b;           ///< A, B                                                       [m]
  T by_along, by_across;  ///< A·q/|A_X|⁴, B·q/|B_X|⁴                                   [1/m²]
};

/// @param r 1/det of A_X, B_X [1/m²]
template <class T>
Hourglass<T> hourglass(const Bilinear<T>& x, const Bilinear<T>& u, T r) noexcept {
  Hourglass<T> h;
  h.along = r * cross(x.twist, x.across);
  h.across = r * cross(x.along, x.twist);
  h.excess = u.twist - h.along * u.along - h.across * u.across;
  h.a = x.along + u.along;
  h.b = x.across + u.across;
  const T aa = dot(x.along, x.along), bb = dot(x.across, x.across);
  h.by_along = dot(h.a, h.excess) / (aa * aa);
  h.by_across = dot(h.b, h.excess) / (bb * bb);
  return h;
}

/// 4/3 μ V: the energy is ½ of it times (A·q)²/|A_X|⁴ + (B·q)²/|B_X|⁴                 [N]
template <class T>
T hourglass_stiffness(T shear, T area) noexcept {
  return as<T>(4.0 / 3.0) * shear * area;
}

/// One point without branches. @param x, u X and u of the element; shear μ at small strain [Pa]
template <class T, class Law>
ElementResult<T> one_point(const Bilinear<T>& x, const Bilinear<T>& u, const Law& law, T bulk,
                           T shear) noexcept {
  const Gradient<T> g{x.along, x.across};
  const T det = cross(g.x, g.y), r = as<T>(1.0) / det, four = as<T>(4.0), zero = as<T>(0.0);
  const PointState<T> state = point_state(g, {u.along, u.across}, r);
  const T j_less_1 = bounded(state.j_less_1), area = four * det;
  const Volumetric<T> mean = volumetric(bulk, j_less_1);
  PlaneStress<T> p = law(state.s, as<T>(1.0) + j_less_1);
  p.b = p.b + mean.pressure;
  ElementResult<T> result{
      {{zero, zero}, {zero, zero}, {zero, zero}}, area * (p.w + mean.energy), state.j_less_1};
  add_stress(stress_of(p, state.f), g, 0.0, 0.0, result.by);
  const Hourglass<T> h = hourglass(x, u, r);
  const T stiffness = hourglass_stiffness(shear, area);
  const T along = stiffness * h.by_along, across = stiffness * h.by_across;
  const T strain = fma(along, dot(h.a, h.excess), across * dot(h.b, h.excess));
  result.energy = fma(as<T>(0.5), strain, result.energy);
  const Pair<T> twist = fma(along, h.a, across * h.b);
  result.by.along = fma(four, result.by.along, along * h.excess - h.along * twist);
  result.by.across = fma(four, result.by.across, across * h.excess - h.across * twist);
  result.by.twist = twist;
  result.least = as<T>(1.0) + result.least;
  return result;
}

}  // namespace rondo::fem::hyperelastic
