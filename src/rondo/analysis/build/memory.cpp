// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/stability.hpp"
#include "rondo/case/case_rules.hpp"
#include "rondo/core/bytes.hpp"
#include "rondo/core/memory_limits.hpp"
#include "rondo/output/recorder.hpp"

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

std::size_t mesh_memory(const MeshSize& mesh) noexcept {
  constexpr std::size_t program = 30'000'000;  // with its libraries
  constexpr std::size_t numbers_of_a_node = 46;
  return program + mesh.nodes * numbers_of_a_node * sizeof(double) +
         mesh.cells * sizeof(mesh::Cell);
}

std::size_t stiffness_memory(std::size_t nodes) noexcept {
  constexpr std::size_t blocks = 9;  // of a node of a grid of quadrilaterals
  return nodes * 2 * blocks * (4 * sizeof(double) + sizeof(int));
}

std::size_t factor_memory(std::size_t dofs) noexcept {
  constexpr double bytes_per_entry = 60.0;
  const double n = static_cast<double>(dofs);
  return static_cast<std::size_t>(bytes_per_entry * n * std::log2(n));
}

std::size_t waiting_memory(const Case& c, std::size_t nodes) noexcept {
  const std::size_t bytes = 2 * nodes * sizeof(Vec2);
  const auto snapshots = static_cast<std::size_t>(c.output.snapshots);
  return std::min(snapshots, queue_length(snapshots, bytes)) * bytes;
}

std::size_t motion_memory(const Case& c, const MeshSize& mesh) noexcept {
  const bool harmonics =
      mesh.sectors > 0 && !c.free_rim && 2 * (mesh.nodes - mesh.clamped) > harmonic_setup_dofs;
  const std::size_t of_a_sector = harmonics ? 2 * mesh.nodes / mesh.sectors : 0;
  const bool sector_alone = harmonics && c.solver_operator != "sparse" && why_not_cyclic(c).empty();
  const bool factorised = c.initial.state == InitialState::stationary ||
                          (c.motion.angular_velocity.largest() != 0.0 &&
                           softening_is_checked(2 * mesh.nodes, of_a_sector));
  std::size_t bytes = mesh_memory(mesh) + waiting_memory(c, mesh.nodes);
  if (!sector_alone) bytes += stiffness_memory(mesh.nodes);
  if (factorised) bytes += factor_memory(harmonics ? of_a_sector : 2 * mesh.nodes);
  return bytes;
}

void demand_memory(const Case& c, std::size_t nodes, std::size_t needed) {
  const AllowedMemory allowed = allowed_memory();
  if (needed <= allowed.bytes) return;
  throw case_error(
      c, c.mesh ? "mesh.file" : std::string(largest_count(c.disk)),
      fmt::format("the mesh of {} nodes needs about {} of memory, and {} {}", nodes,
                  readable_bytes(needed), allowed.source, readable_bytes(allowed.bytes)),
      "a coarser mesh, or more memory");
}

}  // namespace rondo::study
