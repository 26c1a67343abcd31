// SPDX-License-Identifier: BSD-3-Clause
/// @file  The quadrilateral of rubber, total Lagrangian (docs/rubber.md, 1.3): an isochoric energy
/// at 2×2 points and a volumetric energy of the element's mean dilatation (Q1P0; Simo, Taylor and
/// Pister 1985), or one point and a covariant hourglass stiffness. Everything is a function of ∇u
/// because differences of x = X + u have lost digits. T as in numbers.hpp.
#pragma once
#include <array>

#include "rondo/fem/hyperelastic/branch.hpp"

namespace rondo::fem::hyperelastic {

/// A bilinear field without its mean: center + along ξ + across η + twist ξη.
template <class T>
struct Bilinear {
  Pair<T> along, across, twist;
};

template <class T>
using Corners = std::array<Pair<T>, 4>;  ///< counter-clockwise from (ξ, η) = (-1, -1)

template <class T>
Bilinear<T> bilinear(const Corners<T>& v) noexcept {
  const Pair<T> low = v[1] - v[0], high = v[2] - v[3];
  const Pair<T> sum = v[2] + v[3] - v[0] - v[1];
  const T quarter = as<T>(0.25);
  return {quarter * (low + high), quarter * sum, quarter * (high - low)};
}

/// Derivatives of an energy with respect to the bilinear field, as forces at the corners.
template <class T>
Corners<T> at_corners(const Bilinear<T>& by) noexcept {
  const T quarter = as<T>(0.25);
  const Pair<T> sum = quarter * (by.along + by.across),
                difference = quarter * (by.along - by.across);
  const Pair<T> twist = quarter * by.twist;
  return {twist - sum, difference - twist, twist + sum, as<T>(-1.0) * (difference + twist)};
}

inline constexpr double gauss = 0.57735026918962576451;  ///< 1/√3
/// The points of 2×2 quadrature, (ξ, η).
inline constexpr double points[4][2] = {
    {-gauss, -gauss}, {gauss, -gauss}, {gauss, gauss}, {-gauss, gauss}};

/// ∂/∂ξ and ∂/∂η of a bilinear field.
template <class T>
Gradient<T> local_gradient(const Bilinear<T>& f, double xi, double eta) noexcept {
  return {fma(as<T>(eta), f.twist, f.along), fma(as<T>(xi), f.twist, f.across)};
}

/// The deformation at a point.
template <class T>
struct PointState {
  Gradient<T> f;  ///< F by columns
  T j_less_1;     ///< det F - 1
  T s;            ///< F:F
};

/// @param g ∂X/∂(ξ, η); h ∂u/∂(ξ, η); r 1/det g [1/m²]
template <class T>
PointState<T> point_state(const Gradient<T>& g, const Gradient<T>& h, T r) noexcept {
  // ∇u = h g⁻¹ by columns
  const Pair<T> x = r * Pair<T>{h.x.x * g.y.y - h.y.x * g.x.y, h.x.y * g.y.y - h.y.y * g.x.y};
  const Pair<T> y = r * Pair<T>{h.y.x * g.x.x - h.x.x * g.y.x, h.y.y * g.x.x - h.x.y * g.y.x};
  PointState<T> p;
  p.j_less_1 = x.x + y.y + cross(x, y);
  const T one = as<T>(1.0);
  p.f = {{one + x.x, x.y}, {y.x, one + y.y}};
  p.s = dot(p.f.x, p.f.x) + dot(p.f.y, p.f.y);
  return p;
}

/// det g · P · g⁻ᵀ: derivatives with respect to ∂u/∂ξ and ∂u/∂η, added to those of the field.
template <class T>
void add_stress(const Gradient<T>& p, const Gradient<T>& g, double xi, double eta,
                Bilinear<T>& by) noexcept {
  const Pair<T> by_xi = g.y.y * p.x - g.y.x * p.y, by_eta = g.x.x * p.y - g.x.y * p.x;
  by.along = by.along + by_xi;
  by.across = by.across + by_eta;
  by.twist = by.twist + fma(as<T>(eta), by_xi, as<T>(xi) * by_eta);
}

/// a F + b cof F.
template <class T>
Gradient<T> stress_of(const PlaneStress<T>& law, const Gradient<T>& f) noexcept {
  return {{fma(law.a, f.x.x, law.b * f.y.y), law.a * f.x.y - law.b * f.y.x},
          {law.a * f.y.x - law.b * f.x.y, fma(law.a, f.y.y, law.b * f.x.x)}};
}

/// Result of an element: derivatives of its energy, and its smallest det F.
template <class T>
struct ElementResult {
  Bilinear<T> by;  ///< per unit thickness                                          [N/m]
  T energy;        ///< without branches                                            [J/m]
  T least;         ///< smallest det F over its points
};

template <class T>
T smaller(T a, T b) noexcept {
  return b < a ? b : a;
}

/// An inverted element ends a run. Where the calculation must continue for a while, as in
/// registers, det F is kept above this value.
inline constexpr double least_volume = 1e-3;
template <class T>
T bounded(T j_less_1) noexcept {
  return j_less_1;
}

/// The Q1P0 element without branches. @param x, u X and u of the element
template <class T, class Law>
ElementResult<T> mean_dilatation(const Bilinear<T>& x, const Bilinear<T>& u, const Law& law,
                                 T bulk) noexcept {
  std::array<PointState<T>, 4> state;
  std::array<Gradient<T>, 4> g;
  std::array<T, 4> weight;
  T area = as<T>(0.0), change = as<T>(0.0);
  for (std::size_t q = 0; q < 4; ++q) {
    const double xi = points[q][0], eta = points[q][1];
    g[q] = local_gradient(x, xi, eta);
    weight[q] = cross(g[q].x, g[q].y);
    state[q] = point_state(g[q], local_gradient(u, xi, eta), as<T>(1.0) / weight[q]);
    area = area + weight[q];
    change = fma(weight[q], state[q].j_less_1, change);
  }
  const Volumetric<T> mean = volumetric(bulk, bounded(change / area));
  const T zero = as<T>(0.0);
  ElementResult<T> result{
      {{zero, zero}, {zero, zero}, {zero, zero}}, mean.energy * area, state[0].j_less_1};
  for (std::size_t q = 0; q < 4; ++q) {
    const double xi = points[q][0], eta = points[q][1];
    PlaneStress<T> p = law(state[q].s, as<T>(1.0) + bounded(state[q].j_less_1));
    p.b = p.b + mean.pressure;
    result.energy = fma(p.w, weight[q], result.energy);
    add_stress(stress_of(p, state[q].f), g[q], xi, eta, result.by);
    if (q > 0) result.least = smaller(result.least, state[q].j_less_1);
  }
  result.least = as<T>(1.0) + result.least;
  return result;
}

}  // namespace rondo::fem::hyperelastic
