// SPDX-License-Identifier: BSD-3-Clause
/// @file  Corners of faces and elements that are swept from a sector to the next, eight sectors at
/// a time. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/solid/strip.hpp"

namespace {

using rondo::dynamics::kernels::SolidFaceCorner;

inline Space space_of(double x, double y, double z) noexcept {
  return {all(x), all(y), all(z)};
}
inline Space add_times(Pack s, Space a, Space b) noexcept {
  return {fma(s, a.r, b.r), fma(s, a.t, b.t), fma(s, a.z, b.z)};
}
inline Space cross(Space a, Space b) noexcept {
  return {fnma(a.z, b.t, a.t * b.z), fnma(a.r, b.z, a.z * b.r), fnma(a.t, b.r, a.r * b.t)};
}

/// u of a corner in the frame of the face; a corner that is held has none.
template <class Elements>
inline Space corner_u(const Elements& s, const SolidFaceCorner& c, std::ptrdiff_t column) noexcept {
  if (c.u < 0) return space_of(0.0, 0.0, 0.0);
  const Space u = load_space(s.now + c.u + column, s.stride);
  const Pack x = all(c.turn_x), y = all(c.turn_y);
  return {fnma(y, u.t, x * u.r), fma(y, u.r, x * u.t), u.z};
}

/// Adds a force, in the frame of the face, to that on a corner.
template <class Elements>
inline void add_corner(const Elements& s, const SolidFaceCorner& c, std::ptrdiff_t column,
                       Space f) noexcept {
  if (c.u < 0) return;
  double* const to = s.force + c.force + column;
  const Pack x = all(c.turn_x), y = all(c.turn_y);
  const Space old = load_space(to, s.stride);
  store_space(to, s.stride,
              {old.r + fma(y, f.t, x * f.r), old.t + fnma(y, f.r, x * f.t), old.z + f.z});
}

}  // namespace
