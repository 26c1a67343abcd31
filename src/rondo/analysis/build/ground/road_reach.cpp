// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/ground/road_reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/case/ground/road_ground.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/ground_frame.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

constexpr int parts_of_motion = 500;  ///< the center is looked at so often

/// Calls visit(center) at times of the whole motion.
template <class Visit>
void each_center(const Case& c, Visit&& visit) {
  for (int k = 0; k <= parts_of_motion; ++k)
    visit(c.motion.center(c.time.end * k / parts_of_motion));
}

}  // namespace

void Stretch::include(double low, double high) noexcept {
  from = std::min(from, low);
  to = std::max(to, high);
}

Stretch reach_along(const Case& c, const mesh::Mesh& mesh) {
  Stretch reach;
  if (!is_held(c)) return {reach.to, reach.from};
  const double radius = extent_of(mesh);
  each_center(c, [&](Vec3 center) { reach.include(center.x - radius, center.x + radius); });
  return reach;
}

Stretch reach_across(const Case& c, const mesh::Mesh& mesh) {
  RONDO_DEMAND(mesh.is_solid() && !mesh.boundary.empty(), mesh.boundary.size());
  constexpr double margin = 0.05;  // of the radius
  const GroundFrame ground(c.motion.camber);
  Stretch wheel, reach;
  for (const int node : mesh.boundary) {
    const double radius = norm(mesh.coordinates[at(node)]), axial = mesh.axial[at(node)];
    for (const double low : {1.0, std::sqrt(0.5)}) {
      const double across = ground.from_wheel({0.0, -low * radius, axial}).z;
      wheel.include(across - margin * radius, across + margin * radius);
    }
  }
  each_center(c, [&](Vec3 center) { reach.include(center.z + wheel.from, center.z + wheel.to); });
  return reach;
}

std::string beyond_text(const RoadCase& road) {
  const road::Edges edges = edges_of(road);
  if (edges.u == road::Border::repeat) return "it repeats";
  if (edges.u == road::Border::reflect) return "it is mirrored";
  const char* const at =
      edges.u == road::Border::zero ? "at the height 0 of the file" : "at the heights of its ends";
  if (edges.offset_u == 0.0) return fmt::format("the ground is level {}", at);
  return fmt::format("the ground is level {}, plus {:.6g} m", at, edges.offset_u);
}

std::string leaving_text(const RoadCase& road, const Stretch& reach, const Stretch& on_road) {
  constexpr double slack = 1e-9;  // round-off of a wheel that begins at the end of the road [m]
  const road::Border border = edges_of(road).u;
  const bool goes_on = border == road::Border::repeat || border == road::Border::reflect;
  const bool known = std::isfinite(reach.from);
  if (goes_on || !known || (reach.from >= on_road.from - slack && reach.to <= on_road.to + slack))
    return {};
  return fmt::format(
      "ground.road: the body comes to x = {:.4g} to {:.4g} m, and the road goes from {:.4g} to "
      "{:.4g} m: before and behind it, {}; give another ground.road_start, motion.start_x or "
      "time.end, or a longer road",
      reach.from, reach.to, on_road.from, on_road.to, beyond_text(road));
}

}  // namespace rondo::study
