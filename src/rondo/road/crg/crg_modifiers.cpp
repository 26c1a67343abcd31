// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/crg/crg_modifiers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/road/surface.hpp"

namespace rondo::road {
namespace {

void scale(std::vector<double>& values, double factor) {
  if (factor != 1.0)
    for (double& x : values) x *= factor;
}

/// A coordinate of the reference point: absolute, or a fraction of the extent, and an offset.
double point_of(const CrgValues& modifiers, const std::string& key, double first, double last,
                double otherwise) {
  double x = otherwise;
  if (const auto fraction = modifiers.real(key + "_FRACTION"))
    x = first + *fraction * (last - first);
  if (const auto absolute = modifiers.real(key)) x = *absolute;
  return x + modifiers.real_or(key + "_OFFSET", 0.0);
}

double reference_shift(const CrgValues& modifiers, const Road& road) {
  const bool has_point = std::ranges::any_of(
      modifiers.values, [](const CrgValue& value) { return value.key.starts_with("REFPOINT_"); });
  if (!has_point) return modifiers.real_or("REFLINE_OFFSET_Z", 0.0);
  const double u = point_of(modifiers, "REFPOINT_U", road.u_first, road.u_last(), road.u_first);
  const double v = point_of(modifiers, "REFPOINT_V", road.v.front(), road.v.back(), 0.0);
  return modifiers.real_or("REFPOINT_Z", 0.0) - Surface(road, Edges{}).bilinear(u, v);
}

}  // namespace

CrgScales crg_scales(const CrgValues& modifiers) {
  return {modifiers.real_or("SCALE_Z_GRID", 1.0), modifiers.real_or("SCALE_SLOPE", 1.0),
          modifiers.real_or("SCALE_BANKING", 1.0), modifiers.real_or("SCALE_LENGTH", 1.0),
          modifiers.real_or("SCALE_WIDTH", 1.0)};
}

void scale_road(const CrgScales& scales, Road& road) {
  scale(road.heights, scales.height);
  scale(road.banking, scales.banking);
  scale(road.v, scales.width);
  road.u_step *= scales.length;
}

void set_missing(const CrgValues& modifiers, bool has_block, Road& road) {
  road.missing = has_block ? Missing::keep : Missing::last;
  if (const auto mode = modifiers.choice("GRID_NAN_MODE", 2))
    road.missing = static_cast<Missing>(*mode);
  road.missing_offset =
      road.missing == Missing::keep ? 0.0 : modifiers.real_or("GRID_NAN_OFFSET", 0.0);
}

void shift_road(const CrgValues& modifiers, Road& road) {
  const double shift = reference_shift(modifiers, road);
  if (shift == 0.0) return;
  for (double& z : road.line_height) z += shift;
  road.notes.push_back(
      fmt::format("The modifiers of the file shift the road by {:.6g} m in height.", shift));
}

}  // namespace rondo::road
