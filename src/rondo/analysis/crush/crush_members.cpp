// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/crush_members.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/analysis/base/shared_members.hpp"
#include "rondo/core/keep_larger.hpp"

namespace rondo::study {
namespace {

struct Planned {
  const AnalysisCase& a;
  const CrushPath& path;
  double prepare_s;
};
Json unless_loaded(const Planned& p, double depth) {
  return p.path.has_load() ? absent() : Json(depth);
}
constexpr JsonMember<Planned> planned_rows[] = {
    {"depth", "number", "m", "Depth at the end; not with a load",
     [](const Planned& p) {
       return unless_loaded(p, p.path.has_load() ? 0.0 : p.path.depth(p.path.n_increments()));
     }},
    {"depth_max", "number", "m", "Largest depth on the way; not with a load",
     [](const Planned& p) { return unless_loaded(p, p.path.largest_depth()); }},
    {"load", "number", "N", "Load at the end, where `analysis.load` is given",
     [](const Planned& p) {
       return p.path.has_load() ? Json(p.path.load(p.path.n_increments())) : absent();
     }},
    {"increments", "integer", "", "Increments of the depth or load that are planned",
     [](const Planned& p) -> Json { return p.a.increments; }},
    {"slide", "number", "m", "Slide at the end; 0: none",
     [](const Planned& p) -> Json { return p.path.slide(p.path.n_increments()); }},
    {"slide_increments", "integer", "",
     "Increments of the slide that are planned; 0 without a slide, and with tables",
     [](const Planned& p) -> Json { return p.a.slide_increments; }},
    {"factor_wall_s", "number", "s",
     "Wall time to factorise and condense the stiffness; of a wheel in three dimensions, of its "
     "harmonics",
     [](const Planned& p) -> Json { return p.prepare_s; }},
};
constexpr JsonMember<int> increments_rows[] = {
    {"increments_done", "integer", "", "Increments solved, of both; their results are kept",
     [](const int& n) -> Json { return n; }},
};
constexpr JsonMember<double> equilibrium_rows[] = {
    {"equilibrium_residual_max", "number", "",
     "Largest |K u − Hᵀ r| over |Hᵀ r|; of a wheel in three dimensions, the largest force of a "
     "node that is out of balance over the largest force of the ground on one",
     [](const double& residual) -> Json { return residual; }},
};
constexpr JsonMember<WheelEffort> effort_rows[] = {
    {"height", "number", "m", "Height of the center of a 3D wheel above y = 0, at the end",
     [](const WheelEffort& e) -> Json { return e.height; }},
    {"depth_reached", "number", "m",
     "Depth of the center of a 3D wheel below first touch, at the end",
     [](const WheelEffort& e) -> Json { return e.depth; }},
    {"newton_steps_max", "integer", "",
     "Most Newton steps of an increment of a 3D wheel; with `inflation.nonlinear` of all of its "
     "problems of contact",
     [](const WheelEffort& e) -> Json { return e.newton_steps; }},
    {"pairs", "integer", "", "Contact nodes of a 3D wheel that were considered",
     [](const WheelEffort& e) -> Json { return e.pairs; }},
    {"balance_residual", "number", "",
     "With `inflation.nonlinear`: the largest force by which a node is out of balance, over the "
     "load, of all increments",
     [](const WheelEffort& e) { return e.is_nonlinear ? Json(e.balance_residual) : absent(); }},
    {"contact_problems", "integer", "",
     "With `inflation.nonlinear`: problems of contact that were solved until the forces balanced, "
     "of all increments",
     [](const WheelEffort& e) { return e.is_nonlinear ? Json(e.contact_problems) : absent(); }},
};

}  // namespace

void describe_path(const AnalysisCase& analysis, const CrushPath& path, double prepare_s, Json& j) {
  add_members(planned_rows, {analysis, path, prepare_s}, j);
}

std::string reached_text(int increments, double depth, double slide) {
  const std::string text = fmt::format("{} increments to a depth of {:.6g} m", increments, depth);
  return slide == 0.0 ? text : fmt::format("{} and a slide of {:.6g} m", text, slide);
}

void refuse_resume(const Case& c, const RunOptions& options) {
  if (options.resume)
    throw case_error(c, "analysis.kind", "a crush has no checkpoints to resume from",
                     "\"dynamic\", or --overwrite instead of --resume");
}

void CrushLargest::take(double of_law, double of_equilibrium, double of_penetration) {
  residual = keep_larger(residual, of_law);
  equilibrium = keep_larger(equilibrium, of_equilibrium);
  penetration = std::max(penetration, of_penetration);
}

void summarise_crush(const CrushEnd& end, const CrushLargest& largest, const CrushPath& path,
                     const StrainWatch& strain, Json& j, RunReport& r) {
  r.steps = end.increments;
  r.reached = reached_text(end.increments, end.depth, end.slide);
  r.energy_residual_relative = end.works.relative;
  r.energy_residual_bound = residual_bound;
  r.contact_residual_max = largest.residual;
  r.penetration_max_m = largest.penetration;
  strain.summarise({"", path.is_of_tables() ? " of the increments" : " of the depth"}, j, r);
  add_members(increments_rows, end.increments, j);
  add_steps_done(r, j);
  add_contact_residual(r, j);
  add_members(equilibrium_rows, largest.equilibrium, j);
  add_energy_residual(r, end.works.exchanged, j);
  add_penetration(r, j);
}

void add_wheel_effort(const WheelEffort& effort, Json& j) {
  add_members(effort_rows, effort, j);
}

std::vector<MemberText> crush_path_members() {
  return joined({texts_of(planned_rows), texts_of(increments_rows), texts_of(equilibrium_rows),
                 texts_of(effort_rows)});
}

}  // namespace rondo::study
