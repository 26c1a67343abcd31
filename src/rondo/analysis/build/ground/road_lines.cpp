// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/ground/road_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/case/road_ground.hpp"
#include "rondo/road/road_report.hpp"
#include "rondo/road/road_section.hpp"

namespace rondo::study {
namespace {

/// Places along the ground [m].
struct Stretch {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();
};

/// Where the body touches the ground at most, if its center follows the tables of [motion]: the
/// speed of a rim that forces move counts with its value at t = 0. Everywhere for free bodies.
Stretch reach_of(const Case& c, const Setup& s) {
  constexpr int parts = 500;
  Stretch reach;
  if (!is_held(c)) return {reach.to, reach.from};
  const double radius = extent_of(s.mesh);
  for (int k = 0; k <= parts; ++k) {
    const double x = c.motion.center(c.time.end * k / parts).x;
    reach.from = std::min(reach.from, x - radius);
    reach.to = std::max(reach.to, x + radius);
  }
  return reach;
}

std::string level_text(const RoadCase& road) {
  const road::Edges edges = edges_of(road);
  const char* const at =
      edges.u == road::Border::zero ? "at the height 0 of the file" : "at the heights of its ends";
  if (edges.offset_u == 0.0) return fmt::format("the ground is level {}", at);
  return fmt::format("the ground is level {}, plus {:.6g} m", at, edges.offset_u);
}

/// Empty if the body stays on the road, or if it is not known where it goes.
std::string leaving(const RoadCase& road, Stretch reach, Stretch on_road) {
  constexpr double slack = 1e-9;  // round-off of a wheel that begins at the end of the road [m]
  const bool known = std::isfinite(reach.from);
  if (!known || (reach.from >= on_road.from - slack && reach.to <= on_road.to + slack)) return {};
  return fmt::format(
      "ground.road: the body comes to x = {:.4g} to {:.4g} m, and the road goes from {:.4g} to "
      "{:.4g} m: before and behind it, {}; give another ground.road_start, motion.start_x or "
      "time.end, or a longer road",
      reach.from, reach.to, on_road.from, on_road.to, level_text(road));
}

std::string bend_within_element(const road::RoadPlace& bend, double start, double spacing) {
  if (!(bend.value > told_slope_change)) return {};
  return fmt::format(
      "ground.road: the slope changes by {:.3g} near x = {:.4g} m within the {:.3g} m between two "
      "contact nodes: what is shorter passes between them; give a finer mesh, or a smoother road",
      bend.value, bend.u - start, spacing);
}

}  // namespace

void tell_road(const Case& c, Setup& s) {
  if (!c.ground || !c.ground->road.read || !s.model.contact) return;
  const RoadCase& road = c.ground->road;
  const road::Surface surface(*road.read, edges_of(road));
  const double start = *road.start, spacing = s.model.contact->ground.spacing();
  const Stretch reach = reach_of(c, s),
                on_road{surface.u_axis().first() - start, surface.u_axis().last() - start};
  const road::RoadPart part{reach.from + start, reach.to + start, road.offset, road.offset};
  const auto tell = [&](std::string text) { s.figures.emplace_back("road", std::move(text)); };
  tell(
      fmt::format("x is u - {:.6g} m, at v = {:.6g} m; y is the height less that at x = 0, {:.6g} "
                  "m in the file",
                  start, road.offset, road.height));
  tell(fmt::format("The road goes from x = {:.6g} to {:.6g} m; before and behind it, {}.",
                   on_road.from, on_road.to, level_text(road)));
  for (std::string& line :
       road::lines_of(*road.read, road::report_of(*road.read, surface, part), edges_of(road)))
    tell(std::move(line));
  std::string warnings[2] = {leaving(road, reach, on_road)};
  if (spacing > 0.0)
    warnings[1] = bend_within_element(
        road::largest_bend(road::section_of(surface, road.offset), spacing, part), start, spacing);
  for (std::string& warning : warnings)
    if (!warning.empty()) s.warnings.push_back(std::move(warning));
}

}  // namespace rondo::study
