// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a case needs of the machine, told before anything is built.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "rondo/case/case.hpp"

namespace rondo::study {

/// Above this size the check of spin softening, a Cholesky factorisation, is left out...
inline constexpr std::size_t softening_check_dofs = 500000;
/// ... unless the body falls apart into harmonics of this size at the most.
inline constexpr std::size_t softening_check_harmonic_dofs = 20000;

/// Whether the check is made. `harmonic_dofs`: as many as a sector has; 0: not by harmonics.
bool softening_is_checked(std::size_t dofs, std::size_t harmonic_dofs) noexcept;

/// What memory depends on.
struct MeshSize {
  std::size_t nodes = 0, cells = 0;
  std::size_t clamped = 0;  ///< nodes
  std::size_t sectors = 0;  ///< equal ones; 0: none
};

MeshSize size_of(const mesh::Mesh& mesh) noexcept;
/// Of the mesh that mesh::make_disk would make.
MeshSize size_of(const mesh::Disk& disk) noexcept;

/// Memory of a run at its largest, while K is assembled or factorised; an estimate [B].
std::size_t estimated_memory(const Case& c, const MeshSize& mesh) noexcept;

/// Memory of `rondo modes` at its largest; an estimate [B]. @param shapes modes of all spins
/// @param at_once modes of one spin
std::size_t estimated_modes_memory(const MeshSize& mesh, std::size_t shapes,
                                   std::size_t at_once) noexcept;

}  // namespace rondo::study
