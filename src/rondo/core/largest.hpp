// SPDX-License-Identifier: BSD-3-Clause
/// @file  Largest values that do not lose a number that is none, as std::max does.
#pragma once
#include <cmath>

namespace rondo {

/// The larger one; NaN if one of them is NaN.
inline double largest(double a, double b) noexcept {
  return a >= b || std::isnan(a) ? a : b;
}

}  // namespace rondo
