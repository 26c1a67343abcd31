// SPDX-License-Identifier: BSD-3-Clause
/// @file  Memory that a case needs at its largest, told before it is taken: estimates, fitted to
/// runs of 10⁴ to 4·10⁵ degrees of freedom (docs/performance.md).
#pragma once
#include <cstddef>

#include "rondo/case/case.hpp"

namespace rondo::study {

/// Memory of the program, mesh, fields, a checkpoint and files: the least of any analysis [B].
std::size_t mesh_memory(std::size_t nodes) noexcept;
/// Triangles with a mean dilatation at the nodes couple a node with neighbours of neighbours.
bool has_wide_rows(const Case& c, const mesh::Mesh& mesh) noexcept;
/// Memory of the assembled stiffness, held twice while it is assembled [B].
std::size_t stiffness_memory(std::size_t nodes, bool wide_rows) noexcept;
/// Memory of a Cholesky factor of a plane mesh, which fills in about n log2 n [B].
std::size_t factor_memory(std::size_t dofs, bool wide_rows) noexcept;

/// Memory of cells of rubber, their branches, and the matrices that come with them; 0: none [B].
std::size_t rubber_memory(const Case& c, const mesh::Mesh& mesh);

/// Memory of motion in time; large disks go without an assembled stiffness [B].
std::size_t motion_memory(const Case& c, const mesh::Mesh& mesh);

/// @param needed [B] @throws InputError at the key that makes the mesh so large: this process may
/// not take that much memory
void demand_memory(const Case& c, std::size_t nodes, std::size_t needed);

}  // namespace rondo::study
