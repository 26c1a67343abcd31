// SPDX-License-Identifier: BSD-3-Clause
/// @file  The larger of two numbers, without losing one that is none, as std::max does.
#pragma once
#include <cmath>

namespace rondo {

/// NaN if one of them is NaN.
inline double keep_larger(double a, double b) noexcept {
  return a >= b || std::isnan(a) ? a : b;
}
}  // namespace rondo
