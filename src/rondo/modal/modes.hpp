// SPDX-License-Identifier: BSD-3-Clause
/// @file  Frequencies and shapes of an undamped body at rest or in constant spin
/// (docs/theory.md, section 8): u = φ e^{iωt} in the co-rotating frame with
///   (K' - ω² M + 2iωs M J) φ = 0,    K' = K - s² M P                                      (8.1)
/// where K may include the stiffening by the stress of the spin. P selects the components in the
/// plane of the body, which are all components of a plane one.
#pragma once
#include <span>
#include <vector>

#include "rondo/core/field.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::modal {

/// How a mode travels in the co-rotating frame; forward: in the sense of the spin.
enum class Wave { unknown, standing, forward, backward, rigid };

/// The motion Re[(real + i imaginary) e^{(γ + iω) t}], ω >= 0.
struct Mode {
  double omega = 0.0;   ///< ω in the co-rotating frame [rad/s]
  double growth = 0.0;  ///< γ: 0 except for the rotation of a spinning free disk (8.5) [1/s]
  int diameters = -1;   ///< n: harmonic of a body of equal sectors; -1: unknown
  Wave wave = Wave::unknown;
  /// (n) φ with φᴴ M φ = 1, the largest component real [(kg/m)^(-1/2)], in space [kg^(-1/2)]
  Field real, imaginary;
};

struct Modes {
  /// All rigid-body motions first; then the lowest other modes, ascending.
  std::vector<Mode> modes;
  /// Number of negative eigenvalues of K': the softening by the spin exceeds the stiffness, and
  /// there are no modes. (Rigid-body motions of a free disk do not count.)
  int unstable = 0;
  /// Whether a count of the eigenvalues below the last one has proven that none is missing (8.4).
  bool counted = false;
  /// Largest dimension of the Krylov spaces that were used.
  int dimension = 0;
};

/// A body of N equal sectors, clamped at its inner boundary or, in the plane (D = 2), free: no
/// clamped node. In space (D = 3) it is clamped.
template <int D>
struct CyclicBody {
  const fem::SectorBlocks<D>& stiffness;
  std::span<const double> mass;     ///< (n) [kg/m], in space [kg]
  std::span<const Vec2> reference;  ///< (n) X in the plane of the body [m]

  [[nodiscard]] bool free() const noexcept {
    return static_cast<int>(stiffness.n_local()) == stiffness.nodes_per_sector;
  }
};

/// The `count` lowest modes in addition to the rigid-body motions, harmonic by harmonic; one more
/// if a pair of equal frequencies at rest would be split. @param spin s [rad/s], counter-clockwise
template <int D>
[[nodiscard]] Modes cyclic_modes(const CyclicBody<D>& body, double spin, int count);

/// Largest number of degrees of freedom of a sector with which a free disk may spin: harmonic 0 is
/// then solved as a dense unsymmetric problem (8.5).
inline constexpr std::size_t most_dofs_of_free_sector = 600;

/// A body on any mesh; some parts of it may be clamped.
struct MeshBody {
  const mesh::Mesh& mesh;
  const fem::BlockCsr& stiffness;
  std::span<const double> mass;  ///< (n) [kg/m]
};

/// Bodies without a clamped node: each has three rigid-body motions.
std::vector<int> free_bodies(const mesh::Mesh& mesh);

/// The modes on any mesh; the direction of waves is not determined. @pre spin 0 if a body is free
[[nodiscard]] Modes mesh_modes(const MeshBody& body, double spin, int count);

/// Largest number of degrees of freedom for which mesh_modes() counts (8.4): the factor for the
/// count is complex and not blocked.
inline constexpr std::size_t most_dofs_counted = 400000;

}  // namespace rondo::modal
