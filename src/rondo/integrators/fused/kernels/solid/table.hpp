// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of one instruction set for a wheel in three dimensions. Included after a
/// pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/solid/strip.hpp"

namespace {

int solid_low_columns(const rondo::dynamics::kernels::SolidHeight& h, int* columns) noexcept {
  int found = 0;
  const Pack rx = all(h.normal_y * h.rotation_x), ry = all(h.normal_y * h.rotation_y);
  const Pack x = all(h.x), y = all(h.y), z = all(h.z);
  const Pack limit = all(h.limit), normal_z = all(h.normal_z);
  for (int column = h.first; column < h.last; column += lanes) {
    const Pack c = load(h.turn_x + column), s = load(h.turn_y + column);
    const Space u = load_space(h.u + column, h.stride);
    const Pack up_x = fma(rx, s, ry * c), up_y = fnma(ry, s, rx * c);
    const Pack height = fma(up_x, x + u.r, fma(up_y, y + u.t, normal_z * (z + u.z)));
    for (unsigned bits = not_above(height, limit); bits != 0; bits &= bits - 1) {
      const int at = column + __builtin_ctz(bits);
      if (at < h.last) columns[found++] = at;
    }
  }
  return found;
}

constexpr rondo::dynamics::kernels::SolidTable solid_table(
    const rondo::dynamics::kernels::SolidWheelTable& wheel,
    void (*faces)(const rondo::dynamics::kernels::SolidFaces&) noexcept,
    void (*rubber)(const rondo::dynamics::kernels::SolidRubber&) noexcept,
    void (*rubber_state)(rondo::dynamics::kernels::SolidRubberElement&) noexcept) noexcept {
  return {{{{solid_strip<false, false, false>, solid_strip<false, false, true>},
            {solid_strip<false, true, false>, solid_strip<false, true, true>}},
           {{solid_strip<true, false, false>, solid_strip<true, false, true>},
            {solid_strip<true, true, false>, solid_strip<true, true, true>}}},
          solid_low_columns,
          &wheel,
          faces,
          rubber,
          rubber_state};
}

}  // namespace
