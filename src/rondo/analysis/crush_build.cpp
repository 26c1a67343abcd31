// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush_build.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/analysis/bodies.hpp"
#include "rondo/analysis/estimate.hpp"
#include "rondo/analysis/room.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

void refuse_free_bodies(const Case& c, const mesh::Mesh& mesh) {
  const mesh::Bodies bodies = mesh::find_bodies(mesh);
  std::vector<char> held(static_cast<std::size_t>(bodies.count), 0);
  for (const int node : mesh.clamped)
    held[static_cast<std::size_t>(bodies.of_node[static_cast<std::size_t>(node)])] = 1;
  const auto free = std::count(held.begin(), held.end(), 0);
  if (free > 0)
    throw case_error(c, "mesh.clamped",
                     fmt::format("holds {} of {} bodies, and a crush presses them down by what is "
                                 "held",
                                 bodies.count - free, bodies.count),
                     "a physical curve of every body");
  if (mesh.boundary.empty())
    throw case_error(c, "mesh.contact", "no node may touch the ground",
                     "a physical curve of the mesh");
}

}  // namespace

CrushSetup build_crush(const Case& c) {
  RONDO_DEMAND(c.analysis.kind == AnalysisKind::crush && c.ground.has_value(),
               c.ground.has_value());
  CrushSetup s;
  s.mesh = build_mesh(c, &s.warnings);
  if (c.mesh) demand_memory(c, s.mesh.n_nodes(), estimated_memory(c, size_of(s.mesh)));
  s.materials = materials_of(c, s.mesh);
  refuse_free_bodies(c, s.mesh);
  s.mass = fem::lumped_mass(s.mesh, s.materials);
  s.free = fem::free_nodes(s.mesh);
  s.model = statics::make_crush_model(s.mesh.coordinates, s.mesh.boundary, c.ground->friction);
  s.ground_height = c.ground->shape.profile.front().y;
  const std::size_t first = static_cast<std::size_t>(s.mesh.boundary.front());
  s.touch_height = s.model.clearance.front() - s.mesh.coordinates[first].y;
  s.reach = 2.0 * c.analysis.depth;  // what the body bulges beside the contact stays below that
  s.within_reach = static_cast<std::size_t>(
      std::count_if(s.model.clearance.begin(), s.model.clearance.end(),
                    [&](double clearance) { return clearance <= s.reach; }));
  return s;
}

}  // namespace rondo::study
