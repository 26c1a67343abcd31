// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady rolling of a body of N equal sectors, harmonic by harmonic (docs/theory.md, 11.1):
/// every sector repeats, a little later, what the one before did, so that the history of one sector
/// is that of all, U(ψ) = Σ_k U_k e^{ikψ}, ψ = φ_j + s t, and d/dt = s d/dψ.
/// Source: the steady-state transport of Nackenhorst, CMAME 193 (2004) 4299, here in the harmonics
/// of the sectors.
#pragma once
#include <Eigen/Core>
#include <complex>
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/statics/steady/rolling_layers.hpp"

namespace rondo::statics {

/// What the harmonics hang on.
struct RollingBody {
  const fem::SectorStiffness& stiffness;
  std::span<const double> mass;     ///< (n) of every node of the mesh                     [kg/m]
  std::span<const Vec2> reference;  ///< (n) X                                             [m]
  std::vector<int> candidates;      ///< rows of the sector that may touch, all of its last layer
  double spin = 0.0;                ///< s, counter-clockwise, not 0                        [rad/s]
  double mass_damping = 0.0;        ///< α                                                  [1/s]
  double stiffness_damping = 0.0;   ///< β                                                  [s]
  int samples = 8;                  ///< P >= 1 of a sector's pass: L = N P of a turn
  bool massless = true;             ///< the candidates' mass is moved to the nodes below
  double gravity = 0.0;             ///< g, downwards                                     [m/s²]
  std::vector<Vec2> load{};         ///< (n_local) on the rows of every sector; empty: none [N/m]
  int threads = 1;                  ///< same bits for any number
};

/// The harmonics eliminated from the rim outwards: what forces on the candidates do to them.
class RollingHarmonics {
 public:
  using Block = Eigen::MatrixXcd;

  /// @throws std::bad_alloc. @pre every candidate has a node of the layer below in its sector
  explicit RollingHarmonics(RollingBody body);

  [[nodiscard]] const RollingBody& body() const noexcept { return body_; }
  /// L.
  [[nodiscard]] int turn() const noexcept { return turn_; }
  [[nodiscard]] std::size_t n_candidates() const noexcept { return body_.candidates.size(); }
  /// False: an equation was singular, or left the range of the numbers, and there is nothing to
  /// solve contact with.
  [[nodiscard]] bool finite() const noexcept;

  /// Displacement of candidate a, `ahead` samples after a force on candidate b, in the frames of
  /// the sector at either sample; 2×2, of (x, y) [m²/N].
  [[nodiscard]] Eigen::Matrix2d compliance(std::size_t a, std::size_t b, int ahead) const noexcept;
  /// Place of a candidate that nothing touches, in the frame of its sector: X, and what spin,
  /// gravity and loads do to it [m]
  [[nodiscard]] Vec2 place(std::size_t a, int sample) const noexcept;

  /// U_k of all rows under forces on the candidates: (2 n_local, L/2 + 1), k = 0 … L/2 [m].
  /// @param force (2C, L) on each candidate at each sample, in the frame of its sector [N/m]
  [[nodiscard]] Block spectrum(const Eigen::MatrixXd& force) const;
  /// U(ψ_m + χ) of rows of a spectrum at all samples: (rows, L) [m]. @param rate the derivative by
  /// ψ instead
  [[nodiscard]] Eigen::MatrixXd fields(Eigen::Ref<const Block> spectrum, double chi,
                                       bool rate) const;
  /// Power that damping takes, N Σ_k (ks)² U_kᴴ (α M, β K(k)) U_k, over the turn [W/m].
  struct Damped {
    double by_mass = 0.0, by_stiffness = 0.0;
  };
  [[nodiscard]] Damped damped(const Block& spectrum) const;
  /// Torque of the weight about the center, counter-clockwise, as the deformation moves the body
  /// beside it: without forces [N], and by a force on a candidate at a sample, in the frame of its
  /// sector [m].
  [[nodiscard]] double weight_torque() const noexcept { return weight_torque_; }
  [[nodiscard]] Vec2 weight_torque(std::size_t a, int sample) const noexcept;
  /// Power of the weight along the deformation, over the turn [W/m].
  [[nodiscard]] double weight(const Block& spectrum) const;

 private:
  void find_candidates();
  void move_masses();
  [[nodiscard]] RollingOrder order(int k) const noexcept;
  [[nodiscard]] Eigen::Index n_rows() const noexcept {
    return layers_.back().first + layers_.back().size;
  }
  [[nodiscard]] Eigen::VectorXcd load_of(int k) const;
  void find_compliance();
  void find_weight_torque();

  RollingBody body_;
  int turn_;
  std::vector<std::complex<double>> waves_;      ///< (L) e^{i 2π m/L}
  std::vector<RollingLayer> layers_;             ///< with masses as moved
  std::vector<Eigen::Index> local_;              ///< (candidates) first number in the last layer
  std::vector<std::complex<double>> transfers_;  ///< (L/2 + 1, transfer_size)
  std::vector<Block> surface_;   ///< (L/2 + 1) of (last layer, 2C): it by forces on candidates
  std::vector<double> history_;  ///< (2C, 2C, L) real compliances
  double weight_torque_ = 0.0;
  std::vector<std::complex<double>> weight_by_force_;  ///< (2C) of harmonic 1: its real part
  Block base_;  ///< (2 n_local, 2) U_0 and U_1 of what nothing touches                    [m]
};

}  // namespace rondo::statics
