// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/stability.hpp"
#include "rondo/case/case.hpp"
#include "rondo/case/features/case_features.hpp"
#include "rondo/core/bytes.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/limits/memory_limits.hpp"
#include "rondo/fem/viscosity.hpp"
#include "rondo/integrators/massless/ring_matrix.hpp"
#include "rondo/output/recorder.hpp"

namespace rondo::study {
namespace {

/// Numbers of a node to start in steady rolling: samples and harmonics of its displacement, twice.
constexpr std::size_t rolling_numbers = 64;

}  // namespace

std::size_t mesh_memory(std::size_t nodes) noexcept {
  constexpr std::size_t program = 30'000'000;    // with its libraries
  constexpr std::size_t numbers_of_a_node = 48;  // with those of a cell: there are as many
  return program + nodes * numbers_of_a_node * sizeof(double);
}

bool has_wide_rows(const Case& c, const mesh::Mesh& mesh) noexcept {
  const auto by_mean = [](const fem::Material& m) { return fem::element_law(m).mean_bulk > 0.0; };
  return (by_mean(c.material) ||
          std::ranges::any_of(c.regions, by_mean, &MaterialRegion::material)) &&
         std::ranges::any_of(mesh.cells,
                             [](const mesh::Cell& cell) { return mesh::n_corners(cell) == 3; });
}

std::size_t stiffness_memory(std::size_t nodes, bool wide_rows) noexcept {
  // Blocks of a node of quadrilaterals; triangles have 19, and the means that they come from.
  const std::size_t blocks = wide_rows ? 30 : 9;
  return nodes * 2 * blocks * (4 * sizeof(double) + sizeof(int));
}

std::size_t factor_memory(std::size_t dofs, bool wide_rows) noexcept {
  RONDO_DEMAND(dofs > 0, dofs);
  const double bytes_per_entry = wide_rows ? 120.0 : 60.0;
  const double n = static_cast<double>(dofs);
  return static_cast<std::size_t>(bytes_per_entry * n * std::log2(n));
}

/// Memory for contact nodes without mass: columns of K_cc⁻¹, of which RingMatrix keeps so many.
static std::size_t ring_memory(std::size_t candidates) noexcept {
  return std::min(candidates * candidates * 4 * sizeof(double),
                  dynamics::RingMatrix::column_memory);
}

std::size_t rubber_memory(const Case& c, const mesh::Mesh& mesh) {
  if (!has_rubber(c)) return 0;
  RONDO_DEMAND(!mesh.cells.empty(), mesh.n_nodes());
  const std::vector<fem::Material> materials = materials_of(c, mesh);
  std::size_t n_rubber = 0, n_branches = 0;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const auto& rubber = fem::material_of(mesh, materials, e).rubber;
    if (!rubber) continue;
    ++n_rubber;
    n_branches += rubber->branches.size();
  }
  // A cell as it is read and as it is laid out for the steps: corners, geometry, forces.
  constexpr std::size_t of_cell = 248, of_branch = 6 * sizeof(double), of_node = 72;
  const std::size_t one_stiffness = stiffness_memory(mesh.n_nodes(), has_wide_rows(c, mesh)) / 2;
  const double linear_share =
      1.0 - static_cast<double>(n_rubber) / static_cast<double>(mesh.cells.size());
  std::size_t bytes = n_rubber * of_cell + n_branches * of_branch + mesh.n_nodes() * of_node;
  bytes += one_stiffness;  // the pattern of tangents
  bytes += static_cast<std::size_t>(2.0 * linear_share * static_cast<double>(one_stiffness));
  return bytes;
}

/// Branches at small strain: four fields of each, and in the plane the stiffness of each kind.
static std::size_t viscous_memory(const Case& c, const mesh::Mesh& mesh) {
  if (has_rubber(c)) return 0;
  std::vector<std::vector<fem::ViscousBranch>> kinds;
  for (const fem::Material& m : materials_of(c, mesh))
    if (const auto& own = fem::branches_of(m); !own.empty() && !std::ranges::count(kinds, own))
      kinds.push_back(own);
  std::size_t branches = 0;
  for (const auto& kind : kinds) branches += kind.size();
  constexpr std::size_t fields = 4;
  const std::size_t components = mesh.is_solid() ? 3 : 2;
  const std::size_t of_fields = fields * components * branches * mesh.n_nodes() * sizeof(double);
  const std::size_t of_stiffness = stiffness_memory(mesh.n_nodes(), has_wide_rows(c, mesh)) / 2;
  return of_fields + (mesh.is_solid() ? 0 : kinds.size() * of_stiffness);
}

