// SPDX-License-Identifier: BSD-3-Clause
/// @file  The larger and the smaller of two numbers, without losing one that is none, as std::max
/// and std::min do.
#pragma once
#include <cmath>

namespace rondo {

/// NaN if one of them is NaN.
inline double keep_larger(double a, double b) noexcept {
  return a >= b || std::isnan(a) ? a : b;
}
inline double keep_smaller(double a, double b) noexcept {
  return a <= b || std::isnan(a) ? a : b;
}

}  // namespace rondo
