// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/reference_line.hpp"

namespace rondo::road {

ReferenceLine integrate_slope(std::span<const double> slope, std::size_t n, double h, double start,
                              std::optional<double> end) {
  ReferenceLine line{std::vector<double>(n, start), 0.0};
  std::vector<double>& z = line.height;
  const bool constant = slope.size() == 1;
  const auto slope_at = [&](std::size_t i) { return slope[constant ? 0 : i]; };
  for (std::size_t i = 1; i < n; ++i)
    z[i] = constant ? start + static_cast<double>(i) * h * slope[0] : z[i - 1] + h * slope_at(i);
  if (!end) return line;
  line.end_gap = *end - z[n - 1];
  if (constant) return line;
  std::vector<double> backward(n, *end);
  for (std::size_t i = n - 1; i > 0; --i) backward[i - 1] = backward[i] - h * slope_at(i);
  for (std::size_t i = 1; i < n; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(n - 1);
    z[i] = (1.0 - share) * (z[i - 1] + h * slope_at(i)) + share * backward[i];
  }
  return line;
}

}  // namespace rondo::road
