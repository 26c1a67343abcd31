// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/ground/road_lines.hpp"

#include <fmt/format.h>

#include "rondo/analysis/build/ground/road_reach.hpp"
#include "rondo/case/ground/road_ground.hpp"
#include "rondo/road/road_report.hpp"
#include "rondo/road/road_section.hpp"

namespace rondo::study {
namespace {

std::string bend_within_element(const road::RoadPlace& bend, double start, double spacing) {
  if (!(bend.value > told_slope_change)) return {};
  return fmt::format(
      "ground.road: the slope changes by {:.3g} near x = {:.4g} m within the {:.3g} m between two "
      "contact nodes: what is shorter passes between them; give a finer mesh, or a smoother road",
      bend.value, bend.u - start, spacing);
}

}  // namespace

void tell_road(const Case& c, Setup& s) {
  if (!c.ground || !c.ground->road.read || !s.model.contact || s.model.solid) return;
  const RoadCase& road = c.ground->road;
  const road::Surface surface(*road.read, edges_of(road));
  const double start = *road.start, spacing = s.model.contact->ground.spacing();
  const Stretch reach = reach_along(c, s.mesh),
                on_road{surface.u_axis().first() - start, surface.u_axis().last() - start};
  const road::RoadPart part{reach.from + start, reach.to + start, road.offset, road.offset};
  const auto tell = [&](std::string text) { s.figures.emplace_back("road", std::move(text)); };
  tell(
      fmt::format("x is u - {:.6g} m, at v = {:.6g} m; y is the height less that at x = 0, {:.6g} "
                  "m in the file",
                  start, road.offset, road.height));
  tell(fmt::format("The road goes from x = {:.6g} to {:.6g} m; before and behind it, {}.",
                   on_road.from, on_road.to, beyond_text(road)));
  for (std::string& line :
       road::lines_of(*road.read, road::report_of(*road.read, surface, part), edges_of(road)))
    tell(std::move(line));
  std::string warnings[2] = {leaving_text(road, reach, on_road)};
  if (spacing > 0.0)
    warnings[1] = bend_within_element(
        road::largest_bend(road::section_of(surface, road.offset), spacing, part), start, spacing);
  for (std::string& warning : warnings)
    if (!warning.empty()) s.warnings.push_back(std::move(warning));
}

}  // namespace rondo::study