/// K of one sector, and the factor of a harmonic of it for the critical step.
static std::size_t solid_motion_memory(const Case& c, const mesh::Mesh& mesh) {
  RONDO_DEMAND(mesh.n_sectors > 0, mesh.n_sectors);
  constexpr std::size_t numbers_of_a_node = 24;  // that a plane one has not
  const std::size_t nodes = mesh.n_nodes(), of_a_snapshot = 6 * nodes * sizeof(double);
  const auto snapshots = static_cast<std::size_t>(c.output.snapshots);
  const std::size_t of_a_sector = 3 * nodes / static_cast<std::size_t>(mesh.n_sectors);
  return mesh_memory(nodes) + nodes * numbers_of_a_node * sizeof(double) +
         factor_memory(of_a_sector, true) + viscous_memory(c, mesh) +
         std::min(snapshots, queue_length(snapshots, of_a_snapshot)) * of_a_snapshot;
}

std::size_t motion_memory(const Case& c, const mesh::Mesh& mesh) {
  if (mesh.is_solid()) return solid_motion_memory(c, mesh);
  const std::size_t nodes = mesh.n_nodes(), of_a_snapshot = 2 * nodes * sizeof(Vec2);
  RONDO_DEMAND(mesh.clamped.size() <= nodes, mesh.clamped.size(), nodes);
  const auto snapshots = static_cast<std::size_t>(c.output.snapshots);
  const bool harmonics = mesh.n_sectors > 0 && !c.free_rim &&
                         c.contact_mass == ContactMass::lumped &&
                         2 * (nodes - mesh.clamped.size()) > harmonic_setup_dofs;
  const std::size_t of_a_sector =
      harmonics ? 2 * nodes / static_cast<std::size_t>(mesh.n_sectors) : 0;
  const bool sector_alone = harmonics && why_not_cyclic(c).empty();
  const bool wide_rows = has_wide_rows(c, mesh);
  const bool factorised = c.initial.state == InitialState::stationary ||
                          (c.motion.angular_velocity.largest() != 0.0 && !has_rubber(c) &&
                           softening_is_checked(2 * nodes, of_a_sector));
  // Snapshots may wait to be written, where steps are faster than files.
  std::size_t bytes = mesh_memory(nodes) + rubber_memory(c, mesh) + viscous_memory(c, mesh) +
                      std::min(snapshots, queue_length(snapshots, of_a_snapshot)) * of_a_snapshot;
  if (!sector_alone) bytes += stiffness_memory(nodes, wide_rows);
  if (factorised) bytes += factor_memory(harmonics ? of_a_sector : 2 * nodes, wide_rows);
  // The scheme "hati" has K of its parts, and the factor of the implicit one, not symmetric.
  if (c.hati) bytes += stiffness_memory(nodes, wide_rows) + 2 * factor_memory(2 * nodes, wide_rows);
  if (c.initial.state == InitialState::steady_rolling)
    bytes += nodes * rolling_numbers * sizeof(double);
  if (c.contact_mass != ContactMass::lumped) bytes += ring_memory(mesh.boundary.size());
  return bytes;
}

void demand_memory(const Case& c, std::size_t nodes, std::size_t needed) {
  const AllowedMemory allowed = allowed_memory();
  if (needed <= allowed.bytes) return;
  throw case_error(
      c,
      c.mesh      ? "mesh.file"
      : c.section ? "section.sectors"
                  : std::string(largest_count(c.disk)),
      fmt::format("the mesh of {} nodes needs about {} of memory, and {} {}", nodes,
                  readable_bytes(needed), allowed.source, readable_bytes(allowed.bytes)),
      "a coarser mesh, or more memory");
}

}  // namespace rondo::study
