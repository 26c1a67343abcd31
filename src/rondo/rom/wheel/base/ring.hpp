// SPDX-License-Identifier: BSD-3-Clause
/// @file  A ring of N equal sectors whose contact nodes have no mass (docs/reduced.md). A node has
/// D components in the frame of its sector: radial and tangential in the plane, where masses and
/// forces are per metre of width; in three dimensions axial as well.
#pragma once
#include <Eigen/Core>
#include <span>
#include <type_traits>
#include <vector>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/sector_stiffness.hpp"

namespace rondo::rom {

template <int D>
struct SectorRing {
  using Vec = std::conditional_t<D == 2, Vec2, Vec3>;

  const fem::SectorBlocks<D>& stiffness;
  std::vector<int> contact;  ///< (C) rows of the nodes that may touch
  std::vector<double> mass;  ///< (n_local) 0 at those                        [kg/m], [kg]
  std::vector<Vec> place;    ///< (n_local) X, in the frame of the sector             [m]
  std::vector<Vec> load{};   ///< (n_local) on the rows of every sector; empty: none  [N]
  int threads = 1;           ///< same bits for any number

  [[nodiscard]] int n_sectors() const noexcept { return stiffness.n_sectors; }
  [[nodiscard]] Eigen::Index n_rows() const noexcept {
    return static_cast<Eigen::Index>(D * stiffness.n_local());
  }
  [[nodiscard]] Eigen::Index n_contact() const noexcept {
    return static_cast<Eigen::Index>(D * contact.size());
  }
};

using Ring = SectorRing<2>;
using SolidRing = SectorRing<3>;

/// (rows) The constant load of a ring in three dimensions.
[[nodiscard]] Eigen::VectorXcd load_of(const SolidRing& ring);

/// @param mass, reference, axial (n) of the nodes of the body; masses of contact nodes are 0
/// @param contact nodes of the body, the same in every sector
/// @pre each contact node couples with a row that has mass
[[nodiscard]] Ring make_ring(const fem::SectorStiffness& stiffness, std::span<const double> mass,
                             std::span<const Vec2> reference, std::span<const int> contact);
[[nodiscard]] SolidRing make_solid_ring(const fem::SolidSector& stiffness,
                                        std::span<const double> mass,
                                        std::span<const Vec2> reference,
                                        std::span<const double> axial,
                                        std::span<const int> contact);

}  // namespace rondo::rom
