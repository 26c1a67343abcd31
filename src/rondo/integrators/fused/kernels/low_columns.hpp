// SPDX-License-Identifier: BSD-3-Clause
/// @file  Which columns of a row are low enough to touch. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/update.hpp"

namespace {

using rondo::dynamics::kernels::CyclicHeight;

int low_columns(const CyclicHeight& h, int* columns) noexcept {
  int found = 0;
  const Pack rx = all(h.rotation_x), ry = all(h.rotation_y), limit = all(h.limit);
  const Pack x = all(h.x), y = all(h.y);
  for (int column = h.first; column < h.last; column += rondo::dynamics::kernels::lanes) {
    const Pack c = load(h.turn_x + column), s = load(h.turn_y + column);
    const Vectors u = load_vectors(h.u + column, h.stride);
    const Pack up_x = fma(rx, s, ry * c), up_y = fnma(ry, s, rx * c);
    const Pack height = fma(up_x, x + u.x, up_y * (y + u.y));
    for (unsigned bits = not_above(height, limit); bits != 0; bits &= bits - 1) {
      const int at = column + __builtin_ctz(bits);
      if (at < h.last) columns[found++] = at;
    }
  }
  return found;
}

}  // namespace
