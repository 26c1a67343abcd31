// SPDX-License-Identifier: BSD-3-Clause
/// @file  Any mesh that is held at its rim as a ring of one sector (docs/reduced.md): its only
/// harmonic is 0, so that the frame of the sector is the co-rotating one. Modes and compliance are
/// found by sparse factorisations.
#pragma once
#include <span>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/mesh/mesh.hpp"
#include "rondo/rom/wheel/ring_harmonics.hpp"

namespace rondo::rom {

struct WholeMesh {
  const mesh::Mesh& mesh;
  const fem::BlockCsr& stiffness;  ///< of the free nodes
  std::span<const int> free;       ///< ascending
};

/// K with all free nodes as the rows of one sector. A ring of it works with ring_modes() and
/// ring_residual() too, which are dense.
[[nodiscard]] fem::SectorStiffness one_sector(const WholeMesh& whole);

/// Finds the modes of a mesh, as ring_modes() finds those of a ring. It returns none where K is not
/// positive definite. @param ring of one_sector()
[[nodiscard]] std::vector<RingHarmonic> whole_modes(const Ring& ring, const WholeMesh& whole,
                                                    const ModeChoice& choice);

/// Finds the static residual of a mesh, which has `by_contact` in place of `fields`. Where K - s²M
/// is not positive definite a mesh has no residual: `made_static` is then {0}, and all else is
/// empty.
[[nodiscard]] RingResidual whole_residual(const Ring& ring, const WholeMesh& whole,
                                          std::span<const RingHarmonic> harmonics,
                                          double spin_squared);

}  // namespace rondo::rom
