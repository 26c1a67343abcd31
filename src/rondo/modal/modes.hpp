// SPDX-License-Identifier: BSD-3-Clause
/// @file  Frequencies and shapes of a body at rest or in constant spin, without damping
/// (docs/theory.md, section 8): u = φ e^{iωt} in the turning frame with
///   (K' - ω² M + 2iωs M J) φ = 0,    K' = K - s² M                                        (8.1)
/// where K may hold the stiffening by the stress of the spin.
#pragma once
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::modal {

/// How a mode goes round in the turning frame; forward: in the sense of the spin.
enum class Wave { unknown, standing, forward, backward, rigid };

/// The motion Re[(real + i imaginary) e^{(γ + iω) t}], ω >= 0.
struct Mode {
  double omega = 0.0;   ///< ω in the turning frame [rad/s]
  double growth = 0.0;  ///< γ: 0 but for the rotation of a spinning free disk (8.5) [1/s]
  int diameters = -1;   ///< n: harmonic of a body of equal sectors; -1: unknown
  Wave wave = Wave::unknown;
  std::vector<Vec2> real, imaginary;  ///< (n) φ, φᴴ M φ = 1, largest component real [(kg/m)^(-1/2)]
};

struct Modes {
  /// Rigid-body motions first, all of them; then the lowest others, ascending.
  std::vector<Mode> modes;
  /// Negative eigenvalues of K': the spin softens more than the body is stiff, and there are no
  /// modes. (Rigid-body motions of a free disk do not count.)
  int unstable = 0;
  /// Whether a count of the eigenvalues below the last one has shown that none is missing (8.4).
  bool counted = false;
  /// Largest dimension of the spaces in which the modes were sought.
  int dimension = 0;
};

/// A body of N equal sectors, clamped at its inner boundary, or free (no node is clamped).
struct CyclicBody {
  const fem::SectorStiffness& stiffness;
  std::span<const double> mass;     ///< (n) [kg/m]
  std::span<const Vec2> reference;  ///< (n) X [m]

  [[nodiscard]] bool free() const noexcept {
    return static_cast<int>(stiffness.n_local()) == stiffness.nodes_per_sector;
  }
};

/// The `count` lowest modes besides the rigid-body motions, harmonic by harmonic; one more where a
/// pair of equal frequencies at rest would be cut. @param spin s [rad/s], counter-clockwise
[[nodiscard]] Modes cyclic_modes(const CyclicBody& body, double spin, int count);

/// Degrees of freedom of a sector up to which a free disk may spin: harmonic 0 is then solved as a
/// dense problem without symmetry (8.5).
inline constexpr std::size_t most_dofs_of_free_sector = 600;

/// Any mesh, some of its bodies clamped.
struct MeshBody {
  const mesh::Mesh& mesh;
  const fem::BlockCsr& stiffness;
  std::span<const double> mass;  ///< (n) [kg/m]
};

/// Bodies of which no node is clamped: each has three rigid-body motions.
std::vector<int> free_bodies(const mesh::Mesh& mesh);

/// The same on any mesh; waves are not told apart. @pre spin 0 where there are free bodies
[[nodiscard]] Modes mesh_modes(const MeshBody& body, double spin, int count);

/// Degrees of freedom up to which mesh_modes() counts (8.4): the factor of the count is complex and
/// not blocked.
inline constexpr std::size_t most_dofs_counted = 400000;

}  // namespace rondo::modal
