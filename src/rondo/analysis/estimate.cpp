// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/analysis/build.hpp"
#include "rondo/case/case_rules.hpp"
#include "rondo/output/run_output.hpp"

namespace rondo::study {

MeshSize size_of(const mesh::Mesh& mesh) noexcept {
  return {mesh.n_nodes(), mesh.cells.size(), mesh.clamped.size(),
          static_cast<std::size_t>(mesh.n_sectors)};
}

MeshSize size_of(const mesh::Disk& disk) noexcept {
  const auto count = [](int n) { return static_cast<std::size_t>(n); };
  const std::size_t sectors = count(disk.tread ? disk.tread->pitches : disk.circumferential);
  const std::size_t of_a_sector =
      disk.tread ? count(disk.tread->land_columns) + count(disk.tread->groove_columns) : 1;
  return {mesh::n_disk_nodes(disk), mesh::n_disk_cells(disk), sectors * of_a_sector, sectors};
}

namespace {

constexpr std::size_t program_memory = 30'000'000;  ///< with its libraries

bool set_up_by_harmonics(const Case& c, const MeshSize& mesh) noexcept {
  return mesh.sectors > 0 && !c.free_rim && c.analysis.kind == AnalysisKind::dynamic &&
         2 * (mesh.nodes - mesh.clamped) > harmonic_setup_dofs;
}

/// Of the assembled stiffness: 9 blocks of 2 x 2 doubles and an index for a node of a grid of
/// quadrilaterals, held twice while they are assembled.
std::size_t assembled_bytes(std::size_t nodes) noexcept {
  constexpr std::size_t blocks = 9;
  return nodes * 2 * blocks * (4 * sizeof(double) + sizeof(int));
}

/// Nested dissection of a plane grid fills in about n log2 n; the factor is fitted to runs of 10⁴
/// to 4·10⁵ dofs.
std::size_t factor_bytes(double dofs) noexcept {
  constexpr double bytes_per_entry = 60.0;
  return static_cast<std::size_t>(bytes_per_entry * dofs * std::log2(dofs));
}

/// Large disks go without an assembled stiffness.
std::size_t stiffness_memory(const Case& c, const MeshSize& mesh) noexcept {
  if (set_up_by_harmonics(c, mesh) && c.solver_operator != "sparse" && why_not_cyclic(c).empty())
    return 0;
  return assembled_bytes(mesh.nodes);
}

/// Of the Cholesky factors for a crush, the stationary start and the check of spin softening.
std::size_t factor_memory(const Case& c, const MeshSize& mesh) noexcept {
  const bool harmonics = set_up_by_harmonics(c, mesh);
  const double dofs = 2.0 * static_cast<double>(harmonics ? mesh.nodes / mesh.sectors : mesh.nodes);
  const std::size_t of_a_sector = harmonics ? 2 * mesh.nodes / mesh.sectors : 0;
  const bool checked = c.motion.angular_velocity.largest() != 0.0 &&
                       softening_is_checked(2 * mesh.nodes, of_a_sector);
  const bool crush = c.analysis.kind == AnalysisKind::crush;
  if (!checked && !crush && c.initial.state != InitialState::stationary) return 0;
  return factor_bytes(dofs);
}

/// Of a crush: the fields of the 32 columns that are condensed at once (loads, solution and copies
/// within CHOLMOD), the compliance and its direct solves; candidates up to twice the depth.
std::size_t compliance_memory(const Case& c, std::size_t nodes) noexcept {
  if (c.analysis.kind != AnalysisKind::crush || c.mesh) return 0;  // of a file: not known before
  const mesh::Disk& d = c.disk;
  const double columns = d.tread
                             ? static_cast<double>(d.tread->pitches) * (d.tread->land_columns + 1.0)
                             : static_cast<double>(d.circumferential);
  const double share =
      std::acos(std::max(-1.0, 1.0 - 2.0 * c.analysis.depth / d.outer_radius)) / std::numbers::pi;
  const double rows = 2.0 * share * columns;
  constexpr double columns_at_once = 32.0, copies = 3.0;
  const double fields = copies * columns_at_once * 2.0 * static_cast<double>(nodes);
  const bool pivots = c.ground && c.ground->friction > 1.0;  // only then seen to be needed
  const double matrices = (pivots ? 7.5 : 3.0) * rows * rows;
  return static_cast<std::size_t>((fields + matrices) * sizeof(double));
}

/// Of snapshots that wait to be written, displacement and velocity each.
std::size_t queue_memory(const Case& c, std::size_t nodes) noexcept {
  if (c.analysis.kind == AnalysisKind::crush || c.output.snapshots == 0) return 0;
  const auto snapshots = static_cast<std::size_t>(c.output.snapshots);
  const std::size_t bytes = 2 * nodes * sizeof(Vec2);
  return std::min(snapshots, queue_length(snapshots, bytes)) * bytes;
}

}  // namespace

bool softening_is_checked(std::size_t dofs, std::size_t harmonic_dofs) noexcept {
  return dofs <= softening_check_dofs ||
         (harmonic_dofs > 0 && harmonic_dofs <= softening_check_harmonic_dofs);
}

std::size_t estimated_memory(const Case& c, const MeshSize& mesh) noexcept {
  // Mesh, model, state and what is written; weights and nodal values of the stress; a checkpoint.
  const bool dynamic = c.analysis.kind == AnalysisKind::dynamic;
  const std::size_t fields =
      ((c.output.stress ? 38 : 30) + (dynamic ? numbers_of_a_checkpoint : 0)) * sizeof(double);
  return program_memory + mesh.nodes * fields + stiffness_memory(c, mesh) +
         mesh.cells * sizeof(mesh::Cell) + factor_memory(c, mesh) +
         compliance_memory(c, mesh.nodes) + queue_memory(c, mesh.nodes);
}

std::size_t estimated_modes_memory(const MeshSize& mesh, std::size_t shapes,
                                   std::size_t at_once) noexcept {
  const std::size_t dofs = 2 * mesh.nodes;
  // Mesh and masses; complex shapes, kept and as they are written.
  std::size_t bytes = program_memory + mesh.nodes * 30 * sizeof(double) +
                      (shapes + at_once) * mesh.nodes * 2 * sizeof(Vec2) +
                      mesh.cells * sizeof(mesh::Cell);
  if (mesh.sectors > 0) return bytes;  // those of one sector are small
  bytes += assembled_bytes(mesh.nodes);
  constexpr std::size_t spare = 50;  // vectors of the space beyond twice the modes
  bytes += (2 * at_once + spare) * dofs * sizeof(double);
  return bytes + factor_bytes(static_cast<double>(dofs));
}

}  // namespace rondo::study
