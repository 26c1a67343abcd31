// SPDX-License-Identifier: BSD-3-Clause
/// @file  The triangle of rubber (docs/rubber.md, 1.3): its isochoric energy is evaluated at one
/// point; the volumetric energy belongs to the nodes, whose volume is a third of the triangles
/// around each. T as in numbers.hpp.
#pragma once
#include <array>

#include "rondo/fem/hyperelastic/quadrilateral.hpp"

namespace rondo::fem::hyperelastic {

template <class T>
using ThreeCorners = std::array<Pair<T>, 3>;  ///< counter-clockwise

/// ∂/∂ξ and ∂/∂η of a linear field; ξ and η go from corner 0 to corners 1 and 2.
template <class T>
Gradient<T> edges_of(const ThreeCorners<T>& v) noexcept {
  return {v[1] - v[0], v[2] - v[0]};
}

/// Corner forces of a stress P per unit thickness [N/m]. @param g edges in the reference X
template <class T>
ThreeCorners<T> triangle_forces(const Gradient<T>& p, const Gradient<T>& g) noexcept {
  const T half = as<T>(0.5);
  const Pair<T> first = half * (g.y.y * p.x - g.y.x * p.y);
  const Pair<T> second = half * (g.x.x * p.y - g.x.y * p.x);
  return {as<T>(-1.0) * (first + second), first, second};
}

template <class T>
struct TriangleResult {
  ThreeCorners<T> by;  ///< derivatives of the energy, per unit thickness              [N/m]
  T energy;            ///< without branches and volumetric part                [J/m]
};

/// Includes the mean pressure of its nodes [Pa]. @param x, u X and u of the corners
template <class T, class Law>
TriangleResult<T> triangle(const ThreeCorners<T>& x, const ThreeCorners<T>& u, const Law& law,
                           T mean) noexcept {
  const Gradient<T> g = edges_of(x);
  const T det = cross(g.x, g.y);
  const PointState<T> state = point_state(g, edges_of(u), as<T>(1.0) / det);
  PlaneStress<T> p = law(state.s, as<T>(1.0) + state.j_less_1);
  p.b = p.b + mean;
  return {triangle_forces(stress_of(p, state.f), g), as<T>(0.5) * det * p.w};
}

}  // namespace rondo::fem::hyperelastic
