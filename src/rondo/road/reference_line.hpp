// SPDX-License-Identifier: BSD-3-Clause
/// @file  The height of the reference line from its slope, as OpenCRG integrates it.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rondo::road {

struct ReferenceLine {
  std::vector<double> height;  ///< (n_u) [m]
  double end_gap = 0.0;  ///< given height at the end less the integrated one; 0: none given [m]
};

/// z_i = z_(i-1) + s_i h, where s_i is the slope of the stretch that ends at row i. With a given
/// height at the end, the heights are the means of the integrals from both ends, weighted by the
/// place along the line.
/// @param slope (n) of which the first is not used, or (1) one for all [-]  @param h step [m]
/// @pre n >= 2
[[nodiscard]] ReferenceLine integrate_slope(std::span<const double> slope, std::size_t n, double h,
                                            double start, std::optional<double> end);

}  // namespace rondo::road
