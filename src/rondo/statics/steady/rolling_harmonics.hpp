// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady rolling of a body of N equal sectors, harmonic by harmonic (docs/theory.md, 11.1,
/// and docs/wheel3d.md): every sector repeats, a little later, what the one before did, so that the
/// history of one sector is that of all, U(ψ) = Σ_k U_k e^{ikψ}, ψ = φ_j + s t, and d/dt = s d/dψ.
/// They depend on body and spin alone, and serve all heights, speeds, slip angles, cambers, loads
/// and frictions. With D = 2, in the plane, forces are per metre of width.
/// Source: the steady-state transport of Nackenhorst, CMAME 193 (2004) 4299, here in the harmonics
/// of the sectors.
#pragma once
#include <Eigen/Core>
#include <complex>
#include <span>
#include <type_traits>
#include <vector>

#include "rondo/statics/steady/rolling_layers.hpp"

namespace rondo::statics {

/// Which harmonics k accelerate the masses: all; those that N sectors resolve as waves around the
/// body, k <= N/2; none, as if the body rolled infinitely slowly at the shape of its spin. A higher
/// one has the stiffness of the wave k mod N at the frequency ks of a node's pass, and can resonate
/// where no wave of the body does.
enum class RollingInertia { all, waves, none };

/// What the harmonics depend on.
template <int D>
struct RollingBody {
  using Vec = std::conditional_t<D == 2, Vec2, Vec3>;

  const fem::SectorBlocks<D>& stiffness;
  std::span<const double> mass;     ///< (n) of every node of the mesh                      [kg]
  std::span<const Vec2> reference;  ///< (n) X                                              [m]
  std::span<const double> axial{};  ///< (n) and its z, in space                            [m]
  std::vector<int> candidates;      ///< rows of the sector that may touch
  double spin = 0.0;  ///< s, counter-clockwise; 0, it stands, without inertia alone       [rad/s]
  double rest_spin = 0.0;          ///< at which it is in equilibrium without the ground   [rad/s]
  double mass_damping = 0.0;       ///< α                                                  [1/s]
  double stiffness_damping = 0.0;  ///< β                                                  [s]
  std::span<const fem::ViscousPart<fem::SectorBlocks<D>>>
      viscous{};          ///< with K's slow stiffness in K
  int samples = 1;        ///< P >= 1 of a sector's pass: L = N P of a turn
  bool massless = false;  ///< the candidates' mass is moved to the nodes below
  RollingInertia inertia = RollingInertia::all;
  std::vector<Vec> load{};  ///< (n_local) on the rows of every sector; empty: none [N]
  int threads = 1;          ///< same bits for any number

  /// X of a row's node in sector 0 [m].
  [[nodiscard]] NodeVector<D> place(int row) const noexcept {
    const std::size_t node = stiffness.node(static_cast<std::size_t>(row), 0);
    if constexpr (D == 2)
      return node_vector(reference[node]);
    else
      return node_vector(Vec3{reference[node], axial[node]});
  }
};

/// Accelerations that weight gives, along -y and, in space, -z of the wheel [m/s²].
struct RollingGravity {
  double down = 0.0, axial = 0.0;
};

/// The harmonics eliminated from the rim outwards: what forces on the candidates do to them.
template <int D>
class RollingHarmonics {
 public:
  using Block = Eigen::MatrixXcd;

  /// @throws std::bad_alloc. @pre masses that move find a row below
  explicit RollingHarmonics(RollingBody<D> body);

  [[nodiscard]] const RollingBody<D>& body() const noexcept { return body_; }
  /// L.
  [[nodiscard]] int turn() const noexcept { return turn_; }
  [[nodiscard]] std::size_t n_candidates() const noexcept { return body_.candidates.size(); }
  /// False: an equation was singular, or left the range of the numbers, and there is nothing to
  /// solve contact with.
  [[nodiscard]] bool finite() const noexcept;
  /// X of a candidate, in the frame of its sector [m].
  [[nodiscard]] NodeVector<D> reference(std::size_t a) const noexcept {
    return body_.place(body_.candidates[a]);
  }
  /// A sample of a turn, from 0 on.
  [[nodiscard]] std::size_t wrapped(int sample) const noexcept {
    return static_cast<std::size_t>((sample % turn_ + turn_) % turn_);
  }

  /// Displacement of candidate a, `ahead` samples after a force on candidate b, in the frames of
  /// the sector at either sample [m/N].
  [[nodiscard]] NodeMatrix<D> compliance(std::size_t a, std::size_t b, int ahead) const noexcept;
  /// Displacement of a candidate that nothing touches, in the frame of its sector [m].
  [[nodiscard]] NodeVector<D> displacement(std::size_t a, int sample,
                                           RollingGravity gravity) const noexcept;

