// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/pressure.hpp"

#include <algorithm>

namespace rondo::dynamics {

void pressure_forces(const Model& model, std::span<const Vec2> u, double time,
                     std::span<Vec2> force) noexcept {
  std::fill(force.begin(), force.end(), Vec2{});
  for (const PressureLoad& load : model.pressures) {
    const double half = 0.5 * load.pressure.at(time);
    for (const mesh::Edge& edge : load.edges) {
      const auto a = static_cast<std::size_t>(edge[0]), b = static_cast<std::size_t>(edge[1]);
      Vec2 along = model.reference[b] - model.reference[a];
      if (in_fixed_frame(model, a)) along += u[b] - u[a];
      // The body is on the left of a → b: J along points into it, L times the inward normal.
      const Vec2 share = half * turn90(along);
      force[a] += share;
      force[b] += share;
    }
  }
}

}  // namespace rondo::dynamics
