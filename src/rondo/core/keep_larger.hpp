// SPDX-License-Identifier: BSD-3-Clause
/// @file  The larger of two numbers that, unlike std::max, never loses a NaN.
#pragma once
#include <cmath>

namespace rondo {

/// The larger number; NaN if one of them is NaN.
inline double keep_larger(double a, double b) noexcept {
  return a >= b || std::isnan(a) ? a : b;
}
}  // namespace rondo
