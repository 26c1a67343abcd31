// SPDX-License-Identifier: BSD-3-Clause
/// @file  The harmonics of a ring of N equal sectors whose contact nodes have no mass
/// (docs/reduced.md): modes, and what forces on the contact nodes do that no mode does. Vectors
/// have the components of each node of a sector; u_j = Re Σ_k w_k e^{ikψ_j} U_k with ψ_j = φ_j + θ,
/// w_0 = 1 and w_k = 2. U_k stands still where the displacement stands still in space. Forces are
/// per metre of width.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "rondo/rom/wheel/base/ring.hpp"
#include "rondo/rom/wheel/creep/creep.hpp"

namespace rondo::rom {

/// K(k) = Σ e^{ikφ shift} K_shift.
[[nodiscard]] Eigen::MatrixXcd stiffness_of(const Ring& ring, int k);

/// The modes of one harmonic, φᴴ M φ = 1.
struct RingHarmonic {
  int k = 0;
  Eigen::VectorXd squares;       ///< (r) Λ: ω²                                      [1/s²]
  Eigen::MatrixXcd shapes;       ///< (rows, r) φ                                [1/√(kg/m)]
  Eigen::MatrixXcd contact;      ///< (2C, r) φ_c
  Eigen::MatrixXcd coriolis;     ///< (r, r) J_k = φᴴ M J φ
  Eigen::VectorXcd reference;    ///< (r) φᴴ M X; harmonic 0
  Eigen::VectorXcd turned;       ///< (r) φᴴ M J X; harmonic 0
  Eigen::VectorXcd translation;  ///< (r) l = φᵀ M (1, -i of each node); harmonic 1, of a
                                 ///< ring of one sector harmonic 0
  // A ring in three dimensions has these too:
  Eigen::MatrixXcd planar{};  ///< (r, r) φᴴ M P φ, with P the radial and tangential components
  Eigen::VectorXcd axial{};   ///< (r) φᴴ M (0, 0, 1 of each node); harmonic 0
  Eigen::VectorXcd tilt{};    ///< (r) φᴴ M (0, 0, x + iy of each node); harmonic 1
  Eigen::VectorXcd load{};    ///< (r) φᴴ of the constant load; harmonic 0

  [[nodiscard]] double weight() const noexcept { return k == 0 ? 1.0 : 2.0; }
};

/// @param shapes (rows, r) φᴴ M φ = 1, with (r) squares ω²
[[nodiscard]] RingHarmonic make_harmonic(const Ring& ring, int k, Eigen::VectorXd squares,
                                         Eigen::MatrixXcd shapes);

/// Modes of a harmonic in the span of shapes of the nodes with mass, by Rayleigh and Ritz; contact
/// nodes follow these statically. @param shapes (inner rows, r) M^½ φ, orthonormal
[[nodiscard]] RingHarmonic ritz_harmonic(const Ring& ring, int k, const Eigen::MatrixXcd& shapes);

/// Rows of the nodes with mass, ascending.
[[nodiscard]] std::vector<Eigen::Index> inner_rows(const Ring& ring);

/// How many modes are taken: the lowest over all harmonics 0 <= k < N/2, where a mode of k > 0
/// counts for two.
struct ModeChoice {
  int wanted = 0;          ///< at least so many, where there are
  double highest = 1e300;  ///< and no higher angular frequency, but `fewest` at least  [rad/s]
  int fewest = 0;
};

/// How many modes of each harmonic are taken.
/// @param frequencies of the harmonics, those of each one ascending [rad/s]
[[nodiscard]] std::vector<Eigen::Index> take_lowest(std::span<const Eigen::VectorXd> frequencies,
                                                    const ModeChoice& choice);

/// The harmonics that have modes, ascending.
[[nodiscard]] std::vector<RingHarmonic> ring_modes(const Ring& ring, const ModeChoice& choice);

/// The modes of harmonic k; null: it has none.
[[nodiscard]] const RingHarmonic* find_harmonic(std::span<const RingHarmonic> harmonics, int k);

/// Number of modes in the harmonics; a mode of k > 0 counts for two, as in ModeChoice.
[[nodiscard]] int count_modes(std::span<const RingHarmonic> harmonics) noexcept;

/// Angular frequencies of a harmonic, ascending, all of them [rad/s].
[[nodiscard]] Eigen::VectorXd frequencies_of(const Ring& ring, int k);

/// A force pattern that stands still in space meets the inertia that the modes left out have
/// under it; of a static residual it meets their stiffness alone.
enum class ResidualForm { convected, still };

/// What forces on the contact nodes do beyond the modes, for one spin.
struct RingResidual {
  int n_sectors = 0;
  Eigen::Index size = 0;  ///< 2C
  std::vector<double>
      blocks;  ///< (N, 2C, 2C) column-major: G[i - j], node i by a force on j [m²/N]
  std::vector<double> fields;    ///< (N, 2C, rows) the same of all rows of a sector       [m²/N]
  Eigen::VectorXd centrifugal;   ///< (rows) displacement by the spin beyond the modes         [m]
  std::vector<int> made_static;  ///< harmonics in which the convected form has no meaning
  /// (2C) forces -> (rows) displacement: of a mesh without sectors (whole_mesh.hpp), in place of
  /// `fields`.
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> by_contact;

  [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> block(int lag) const noexcept {
    const int d = (lag % n_sectors + n_sectors) % n_sectors;
    return {blocks.data() + static_cast<Eigen::Index>(d) * size * size, size, size};
  }
};

/// @param spin_squared s² [1/s²]
[[nodiscard]] RingResidual ring_residual(const Ring& ring, std::span<const RingHarmonic> harmonics,
                                         double spin_squared, ResidualForm form);

/// The same of a viscous body, whose K is that of slow strains: `at_once` answers to the first term
/// of the creep, `later` to all others, u = G_0 j_0 λ_0 + G_1 Σ j_b λ_b. A pattern of forces that
/// stands still in space then has the answer of K g(iks), inertia included, exactly.
struct CreepResidual {
  RingResidual at_once, later;
  std::vector<int> one_matrix;  ///< harmonics in which both are one matrix, and the answer is
                                ///< exact but for what their inertia changes of the phase
};
/// @param creep of creep_terms(), at least two
[[nodiscard]] CreepResidual creep_residual(const Ring& ring,
                                           std::span<const RingHarmonic> harmonics,
                                           double spin_squared, std::span<const CreepTerm> creep);

}  // namespace rondo::rom
