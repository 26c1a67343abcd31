// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/road_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace rondo::road {
namespace {

/// Grids with more cells are compared at fewer places of each.
constexpr std::size_t many_cells = 500'000;
/// Fractions of a cell where both surfaces are compared.
constexpr std::array<double, 4> quarters{0.0, 0.25, 0.5, 0.75};
constexpr std::array<double, 2> telling{0.25, 0.5};  // differences, and slopes, are largest there

void keep_larger_at(RoadPlace& largest, double value, double u, double v) noexcept {
  if (value > largest.value) largest = {value, u, v};
}

/// Samples of one cell: its first corner, and points of its sides and of its inside.
void sample_cell(const Surface& surface, std::size_t i, std::size_t j,
                 std::span<const double> fractions, RoadReport& report, double& sum) noexcept {
  const Axis &u_axis = surface.u_axis(), &v_axis = surface.v_axis();
  const double u0 = u_axis.position(i), hu = u_axis.position(i + 1) - u0;
  const double v0 = v_axis.position(j), hv = v_axis.position(j + 1) - v0;
  for (const double s : fractions)
    for (const double t : fractions) {
      const double u = u0 + s * hu, v = v0 + t * hv;
      const SurfacePoint smooth = surface.at(u, v);
      const double difference = std::abs(smooth.height - surface.bilinear(u, v));
      if (std::isnan(difference)) continue;
      keep_larger_at(report.largest_difference, difference, u, v);
      keep_larger_at(report.steepest, std::hypot(smooth.slope_u, smooth.slope_v), u, v);
      sum += difference * difference;
      ++report.samples;
    }
}

void compare_surfaces(const Surface& surface, RoadReport& report) noexcept {
  const RoadCells cells = cells_in(surface, report.part);
  const std::size_t n = (cells.u_end - cells.u_begin) * (cells.v_end - cells.v_begin);
  const auto fractions = n > many_cells ? std::span<const double>(telling) : quarters;
  double sum = 0.0;
  for (std::size_t i = cells.u_begin; i < cells.u_end; ++i)
    for (std::size_t j = cells.v_begin; j < cells.v_end; ++j)
      sample_cell(surface, i, j, fractions, report, sum);
  if (report.samples > 0)
    report.rms_difference = std::sqrt(sum / static_cast<double>(report.samples));
}

void find_heights(const Surface& surface, RoadReport& report) noexcept {
  const std::size_t n_u = surface.u_axis().size(), n_v = surface.v_axis().size();
  bool any = false;
  for (std::size_t i = 0; i < n_u; ++i)
    for (std::size_t j = 0; j < n_v; ++j) {
      const double z = surface.height_at(i, j);
      if (std::isnan(z)) continue;
      report.lowest = any ? std::min(report.lowest, z) : z;
      report.highest = any ? std::max(report.highest, z) : z;
      any = true;
    }
  const auto gap = [&](double& largest, double a, double b) {
    if (std::abs(a - b) > largest) largest = std::abs(a - b);
  };
  for (std::size_t j = 0; j < n_v; ++j)
    gap(report.seam_u, surface.height_at(0, j), surface.height_at(n_u - 1, j));
  for (std::size_t i = 0; i < n_u; ++i)
    gap(report.seam_v, surface.height_at(i, 0), surface.height_at(i, n_v - 1));
}

std::string metres(double x) {
  return fmt::format("{:.6g}", x == 0.0 ? 0.0 : x);
}

std::string across(const Road& road) {
  const std::string from_to =
      fmt::format("v from {} to {} m", metres(road.v.front()), metres(road.v.back()));
  double narrow = road.v[1] - road.v[0], wide = narrow;
  for (std::size_t j = 1; j + 1 < road.n_v(); ++j) {
    narrow = std::min(narrow, road.v[j + 1] - road.v[j]);
    wide = std::max(wide, road.v[j + 1] - road.v[j]);
  }
  if (wide - narrow <= 1e-6 * wide)
    return fmt::format("{} in steps of {} m", from_to, metres(wide));
  return fmt::format("{} in steps of {} to {} m", from_to, metres(narrow), metres(wide));
}

std::string place_text(const RoadPlace& place) {
  return fmt::format("at u = {} m, v = {} m", metres(place.u), metres(place.v));
}

std::string missing_text(const Road& road, double share) {
  if (share == 0.0) return "No height is missing.";
  const char* const rule =
      road.missing == Missing::last   ? "the last valid height of the row stands for them"
      : road.missing == Missing::zero ? "the height 0 of the grid stands for them"
                                      : "they are outside of the road";
  return fmt::format("{:.2g} % of the heights are missing; {}{}.", 100.0 * share, rule,
                     road.missing_offset != 0.0 && road.missing != Missing::keep
                         ? fmt::format(", plus {} m", metres(road.missing_offset))
                         : "");
}

std::string span_text(double from, double to) {
  if (from == to) return fmt::format("= {:.6g} m", from);
  if (!std::isfinite(from)) return fmt::format("up to {:.6g} m", to);
  if (!std::isfinite(to)) return fmt::format("from {:.6g} m on", from);
  return fmt::format("from {:.6g} to {:.6g} m", from, to);
}

/// Empty for the whole road.
std::string part_text(const RoadPart& part) {
  std::string text;
  const auto add = [&](const char* name, double from, double to) {
    if (std::isfinite(from) || std::isfinite(to))
      text += fmt::format("{} {} {}", text.empty() ? ", for" : " and", name, span_text(from, to));
  };
  add("u", part.u_from, part.u_to);
  add("v", part.v_from, part.v_to);
  return text.empty() ? text : text + ",";
}

}  // namespace

RoadReport report_of(const Road& road, const Surface& surface, const RoadPart& part) {
  RoadReport report;
  report.part = part;
  const auto missing = static_cast<double>(
      std::ranges::count_if(road.heights, [](double z) { return std::isnan(z); }));
  report.missing_share = missing / static_cast<double>(road.heights.size());
  find_heights(surface, report);
  compare_surfaces(surface, report);
  return report;
}

std::vector<std::string> lines_of(const Road& road, const RoadReport& report, const Edges& edges) {
  std::vector<std::string> lines{
      fmt::format(
          "The road {} ({}) has {} rows of {} heights: u from {} to {} m in steps of {} m, {}.",
          road.file, road.format, road.n_u(), road.n_v(), metres(road.u_first),
          metres(road.u_last()), metres(road.u_step), across(road)),
      fmt::format("Its heights are {} to {} m, with slope and banking. {}", metres(report.lowest),
                  metres(report.highest), missing_text(road, report.missing_share)),
      fmt::format("The largest slope of its smooth surface{} is {:.3g}, {}.",
                  part_text(report.part), report.steepest.value, place_text(report.steepest)),
      fmt::format("The smooth surface differs from the bilinear one by at most {:.2g} m, {} "
                  "(root mean square {:.2g} m, {} samples).",
                  report.largest_difference.value, place_text(report.largest_difference),
                  report.rms_difference, report.samples)};
  if (edges.u == Border::repeat)
    lines.push_back(fmt::format("Where it repeats along u, the height jumps by at most {} m.",
                                metres(report.seam_u)));
  if (edges.v == Border::repeat)
    lines.push_back(fmt::format("Where it repeats along v, the height jumps by at most {} m.",
                                metres(report.seam_v)));
  lines.insert(lines.end(), road.notes.begin(), road.notes.end());
  return lines;
}

}  // namespace rondo::road
