// SPDX-License-Identifier: BSD-3-Clause
/// @file  Slopes of a line through points that never rises above the higher of two neighbours nor
/// falls below the lower one. After Fritsch and Carlson 1980, doi:10.1137/0717021; the bound is
/// half of theirs, so that a bicubic patch without mixed derivatives stays between its four corners
/// (docs/roads.md).
#pragma once

namespace rondo::road {

/// A slope is at most this often as large as the smaller secant beside it.
inline constexpr double largest_slope_ratio = 1.5;

/// The slope at a point between two stretches: that of the parabola through three points, bounded;
/// 0 where the secants have different signs.
/// @param before, after  secants [-] of stretches with the lengths h_before, h_after > 0 [m]
[[nodiscard]] double limited_slope(double before, double h_before, double after,
                                   double h_after) noexcept;

/// The slope at the end of a line, whose last stretch has the secant `last`, the one beside it
/// `next`.
[[nodiscard]] double limited_end_slope(double last, double h_last, double next,
                                       double h_next) noexcept;

/// The nearest number of single precision that is not larger in magnitude.
[[nodiscard]] float toward_zero(double x) noexcept;

}  // namespace rondo::road
