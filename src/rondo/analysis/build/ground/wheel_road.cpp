// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/ground/wheel_road.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rondo/analysis/build/ground/road_lines.hpp"
#include "rondo/analysis/build/ground/road_reach.hpp"
#include "rondo/analysis/build/ground/wheel_obstacles.hpp"
#include "rondo/case/ground/road_ground.hpp"
#include "rondo/contact/space/road_ground.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/road/road_report.hpp"

namespace rondo::study {
namespace {

using road::RoadPart;
using road::RoadPlace;

constexpr const char* offset_key = "ground.road_offset";
/// The foot of a node is found from the point straight above it up to this slope (45 degrees).
constexpr double largest_slope = 1.0;
/// A lower step at a border of the road is none [m].
constexpr double least_step = 1e-6;
/// Heights this far apart tell a step [m].
constexpr double across_border = 1e-7;

std::string at_place(double u, double v) {
  return fmt::format("u = {:.6g} m, v = {:.6g} m", u, v);
}

/// Whether the road begins again, or goes back, beyond the ends of an axis.
bool goes_on(const road::Axis& axis) {
  return axis.border() == road::Border::repeat || axis.border() == road::Border::reflect;
}

/// The part that the wheel comes to, as far along as it is known.
RoadPart reached_part(const Case& c, const Setup& s) {
  const RoadCase& road = c.ground->road;
  const Stretch across = reach_across(c, s.mesh);
  RoadPart part{.v_from = road.offset - across.to, .v_to = road.offset - across.from};
  if (s.model.rim && s.model.rim->free_x) return part;
  const Stretch along = reach_along(c, s.mesh);
  part.u_from = along.from + *road.start;
  part.u_to = along.to + *road.start;
  return part;
}

/// The part of the grid that the wheel meets there: the whole of an axis that goes on, if the wheel
/// comes beyond an end of it.
RoadPart met_part(const RoadPart& reached, const road::Surface& surface) {
  RoadPart part = reached;
  const auto is_left = [](const road::Axis& axis, double from, double to) {
    return goes_on(axis) && !(from >= axis.first() && to <= axis.last());
  };
  const RoadPart whole;
  if (is_left(surface.u_axis(), part.u_from, part.u_to))
    part.u_from = whole.u_from, part.u_to = whole.u_to;
  if (is_left(surface.v_axis(), part.v_from, part.v_to))
    part.v_from = whole.v_from, part.v_to = whole.v_to;
  return part;
}

/// The largest step at an end of the road within the part; 0: there is none that counts.
RoadPlace step_at_ends(const road::Surface& surface, const RoadPart& part) {
  const road::Axis &u = surface.u_axis(), &v = surface.v_axis();
  const road::RoadCells cells = road::cells_in(surface, part);
  RoadPlace largest{.value = least_step};
  for (const auto& [end, outside] : {std::pair{u.first(), u.first() - across_border},
                                     std::pair{u.last(), u.last() + across_border}}) {
    if (outside < part.u_from || outside > part.u_to) continue;
    for (std::size_t j = cells.v_begin; j <= cells.v_end; ++j) {
      const double at_v = v.position(j),
                   step = std::abs(surface.at(outside, at_v).height - surface.at(end, at_v).height);
      if (step > largest.value) largest = {step, end, at_v};
    }
  }
  return largest.value > least_step ? largest : RoadPlace{};
}

/// The wheel goes beyond a side of the road, where there is a step or nothing.
void refuse_beyond_sides(const Case& c, const road::Surface& surface, const RoadPart& part) {
  const road::Axis &u = surface.u_axis(), &v = surface.v_axis();
  const road::RoadCells cells = road::cells_in(surface, part);
  const auto refuse = [&](const std::string& what) {
    throw case_error(
        c, offset_key,
        fmt::format("the wheel comes to v = {:.4g} to {:.4g} m, and the road goes from {:.4g} to "
                    "{:.4g} m: beyond its side {}",
                    part.v_from, part.v_to, v.first(), v.last(), what),
        "another ground.road_offset, less drift by motion.slip_angle, or a wider road; or "
        "BORDER_MODE_V = 2 in the file, which keeps the height of the side");
  };
  for (const auto& [side, outside] : {std::pair{v.first(), v.first() - across_border},
                                      std::pair{v.last(), v.last() + across_border}}) {
    if (outside < part.v_from || outside > part.v_to) continue;
    if (surface.edges().v == road::Border::none) refuse("there is no ground (BORDER_MODE_V = 0)");
    for (std::size_t i = cells.u_begin; i <= cells.u_end; ++i) {
      const double at_u = u.position(i), step = std::abs(surface.at(at_u, outside).height -
                                                         surface.at(at_u, side).height);
      if (step > least_step)
        refuse(fmt::format("there is a step of {:.3g} m, at {}", step, at_place(at_u, side)));
    }
  }
}

void refuse_holes(const Case& c, const road::Surface& surface, const RoadPart& part) {
  const road::RoadCells cells = road::cells_in(surface, part);
  for (std::size_t i = cells.u_begin; i <= cells.u_end; ++i)
    for (std::size_t j = cells.v_begin; j <= cells.v_end; ++j)
      if (std::isnan(surface.height_at(i, j)))
        throw case_error(
            c, "ground.road",
            fmt::format("{} has no height at {}, where the wheel comes", c.ground->road.read->file,
                        at_place(surface.u_axis().position(i), surface.v_axis().position(j))),
            "another ground.road_offset or ground.road_start; or GRID_NAN_MODE = 2 in "
            "the file, which fills missing heights");
}

void refuse_steep(const Case& c, const RoadPlace& steepest) {
  if (!(steepest.value > largest_slope)) return;
  throw case_error(
      c, "ground.road",
      fmt::format("{} has a slope of {:.3g} at {}, where the wheel comes: the place of a node on "
                  "the surface is found from straight above it, up to slopes of {:.3g}",
                  c.ground->road.read->file, steepest.value, at_place(steepest.u, steepest.v),
                  largest_slope),
      "another ground.road_offset or ground.road_start; a smoother road; or its section as "
      "ground.profile, which may be steep (docs/roads.md, section 4)");
}

/// The longest edges of the candidates around the wheel and across [m].
road::ElementLengths element_of(const Setup& s) {
  std::vector<double> axial;
  for (const int node : s.mesh.boundary) axial.push_back(s.mesh.axial[at(node)]);
  std::ranges::sort(axial);
  double across = 0.0;
  for (std::size_t k = 1; k < axial.size(); ++k) across = std::max(across, axial[k] - axial[k - 1]);
  return {s.model.contact->ground.spacing(), across};
}

std::string bend_text(const Setup& s, const road::Surface& surface, const RoadPart& part) {
  const road::ElementLengths element = element_of(s);
  const RoadPlace bend = road::largest_slope_change(surface, element, part);
  if (!(bend.value > told_slope_change)) return {};
  return fmt::format(
      "ground.road: the slope changes by {:.3g} at {} within an element, {:.3g} m along and {:.3g} "
      "m across: what is shorter passes between the nodes; give a finer mesh, or a smoother road",
      bend.value, at_place(bend.u, bend.v), element.u, element.v);
}

std::string end_text(const road::Surface& surface, const RoadPart& part) {
  const RoadPlace step = step_at_ends(surface, part);
  if (step.value == 0.0) return {};
  return fmt::format(
      "ground.road: there is a step of {:.3g} m at the end of the road, at {}, into which nodes go "
      "without an impact from its side; give a road whose ends fit, another ground.road_border, or "
      "a shorter run",
      step.value, at_place(step.u, step.v));
}

/// A warning where the wheel goes beyond a side that does not go on.
std::string side_text(const road::Surface& surface, const RoadPart& reached) {
  const road::Border border = surface.edges().v;
  const road::Axis& v = surface.v_axis();
  const bool goes_on = border == road::Border::repeat || border == road::Border::reflect;
  if (goes_on || (reached.v_from >= v.first() && reached.v_to <= v.last())) return {};
  return fmt::format(
      "ground.road: the wheel comes to v = {:.4g} to {:.4g} m, and the road goes from {:.4g} to "
      "{:.4g} m: beyond its sides the ground goes on at the height of the side; give another "
      "ground.road_offset, less drift by motion.slip_angle, or a wider road",
      reached.v_from, reached.v_to, v.first(), v.last());
}

void tell_surface(const Case& c, Setup& s, const road::Surface& surface, const RoadPart& reached,
                  const road::RoadReport& report) {
  const RoadCase& road = c.ground->road;
  const Stretch on_road{surface.u_axis().first() - *road.start,
                        surface.u_axis().last() - *road.start};
  const auto line = [&](std::string text) { s.figures.emplace_back("road", std::move(text)); };
  line(
      fmt::format("x is u - {:.6g} m, t2 is {:.6g} m - v; y is the height of the smooth surface "
                  "less that at x = t2 = 0, {:.6g} m in the file",
                  *road.start, road.offset, road.height));
  line(
      fmt::format("The road goes from x = {:.6g} to {:.6g} m; before and behind it, {}. The wheel "
                  "comes to v = {:.4g} to {:.4g} m.",
                  on_road.from, on_road.to, beyond_text(road), reached.v_from, reached.v_to));
  for (std::string& text : road::lines_of(*road.read, report, surface.edges()))
    line(std::move(text));
  for (std::string& warning :
       std::array{leaving_text(road, reach_along(c, s.mesh), on_road), side_text(surface, reached),
                  end_text(surface, report.part), bend_text(s, surface, report.part)})
    if (!warning.empty()) s.warnings.push_back(std::move(warning));
}

}  // namespace

void set_wheel_road(const Case& c, Setup& s) {
  if (!is_on_road_surface(c) || !s.model.contact) return;
  RONDO_DEMAND(s.model.solid && c.ground->road.start, c.ground->road.file);
  const RoadCase& road = c.ground->road;
  road::Surface surface(*road.read, edges_of(road));
  const RoadPart reached = reached_part(c, s), met = met_part(reached, surface);
  refuse_beyond_sides(c, surface, reached);
  refuse_holes(c, surface, met);
  const road::RoadReport report = road::report_of(*road.read, surface, met);
  refuse_steep(c, report.steepest);
  tell_surface(c, s, surface, reached, report);
  const auto ground = std::make_shared<const contact::RoadGround>(
      std::move(surface), contact::RoadPlacing{*road.start, road.offset, road.height},
      RoadPart{.v_from = reached.v_from, .v_to = reached.v_to});
  s.model.contact->space = obstacles_on(c, ground, s);
}

}  // namespace rondo::study
