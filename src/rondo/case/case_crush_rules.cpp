// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "rondo/case/case_rules.hpp"
#include "rondo/mesh/physical_group.hpp"

namespace rondo::study {
namespace {

constexpr std::string_view depth = "analysis.depth", increments = "analysis.increments",
                           slide = "analysis.slide", slide_increments = "analysis.slide_increments",
                           load = "analysis.load";

/// Depth and slide are numbers: the body is first pressed, then slid.
void check_numbers(CaseValues& in, AnalysisCase& a) {
  if (in.has(slide)) require(in, slide_increments);
  if (in.has(slide_increments)) require(in, slide);
  if (a.slide.at(0.0) == 0.0) a.slide_increments = 0;
}

void check_table(CaseValues& in, std::string_view key, const dynamics::Table& table, int n) {
  if (!in.has_array(key) || !in.good({key})) return;
  const auto& points = table.points();
  if (points.front() != std::array{0.0, 0.0})
    return in.fault_at_item(
        key, 0, "the first point must be [0, 0]: a crush begins at first touch, increment 0");
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k][0] != std::floor(points[k][0]))
      return in.fault_at_item(key, static_cast<int>(k),
                              "the index of an increment must be an integer");
  if (in.good({increments}) && points.back()[0] != n)
    in.fault_at_item(
        key, static_cast<int>(points.size()) - 1,
        fmt::format("the last point must be at increment {0}: analysis.increments = {0}", n));
}

/// One of them is a table; if the other is given, it must be a table too.
void check_tables(CaseValues& in, const AnalysisCase& a) {
  if (!in.has_array(depth) && in.has(depth) && in.good({depth, increments}))
    in.fault(depth, "is a number beside a table of analysis.slide",
             fmt::format("a table as well: [[0, 0], [k, {0}], [{1}, {0}]], where k is the "
                         "increment at which this depth is reached",
                         a.depth.at(0.0), a.increments));
  if (!in.has_array(slide) && in.has(slide) && in.good({slide, increments}))
    in.fault(slide, "is a number beside a table of analysis.depth",
             fmt::format("a table as well: [[0, 0], [k, 0], [{}, {}]], where k is the increment "
                         "after which it slides",
                         a.increments, a.slide.at(0.0)));
  if (in.has(slide_increments))
    in.fault(slide_increments,
             "is given together with a table, whose increments are counted by analysis.increments",
             "no analysis.slide_increments");
  check_table(in, depth, a.depth, a.increments);
  check_table(in, slide, a.slide, a.increments);
}

void check_depth(CaseValues& in, const Case& c) {
  if (!in.has(depth) || !in.good({depth})) return;
  const double largest = c.analysis.depth.largest();
  const double thickness = c.disk.outer_radius - c.disk.inner_radius;
  const bool known = is_generated(c) && in.good({"disk.outer_radius", "disk.inner_radius"});
  std::string allowed = "> 0";  // for a mesh or a section: only the file gives its thickness
  if (known) allowed += fmt::format(" and < outer_radius - inner_radius = {:.6g}", thickness);
  if (largest == 0.0)
    in.fault(depth, "the body would not be pressed at all", allowed);
  else if (known && !(largest < thickness))
    in.fault(depth, "the rim would reach the ground", allowed);
}

/// A load is reached in equal parts, so that nothing beside it may be a table.
void check_load(CaseValues& in, const Case& c) {
  if (!in.has(load)) return;
  if (!is_solid(c))
    return in.fault(load, "presses a wheel in three dimensions, and the body is plane",
                    "analysis.depth instead; or a disk.width");
  if (in.has(depth))
    in.fault(load, "is given together with analysis.depth: one follows from the other",
             "one of analysis.depth and analysis.load");
  if (in.has_array(slide))
    in.fault(slide, "is a table, and analysis.load is reached in equal parts",
             "a number with analysis.slide_increments; or a table of analysis.depth instead of the "
             "load");
}

bool slides(const AnalysisCase& a) {
  return a.slide.largest() > 0.0;
}

/// Keys that only some solvers have, and cases that these solvers do not support.
void check_solver(CaseValues& in, Case& c) {
  constexpr std::string_view solver = "analysis.solver", downsizing = "analysis.downsizing";
  AnalysisCase& a = c.analysis;
  if (!in.has(downsizing)) a.downsizing = slides(a) ? 1.0 : 0.3;
  if (!in.good({solver})) return;
  const auto refuse = [&](std::string_view key, const char* name, const char* instead) {
    if (in.has(key) && in.good({key}))
      in.fault(key, fmt::format("has no effect with analysis.solver = \"{}\"", name),
               fmt::format("analysis.solver = {} beside it", instead));
  };
  if (a.solver == CrushMethod::latin) refuse(downsizing, "latin", "\"latin-pgd\"");
  if (a.solver != CrushMethod::direct && is_solid(c))
    return in.fault(solver, "is for plane bodies, not for a wheel in three dimensions",
                    "analysis.solver = \"direct\"");
  if (a.solver != CrushMethod::direct && has_rubber(c))
    in.fault(solver, "is for linear elasticity only, and a part of the body is rubber",
             "analysis.solver = \"direct\"");
  if (a.solver != CrushMethod::direct) return;
  for (const std::string_view key :
       {"analysis.search_direction", "analysis.relaxation", "analysis.tolerance"})
    refuse(key, "direct", "\"latin\" or \"latin-pgd\"");
  refuse(downsizing, "direct", "\"latin-pgd\"");
}

/// It is pressed by the means of steady rolling, which has no rubber but that of [inflation].
void check_wheel(CaseValues& in, const Case& c) {
  if (has_rubber(c) && !c.inflation)
    in.fault("analysis.kind",
             "a crush of a wheel in three dimensions is of small strain, and "
             "rubber is not",
             "[inflation] beside it, with inflation.nonlinear; or material.model = \"linear\"");
  if (c.inflation && c.inflation->spin && *c.inflation->spin != 0.0)
    in.fault("inflation.spin", "a crush presses a wheel that stands", "0");
}

}  // namespace

void check_crush(CaseValues& in, Case& c) {
  check_load(in, c);
  if (in.has_array(depth) || in.has_array(slide))
    check_tables(in, c.analysis);
  else
    check_numbers(in, c.analysis);
  check_depth(in, c);
  check_solver(in, c);
  if (is_solid(c)) check_wheel(in, c);
  if (!c.mesh && c.free_rim)
    in.fault("disk.rim", "a crush needs a disk that is bonded to its rim", "\"bonded\"");
  if (c.mesh && !is_held(c) && in.good({"mesh.clamped"}))
    in.fault("mesh.clamped", "a crush presses a body down by its held nodes, and there are none",
             "a physical curve of the mesh, " + mesh::physical_group_line("Curve", "rim"));
  check_flat_ground(in, c, "a crush");
  if (c.body_contact.between != BodyContact::none)
    in.fault("contact.between", "a crush supports contact with the ground only", "\"none\"");
  if (in.has_table("rim"))
    in.fault("rim", "a crush moves its rim by analysis.depth, not by forces",
             "a dynamic analysis, in which rim.force_y gives the depth under a load");
  if (!c.pressures.empty())
    in.fault("load.pressure[0]", "a crush supports no load except the ground",
             "a dynamic analysis");
}

}  // namespace rondo::study
