// SPDX-License-Identifier: BSD-3-Clause
/// @file  The harmonics of a wheel of N equal sectors in three dimensions whose contact nodes have
/// no mass (docs/reduced.md): what wheel/ring_harmonics.hpp has of a disk, with a third component,
/// along the axle. Matrices of a harmonic are sparse here, because a section has many nodes.
#pragma once
#include <span>
#include <vector>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/rom/wheel/ring_harmonics.hpp"

namespace rondo::rom {

struct SolidRing {
  const fem::SolidSector& stiffness;
  std::vector<int> contact;  ///< (C) rows of the nodes that may touch
  std::vector<double> mass;  ///< (n_local) 0 at those                                   [kg]
  std::vector<Vec3> place;   ///< (n_local) X, in the frame of the sector                 [m]
  std::vector<Vec3> load;    ///< (n_local) on the rows of every sector; empty: none      [N]
  int threads = 1;           ///< same bits for any number

  [[nodiscard]] int n_sectors() const noexcept { return stiffness.n_sectors; }
  [[nodiscard]] Eigen::Index n_rows() const noexcept {
    return static_cast<Eigen::Index>(3 * stiffness.n_local());
  }
  [[nodiscard]] Eigen::Index n_contact() const noexcept {
    return static_cast<Eigen::Index>(3 * contact.size());
  }
};

/// @param mass, reference, axial (n) of the nodes of the body; masses of contact nodes are 0
/// @param contact nodes of the body, the same in every sector
[[nodiscard]] SolidRing make_solid_ring(const fem::SolidSector& stiffness,
                                        std::span<const double> mass,
                                        std::span<const Vec2> reference,
                                        std::span<const double> axial,
                                        std::span<const int> contact);

/// The harmonics that have modes, ascending; as ring_modes().
/// @throws std::bad_alloc
[[nodiscard]] std::vector<RingHarmonic> solid_modes(const SolidRing& ring,
                                                    const ModeChoice& choice);

}  // namespace rondo::rom
