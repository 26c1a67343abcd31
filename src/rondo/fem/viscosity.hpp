// SPDX-License-Identifier: BSD-3-Clause
/// @file  Linear viscoelasticity: a stiffness in parallel with Maxwell branches, whose stress
/// relaxes. At the frequency ω a material has its modulus of slow strains times
/// g(iω) = 1 + Σ r iωτ/(1 + iωτ) (docs/rolling-resistance.md).
#pragma once
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/rubber.hpp"
#include "rondo/fem/sector_stiffness.hpp"

namespace rondo::fem {

/// The branches of a material: those of its law if it is rubber.
[[nodiscard]] const std::vector<ViscousBranch>& branches_of(const Material& material) noexcept;

/// g(iω) - 1. @param omega ω; below 0 the conjugate of that above [rad/s]
[[nodiscard]] std::complex<double> branch_modulus(std::span<const ViscousBranch> branches,
                                                  double omega) noexcept;
/// tan δ = Im g/Re g, the share of the energy lost in a radian of a harmonic strain.
[[nodiscard]] double loss_factor(std::span<const ViscousBranch> branches, double omega) noexcept;

/// A band of frequencies [Hz].
struct Band {
  double low = 0.0, high = 0.0;
};
/// Branches whose tan δ is that of the band as nearly as can be, the times equally spaced in their
/// logarithms: one more than 5/4 of the decades, 3 to 8. By least squares; times whose moduli would
/// be negative are left out.
/// @pre 0 < tangent < 1, 0 < low < high
[[nodiscard]] std::vector<ViscousBranch> branches_of(double tangent, Band band);
/// Largest |tan δ/tangent - 1| within the band.
[[nodiscard]] double fit_error(std::span<const ViscousBranch> branches, double tangent, Band band);

/// Elements whose branches have one stiffness times their relative moduli.
/// @tparam Stiffness SectorBlocks<2 or 3> of a sector, BlockCsr of a plane body
template <class Stiffness>
struct ViscousPart {
  std::string name;     ///< of the region; "material": of all that is in no region
  Stiffness stiffness;  ///< rows as those of the body's [N/m²], in space [N/m]
  std::vector<ViscousBranch> branches;
};

/// What makes a part: one material, or all with the same branches.
enum class ViscousBy { material, branches };

/// The parts of a body, in the order of its materials; of several the name is that of the first.
/// Branches of rubber resist changes of shape alone, those of linear materials changes of volume
/// likewise. The stiffness of each is about the shape of the mesh, in which all branches are
/// relaxed.
/// @param materials one for each region of the mesh, rubber with its law
template <class Stiffness>
[[nodiscard]] std::vector<ViscousPart<Stiffness>> viscous_parts(const mesh::Mesh& mesh,
                                                                std::span<const Material> materials,
                                                                ViscousBy by);

/// K and all branches: the stiffness of sudden strains.
/// @pre K has blocks where the parts have blocks that are not 0
template <int C>
[[nodiscard]] SectorBlocks<C> with_branches(const SectorBlocks<C>& k,
                                            std::span<const ViscousPart<SectorBlocks<C>>> parts);

}  // namespace rondo::fem
