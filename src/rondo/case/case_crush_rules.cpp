// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "rondo/case/case_rules.hpp"
#include "rondo/mesh/physical_group.hpp"

namespace rondo::study {
namespace {

void check_slide(CaseValues& in, AnalysisCase& analysis) {
  constexpr std::string_view slide = "analysis.slide", increments = "analysis.slide_increments";
  if (in.has(slide)) require(in, increments);
  if (in.has(increments)) require(in, slide);
  if (analysis.slide == 0.0) analysis.slide_increments = 0;
}

void check_depth(CaseValues& in, const Case& c) {
  if (c.mesh) return;  // how thick it is, only the file tells
  const double thickness = c.disk.outer_radius - c.disk.inner_radius;
  if (in.good({"disk.outer_radius", "disk.inner_radius", "analysis.depth"}) &&
      !(c.analysis.depth < thickness))
    in.fault("analysis.depth", "the rim would reach the ground",
             fmt::format("> 0 and < outer_radius - inner_radius = {:.6g}", thickness));
}

}  // namespace

void check_crush(CaseValues& in, Case& c) {
  check_slide(in, c.analysis);
  check_depth(in, c);
  if (!c.mesh && c.free_rim)
    in.fault("disk.rim", "a crush presses a disk down by its rim", "\"bonded\"");
  if (c.mesh && !is_held(c) && in.good({"mesh.clamped"}))
    in.fault("mesh.clamped", "a crush presses a body down by what is held",
             "a physical curve of the mesh, " + mesh::physical_group_line("Curve", "rim"));
  check_flat_ground(in, c, "a crush");
  if (c.body_contact.between != BodyContact::none)
    in.fault("contact.between", "a crush knows no contact but with the ground", "\"none\"");
  if (in.has_table("rim"))
    in.fault("rim", "a crush brings its rim down by analysis.depth, and forces move none",
             "a dynamic analysis; for the depth that bears a load, rim.force_y in one");
  if (!c.pressures.empty())
    in.fault("load.pressure[0]", "a crush knows no load but the ground", "a dynamic analysis");
}

}  // namespace rondo::study
