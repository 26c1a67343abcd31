// SPDX-License-Identifier: BSD-3-Clause
/// @file  Cube roots of eight doubles. Included after a pack_*.hpp.
#pragma once

namespace {

/// y ≈ a^(-1/3) to round-off, from a guess within 4 %: with r = 1 - a y³ the error is O(r⁴).
[[gnu::always_inline]] inline Pack inverse_cube_root(Pack a) noexcept {
  Pack y = cube_root_guess(a);
  for (int i = 0; i < 2; ++i) {
    const Pack r = fnma(a * y, y * y, all(1.0));
    const Pack series = fma(fma(r, all(14.0 / 81.0), all(2.0 / 9.0)), r, all(1.0 / 3.0));
    y = fma(y * r, series, y);
  }
  return y;
}

}  // namespace
