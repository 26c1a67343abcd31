// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/pressure.hpp"

#include <algorithm>

namespace rondo::dynamics {

namespace {

void add_forces(const Model& model, std::span<const Vec2> u, std::span<const mesh::Edge> edges,
                double pressure, std::span<Vec2> force) noexcept {
  const double half = 0.5 * pressure;
  for (const mesh::Edge& edge : edges) {
    const auto a = static_cast<std::size_t>(edge[0]), b = static_cast<std::size_t>(edge[1]);
    Vec2 along = model.reference[b] - model.reference[a];
    if (in_fixed_frame(model, a) || model.rim || model.internal_force) along += u[b] - u[a];
    // The body is on the left of a → b: J along points into it, L times the inward normal.
    const Vec2 share = half * turn90(along);
    force[a] += share;
    force[b] += share;
  }
}

}  // namespace

void pressure_forces(const Model& model, std::span<const Vec2> u, double time,
                     std::span<Vec2> force) noexcept {
  std::fill(force.begin(), force.end(), Vec2{});
  for (const PressureLoad& load : model.pressures)
    add_forces(model, u, load.edges, load.pressure.at(time), force);
}

std::vector<NodalLoad> nodal_loads(const Model& model) {
  std::vector<NodalLoad> loads;
  std::vector<Vec2> force(model.n_nodes());
  const std::vector<Vec2> undeformed(model.n_nodes());
  for (std::size_t l = 0; l < model.pressures.size(); ++l) {
    std::fill(force.begin(), force.end(), Vec2{});
    add_forces(model, undeformed, model.pressures[l].edges, 1.0, force);
    for (std::size_t k = 0; k < force.size(); ++k)
      if (force[k] != Vec2{}) loads.push_back({static_cast<int>(k), static_cast<int>(l), force[k]});
  }
  return loads;
}

}  // namespace rondo::dynamics
