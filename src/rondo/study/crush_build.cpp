// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/crush_build.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/study/build.hpp"

namespace rondo::study {

CrushSetup build_crush(const Case& c) {
  RONDO_DEMAND(c.analysis.kind == AnalysisKind::crush && c.ground.has_value(),
               c.ground.has_value());
  CrushSetup s;
  s.mesh = build_mesh(c);
  s.mass = fem::lumped_mass(s.mesh, {&c.material, 1});
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
