// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/crush/crush_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/analysis/build/ground/contact_law.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/overlap.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/mesh/physical_group.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {
namespace {

void refuse_free_bodies(const Case& c, const mesh::Mesh& mesh) {
  const mesh::Bodies bodies = mesh::find_bodies(mesh);
  std::vector<char> held(static_cast<std::size_t>(bodies.count), 0);
  for (const int node : mesh.clamped) held[at(bodies.of_node[static_cast<std::size_t>(node)])] = 1;
  const auto free = std::count(held.begin(), held.end(), 0);
  if (free > 0)
    throw case_error(
        c, "mesh.clamped",
        fmt::format("holds {} of {} bodies, and a crush presses each down by its held nodes",
                    bodies.count - free, bodies.count),
        "a physical curve of every body, " + mesh::physical_group_line("Curve", "rim"));
  if (mesh.boundary.empty())
    throw case_error(
        c, "mesh.contact", "no node may touch the ground",
        "a physical curve of the mesh, " + mesh::physical_group_line("Curve", "tread"));
}

std::string not_solved(const statics::CrushReport& report, double bound) {
  const char* failed =
      report.pivoting == statics::Pivoting::failed ? ", which found none in numbers" : "";
  return fmt::format(
      "the contact was not solved: contact residual {:.3g}, bound {:.0e}, after {} sweeps and {} "
      "pivots{}; a smaller ground.friction is easier",
      report.residual, bound, report.sweeps, report.pivots, failed);
}

/// Further memory of LATIN: histories, and for LATIN-PGD a second factor and the fields solved for.
std::size_t latin_memory(const Case& c, const CrushSetup& s, bool wide_rows) {
  if (c.analysis.solver == CrushMethod::direct) return 0;
  constexpr std::size_t histories = 15, solves = 100, copies_of_fields = 3;
  const std::size_t nodes = s.mesh.n_nodes();
  const std::size_t rows = 2 * s.within_reach;
  const std::size_t own =
      histories * rows * static_cast<std::size_t>(s.path.n_increments()) + 4 * rows * rows;
  const std::size_t both = stiffness_memory(nodes, wide_rows) + own * sizeof(double);
  if (c.analysis.solver == CrushMethod::latin) return both;
  return both + stiffness_memory(nodes, wide_rows) + factor_memory(2 * nodes, wide_rows) +
         copies_of_fields * solves * 2 * nodes * sizeof(double);
}

}  // namespace

std::size_t crush_memory(const Case& c, const CrushSetup& s) {
  RONDO_DEMAND(c.ground && s.mesh.n_nodes() > 0, c.ground.has_value(), s.mesh.n_nodes());
  const std::size_t nodes = s.mesh.n_nodes();
  constexpr std::size_t columns_at_once = 32, copies = 3;  // loads, solution, within CHOLMOD
  const std::size_t fields = copies * columns_at_once * 2 * nodes;
  const double rows = 2.0 * static_cast<double>(s.within_reach);
  const bool pivots =
      contact::largest_friction(c.ground->friction) > 1.0;     // only then seen to be needed
  const double matrices = (pivots ? 7.5 : 3.0) * rows * rows;  // compliance and direct solves
  const bool wide_rows = has_wide_rows(c, s.mesh);
  return mesh_memory(nodes) + rubber_memory(c, s.mesh) + stiffness_memory(nodes, wide_rows) +
         factor_memory(2 * nodes, wide_rows) + latin_memory(c, s, wide_rows) +
         (fields + static_cast<std::size_t>(matrices)) * sizeof(double);
}

CrushSetup build_crush(const Case& c) {
  RONDO_DEMAND(c.analysis.increments > 0 && c.ground.has_value(), c.ground.has_value());
  CrushSetup s;
  s.path = CrushPath(c.analysis);
  s.mesh = build_mesh(c, &s.warnings);
  s.materials = materials_of(c, s.mesh);
  refuse_free_bodies(c, s.mesh);
  refuse_overlaps(c, {s.mesh, s.mesh.coordinates}, s.warnings);
  s.mass = fem::lumped_mass(s.mesh, s.materials);
  s.free = fem::free_nodes(s.mesh);
  s.model =
      statics::make_crush_model(s.mesh.coordinates, s.mesh.boundary, law_of(*c.ground).friction);
  s.model.extent = s.mesh.tributary;
  RONDO_DEMAND(
      s.mass.size() == s.mesh.n_nodes() && s.model.clearance.size() == s.mesh.boundary.size(),
      s.mass.size(), s.mesh.n_nodes(), s.model.clearance.size(), s.mesh.boundary.size());
  s.ground_height = c.ground->shape.profile.front().y;
  const std::size_t first = static_cast<std::size_t>(s.mesh.boundary.front());
  s.touch_height = s.model.clearance.front() - s.mesh.coordinates[first].y;
  s.reach =
      2.0 * s.path.largest_depth();  // what the body bulges beside the contact stays below that
  s.within_reach = static_cast<std::size_t>(
      std::count_if(s.model.clearance.begin(), s.model.clearance.end(),
                    [&](double clearance) { return clearance <= s.reach; }));
  demand_memory(c, s.mesh.n_nodes(), crush_memory(c, s));
  return s;
}

void condense(const Case& c, const CrushSetup& setup, statics::Condensation& body) {
  RONDO_DEMAND(setup.reach > 0.0, setup.reach);  // by build_crush()
  if (body.factorised()) statics::append_within(setup.model, setup.reach, body);
  if (!body.factorised() || !body.compliance().allFinite())
    throw case_error(c, "material.youngs_modulus",
                     "with this mesh the stiffness is not positive definite in numbers",
                     "a modulus in SI units, a Poisson's ratio farther from 0.5 and -1");
}

std::string crush_trouble(const statics::CrushReport& report, const statics::CrushWorks& works,
                          double bound) {
  if (!std::isfinite(report.residual) || !std::isfinite(report.equilibrium))
    return "the forces or displacements are out of the range of floating-point numbers";
  if (!report.converged) return not_solved(report, bound);
  if (!(report.equilibrium <= residual_bound))
    return fmt::format("residual of the equilibrium {:.3g}, bound {:.0e}", report.equilibrium,
                       residual_bound);
  if (!(works.relative <= residual_bound))
    return fmt::format("the energy does not balance: relative residual {:.3g}, bound {:.0e}",
                       works.relative, residual_bound);
  return {};
}

std::string rubber_not_solved(const statics::CrushReport& report) {
  return fmt::format(
      "no equilibrium of the rubber was found, in parts of the increment either: residual of the "
      "equilibrium {:.3g}, of the contact law {:.3g}. The body may fold there, or its elements be "
      "strained beyond what they can: a smaller analysis.depth or slide, a finer mesh, a smaller "
      "ground.friction; or a dynamic run",
      report.equilibrium, report.residual);
}

}  // namespace rondo::study
