// SPDX-License-Identifier: BSD-3-Clause
/// @file  Probes: motion and stress at points of a body, by the shape functions of the cells that
/// contain them.
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "rondo/case/setup.hpp"
#include "rondo/core/column.hpp"
#include "rondo/fem/nodal_dilatation.hpp"
#include "rondo/model/model.hpp"

namespace rondo::study {

/// Columns of history.csv: u, v and stress of each probe.
std::vector<ColumnLabel> probe_columns(const std::vector<Probe>& probes);

/// The body that is probed; all members must outlive the call.
struct ProbedBody {
  const mesh::Mesh& mesh;
  std::span<const fem::Material> materials;
  const dynamics::Model& model;
  const fem::NodalDilatation& dilatation;
};

/// Appends the columns of each site: u [m] and v [m/s] in the rotating frame or, for a free body,
/// in the fixed frame (there u = x - X), then the stress xx, yy, zz, xy in the same frame [Pa].
/// @param state its step, u, v and poses are read
void append_probes(const ProbedBody& body, std::span<const ProbeSite> sites,
                   const dynamics::State& state, std::vector<double>& row);

}  // namespace rondo::study