  /// U_k of all rows under forces on the candidates: (D n_local, L/2 + 1), k = 0 … L/2 [m].
  /// @param force (D C, L) on each candidate at each sample, in the frame of its sector [N]
  [[nodiscard]] Block spectrum(const Eigen::MatrixXd& force, RollingGravity gravity) const;
  /// The rows of the candidates, (D C, L/2 + 1).
  [[nodiscard]] Block on_candidates(const Block& spectrum) const;
  /// Those of a field, (D C, L).
  [[nodiscard]] Eigen::MatrixXd on_candidates(const Eigen::MatrixXd& field) const;
  /// Makes response() ready: factors of all harmonics, factors_memory() bytes.
  void keep_factors();
  [[nodiscard]] std::size_t factors_memory() const noexcept;
  /// U_k of all rows under forces on all rows, with neither spin nor weight: as spectrum() has it.
  /// @param force (D n_local, L) in the frames of the sectors [N]. @pre keep_factors()
  [[nodiscard]] Block response(const Eigen::MatrixXd& force) const;
  /// U(ψ_m + χ) of rows of a spectrum at all samples: (rows, L) [m]. @param rate the derivative by
  /// ψ instead
  [[nodiscard]] Eigen::MatrixXd fields(Eigen::Ref<const Block> spectrum, double chi,
                                       bool rate) const;
  /// Power that damping takes, N Σ_k (ks)² U_kᴴ (α M, β K(k)) U_k, and each viscous part, N Σ_k ks
  /// Im h_p U_kᴴ V_p(k) U_k, over the turn [W].
  struct Damped {
    double by_mass = 0.0, by_stiffness = 0.0;
    std::vector<double> by_viscosity{};
  };
  [[nodiscard]] Damped damped(const Block& spectrum) const;
  /// Torque of the weight about the axle, counter-clockwise, as the deformation moves the body
  /// beside it, for an acceleration of 1 along -y: without forces [N·s²], and by a force on a
  /// candidate at a sample, in the frame of its sector [s²].
  [[nodiscard]] double weight_torque() const noexcept { return weight_torque_; }
  [[nodiscard]] NodeVector<D> weight_torque(std::size_t a, int sample) const noexcept;
  /// Power of the weight along the deformation, over the turn [W].
  [[nodiscard]] double weight(const Block& spectrum, RollingGravity gravity) const;

 private:
  [[nodiscard]] std::vector<Eigen::Index> candidate_rows() const;
  void move_masses();
  [[nodiscard]] bool has_inertia(int k) const noexcept;
  [[nodiscard]] RollingOrder order(int k) const noexcept;
  [[nodiscard]] Eigen::Index n_rows() const noexcept {
    return static_cast<Eigen::Index>(D * body_.stiffness.n_local());
  }
  [[nodiscard]] Block transformed(const Eigen::MatrixXd& field) const;
  [[nodiscard]] Eigen::VectorXcd constant_load() const;
  [[nodiscard]] Eigen::VectorXcd weight_load(bool axial) const;
  /// How the entries of a compliance at all harmonics, or samples, lie: in the plane, where there
  /// are few, one entry after the other, in space one harmonic after the other.
  struct Strides {
    std::size_t entry, place;
  };
  static constexpr Strides strides(std::size_t entries, std::size_t places) noexcept {
    return D == 2 ? Strides{places, 1} : Strides{1, entries};
  }
  void find_compliance();
  void find_bases();
  void follow_candidates(int k, const Eigen::VectorXcd& surface,
                         Eigen::Ref<Eigen::VectorXcd> u) const;

  RollingBody<D> body_;
  int turn_;
  std::vector<std::complex<double>> waves_;  ///< (L) e^{i 2π m/L}
  RollingLayers<D> layers_;                  ///< with masses as moved
  /// (L/2 + 1, transfer_size); empty: they are too large, and are made anew where they are needed
  std::vector<std::complex<double>> transfers_;
  std::vector<RollingFactors<D>> factors_;  ///< (L/2 + 1), if they are kept
  std::vector<Block> surface_;              ///< (L/2 + 1) of (D C, D C)
  std::vector<double> history_;             ///< (L, D C, D C) real compliances, by strides()
  double weight_torque_ = 0.0;
  std::vector<std::complex<double>> weight_by_force_;  ///< (D C) of harmonic 1: its real part
  /// (D n_local) of what nothing touches: U_0 of spin and loads [m], U_0 and U_1 of weights of an
  /// acceleration of 1, along -z and -y [s²]. The weight along -z is of space alone.
  Eigen::VectorXcd constant_, leaning_, turning_;
};

}  // namespace rondo::statics
