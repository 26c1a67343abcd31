// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/probes.hpp"

#include <cmath>
#include <numeric>

#include "rondo/core/contract.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/model/corotated.hpp"

namespace rondo::study {
namespace {

struct ProbeValues {
  Vec2 displacement, velocity;  ///< [m], [m/s]
  fem::Stress stress{};         ///< [Pa]
};

ProbeValues look_at(const ProbedBody& body, const ProbeSite& site, const dynamics::State& state) {
  RONDO_ASSERT(site.cell < body.mesh.cells.size(), site.cell, body.mesh.cells.size());
  const mesh::Cell& cell = body.mesh.cells[site.cell];
  const auto n = static_cast<std::size_t>(mesh::n_corners(cell));
  RONDO_ASSERT(
      std::abs(1.0 - std::accumulate(site.weight.begin(), site.weight.begin() + n, 0.0)) < 1e-9,
      site.cell);  // shape functions
  ProbeValues values;
  for (std::size_t a = 0; a < n; ++a) {
    const auto node = static_cast<std::size_t>(cell[a]);
    values.displacement += site.weight[a] * state.u.plane()[node];
    values.velocity += site.weight[a] * state.v.plane()[node];
  }
  const fem::Material& material = fem::material_of(body.mesh, body.materials, site.cell);
  const auto elastic = [&](int node) {
    const auto k = static_cast<std::size_t>(node);
    return dynamics::elastic_displacement(body.model, state.poses, k, state.u.plane()[k]);
  };
  const auto corners =
      fem::cell_stress(body.mesh, site.cell, fem::stress_law(material), body.dilatation, elastic);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t k = 0; k < values.stress.size(); ++k)
      values.stress[k] += site.weight[a] * corners[a][k];
  const auto first = static_cast<std::size_t>(cell[0]);
  if (in_fixed_frame(body.model, first)) {
    const auto b = static_cast<std::size_t>(body.model.free_body[first]);
    values.stress = fem::turned(values.stress, state.poses[b].rotation);
  }
  return values;
}

}  // namespace

std::vector<ColumnLabel> probe_columns(const std::vector<Probe>& probes) {
  static constexpr std::array<std::array<const char*, 3>, 8> quantities{
      {{"ux", "m",
        "displacement at `time_s`: co-rotating frame; of a free body x − X, fixed frame"},
       {"uy", "m", "likewise"},
       {"vx", "m/s",
        "velocity in the same frame, half a step before `time_s`, with the scheme `hati` at it"},
       {"vy", "m/s", "likewise"},
       {"sxx", "Pa",
        "stress at `time_s` in the same frame, of the cell alone: by the shape functions from its "
        "corners; fields have the mean of all cells at a node"},
       {"syy", "Pa", "likewise"},
       {"szz", "Pa", "likewise"},
       {"sxy", "Pa", "likewise"}}};
  std::vector<ColumnLabel> columns;
  for (const Probe& probe : probes)
    for (const auto& [name, unit, meaning] : quantities)
      columns.push_back({probe.name + "_" + name, unit, meaning});
  return columns;
}

void append_probes(const ProbedBody& body, std::span<const ProbeSite> sites,
                   const dynamics::State& state, std::vector<double>& row) {
  RONDO_DEMAND(state.u.size() == body.mesh.n_nodes() && state.v.size() == body.mesh.n_nodes() &&
                   state.poses.size() == body.model.free_bodies.size(),
               state.u.size(), state.v.size(), body.mesh.n_nodes(), state.poses.size());
  for (const ProbeSite& site : sites) {
    const ProbeValues v = look_at(body, site, state);
    for (const Vec2 a : {v.displacement, v.velocity}) row.insert(row.end(), {a.x, a.y});
    row.insert(row.end(), v.stress.begin(), v.stress.end());
  }
}

}  // namespace rondo::study
