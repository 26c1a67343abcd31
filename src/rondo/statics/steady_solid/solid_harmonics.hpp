// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady rolling of a wheel of N equal sectors in three dimensions, harmonic by harmonic
/// (docs/wheel3d.md): as in the plane (steady/rolling_harmonics.hpp), with axial components beside.
/// It hangs on body and spin alone, and is kept for all slip angles, cambers, loads and frictions.
#pragma once
#include <Eigen/Core>
#include <array>
#include <complex>
#include <span>
#include <vector>

#include "rondo/core/vec3.hpp"
#include "rondo/statics/steady_solid/solid_layers.hpp"

namespace rondo::statics {

/// What the harmonics hang on.
struct SolidRollingBody {
  const fem::SolidSector& stiffness;
  std::span<const double> mass;     ///< (n) of every node of the mesh                      [kg]
  std::span<const Vec2> reference;  ///< (n) X                                              [m]
  std::span<const double> axial;    ///< (n) and its z                                      [m]
  std::vector<int> candidates;      ///< rows of the sector that may touch
  double spin = 0.0;                ///< s, counter-clockwise, not 0                        [rad/s]
  double mass_damping = 0.0;        ///< α                                                  [1/s]
  double stiffness_damping = 0.0;   ///< β                                                  [s]
  int samples = 1;                  ///< P >= 1 of a sector's pass: L = N P of a turn
  bool massless = false;            ///< the candidates' mass is moved to the nodes below
  std::vector<Vec3> load{};         ///< (n_local) on the rows of every sector; empty: none [N]
  int threads = 1;                  ///< same bits for any number
};

/// Accelerations that weight gives, along -y and -z of the wheel [m/s²].
struct SolidGravity {
  double down = 0.0, axial = 0.0;
};

/// The harmonics, eliminated: what forces on the candidates do to them.
class SolidHarmonics {
 public:
  using Block = Eigen::MatrixXcd;

  /// @throws std::bad_alloc. @pre as of move_masses: masses that move find a row below
  explicit SolidHarmonics(SolidRollingBody body);

  [[nodiscard]] const SolidRollingBody& body() const noexcept { return body_; }
  /// L.
  [[nodiscard]] int turn() const noexcept { return turn_; }
  [[nodiscard]] std::size_t n_candidates() const noexcept { return body_.candidates.size(); }
  /// False: an equation was singular, or left the range of the numbers, and there is nothing to
  /// solve contact with.
  [[nodiscard]] bool finite() const noexcept;
  /// X of a candidate, in the frame of its sector [m].
  [[nodiscard]] Vec3 reference(std::size_t a) const noexcept;

  /// Displacement of candidate a, `ahead` samples after a force on candidate b, in the frames of
  /// the sector at either sample [m/N].
  [[nodiscard]] Eigen::Matrix3d compliance(std::size_t a, std::size_t b, int ahead) const noexcept;
  /// Displacement of a candidate that nothing touches, in the frame of its sector [m]
  [[nodiscard]] Vec3 displacement(std::size_t a, int sample, SolidGravity gravity) const noexcept;

  /// U_k of all rows under forces on the candidates: (3 n_local, L/2 + 1), k = 0 … L/2 [m].
  /// @param force (3C, L) on each candidate at each sample, in the frame of its sector [N]
  [[nodiscard]] Block spectrum(const Eigen::MatrixXd& force, SolidGravity gravity) const;
  /// U(ψ_m) of rows of a spectrum at all samples: (rows, L) [m]. @param rate the derivative by ψ
  /// instead
  [[nodiscard]] Eigen::MatrixXd fields(Eigen::Ref<const Block> spectrum, bool rate) const;
  /// Power that damping takes, N Σ_k (ks)² U_kᴴ (α M, β K(k)) U_k, over the turn [W].
  struct Damped {
    double by_mass = 0.0, by_stiffness = 0.0;
  };
  [[nodiscard]] Damped damped(const Block& spectrum) const;
  /// Torque of the weight about the axle, counter-clockwise, as the deformation moves the body
  /// beside it, for an acceleration of 1 along -y: without forces [N·s²], and by a force on a
  /// candidate at a sample, in the frame of its sector [s²].
  [[nodiscard]] double weight_torque() const noexcept { return weight_torque_; }
  [[nodiscard]] Vec3 weight_torque(std::size_t a, int sample) const noexcept;
  /// Power of the weight along the deformation, over the turn [W].
  [[nodiscard]] double weight(const Block& spectrum, SolidGravity gravity) const;

 private:
  void move_masses();
  [[nodiscard]] RollingOrder order(int k) const noexcept;
  [[nodiscard]] Eigen::Index n_rows() const noexcept {
    return static_cast<Eigen::Index>(3 * body_.stiffness.n_local());
  }
  [[nodiscard]] std::size_t wrapped(int sample) const noexcept {
    return static_cast<std::size_t>((sample % turn_ + turn_) % turn_);
  }
  [[nodiscard]] Eigen::VectorXcd constant_load() const;
  [[nodiscard]] Eigen::VectorXcd weight_load(bool axial) const;
  void find_compliance();
  void find_bases();
  [[nodiscard]] bool keeps_transfers() const noexcept;

  SolidRollingBody body_;
  int turn_;
  std::vector<std::complex<double>> waves_;    ///< (L) e^{i 2π m/L}
  std::vector<SolidLayer> layers_;             ///< with masses as moved
  std::vector<std::vector<Block>> transfers_;  ///< (L/2 + 1); empty: made anew where needed
  std::vector<Block> surface_;                 ///< (L/2 + 1) of (3C, 3C)
  std::vector<double> history_;                ///< (L, 3C, 3C) real compliances
  double weight_torque_ = 0.0;
  std::vector<std::complex<double>> weight_by_force_;  ///< (3C) of harmonic 1: its real part
  /// (3 n_local) of what nothing touches: U_0 of spin and loads [m], U_0 and U_1 of weights of an
  /// acceleration of 1, along -z and -y [s²].
  Eigen::VectorXcd constant_, leaning_, turning_;
};

}  // namespace rondo::statics
