// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/limited_slope.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::road {

double limited_slope(double before, double h_before, double after, double h_after) noexcept {
  if (std::isnan(before)) return after;  // missing: the line ends here
  if (std::isnan(after)) return before;
  if (!(before * after > 0.0)) return 0.0;
  const double parabola = (before * h_after + after * h_before) / (h_before + h_after);
  const double bound = largest_slope_ratio * std::min(std::abs(before), std::abs(after));
  return std::clamp(parabola, -bound, bound);
}

double limited_end_slope(double last, double h_last, double next, double h_next) noexcept {
  if (std::isnan(next)) return last;
  const double parabola = last + (last - next) * h_last / (h_last + h_next);
  if (!(parabola * last > 0.0)) return 0.0;
  const double bound = largest_slope_ratio * std::abs(last);
  return std::clamp(parabola, -bound, bound);
}

float toward_zero(double x) noexcept {
  const auto near = static_cast<float>(x);
  return std::abs(static_cast<double>(near)) > std::abs(x) ? std::nextafterf(near, 0.0F) : near;
}

}  // namespace rondo::road
