// SPDX-License-Identifier: BSD-3-Clause
/// @file  What reduced wheels in the plane (../ring_wheel.hpp, D = 2) and in three dimensions
/// (../../solid/solid_wheel.hpp, D = 3) do in the same way (docs/reduced.md): the steps of the
/// modes, their ledger, fields and saved numbers, and what contact nodes remember. Vectors of a
/// node have D components.
#pragma once
#include <Eigen/LU>
#include <array>
#include <complex>
#include <span>
#include <vector>

#include "rondo/rom/wheel/base/wheel_model.hpp"
#include "rondo/rom/wheel/creep/branch_strains.hpp"
#include "rondo/rom/wheel/creep/creep_memory.hpp"
#include "rondo/rom/wheel/landing.hpp"
#include "rondo/rom/wheel/saved_numbers.hpp"
#include "rondo/rom/wheel/wheel_rim.hpp"

namespace rondo::rom {

struct StepSettings {
  double dt = 0.0;                 ///< [s]
  double mass_damping = 0.0;       ///< α                                        [1/s]
  double stiffness_damping = 0.0;  ///< β                                          [s]
  double theta = 0.6;              ///< share of the new force in that on the modes
};

/// The modes of a harmonic; their coefficients y and velocities p are one after the other.
struct HarmonicModes {
  using Vector = Eigen::VectorXcd;
  using Matrix = Eigen::MatrixXcd;

  /// @param has_reply false: reply and answer stay empty
  HarmonicModes(const RingHarmonic& of, std::size_t n_branches, bool has_reply = true);

  Vector state, before;   ///< (2r) at the end of the last step, and of the one before
  Vector force, outside;  ///< (r) of the contact, φ_cᴴ λ; of the frame
  Vector held;            ///< (r) of the contact at the start of the step, its share in it
  Vector ground;          ///< (D C) sum of e^{-ikψ} λ over the sectors, over their number
  Vector contact;         ///< (D C) φ_c y without new forces
  Vector pushed, work;    ///< (r), (2r)
  BranchStrains strain;
  // fill_step() sets these for a step.
  std::complex<double> turn, lever;  ///< c = 1 + ½Δt iks; ½Δt/c                            [s]
  Matrix inverse;                    ///< (r, r) of `step`
  Matrix step, one;                  ///< (r, r) c + hD + h lever L; the identity
  Eigen::PartialPivLU<Matrix> factor;  ///< of it
  Matrix reply, answer;  ///< (r, D C) inverse φ_cᴴ; (D C, D C) share of the modes in W
  // On a rim that moves: what unit accelerations along x and of the angle do.
  Vector shift, twist;                  ///< (2r) at the end of the step
  Vector shift_contact, twist_contact;  ///< (D C) φ_c y of these
  Vector by_rate, by_place;             ///< (D C) momenta by new forces, through p and through y
};

template <int D>
struct WheelModes;

template <>
struct WheelModes<2> : HarmonicModes {
  WheelModes(const RingHarmonic& of, std::size_t n_branches, bool is_whole)
      : HarmonicModes(of, n_branches, !is_whole),
        stiff(of.squares),
        left(Vector::Zero(stiff.size())) {}

  Eigen::VectorXd stiff;  ///< (r) ω² - s²                                              [1/s²]
  double twisted = 0.0;   ///< ṡ                                                     [rad/s²]
  Vector left;            ///< (r) of the forces that stay in space; ring of one sector
};

template <>
struct WheelModes<3> : HarmonicModes {
  WheelModes(const RingHarmonic& of, std::size_t n_branches, bool is_whole)
      : HarmonicModes(of, n_branches, !is_whole),
        stiff(Matrix::Zero(force.size(), force.size())),
        answered(Vector::Zero(contact.size())),
        lift(Vector::Zero(state.size())),
        lift_contact(answered),
        by_axial(answered) {}

  Matrix stiff;     ///< (r, r) ω² - s² P + ṡ J                                      [1/s²]
  Vector answered;  ///< (3C) what new forces do to `contact`
  // What a unit acceleration along the axle does, as `shift` has it, and momenta along it by new
  // forces.
  Vector lift, lift_contact, by_axial;
};

/// A contact node near the ground.
template <class Vec>
struct NearNode {
  using Columns = std::array<Vec, 3>;

  int node = 0;
  Complex turn;  ///< e^{iψ} at the end of the step
  Complex wave;  ///< the same where the modes are, which only a rim that moves distinguishes
  Vec free;      ///< place from the center at the end of the step without new forces   [m]
  Vec place;     ///< and with them                                                     [m]
  bool candidate = false;
  // On a rim that moves: along x and y, in space along t1 and n, and of the angle.
  Vec still;      ///< `free` without accelerations beyond those of WheelRim::begin       [m]
  Columns moved;  ///< change of `place` by unit accelerations
  Columns push;   ///< momenta by a force: their products with it
  Columns reply;  ///< and the accelerations by it

  /// The place without new forces under accelerations, and what new forces do to these.
  void accelerate(const RimVector& z, const Eigen::Matrix3d& answer) noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      reply[k] = answer(row, 0) * push[0] + answer(row, 1) * push[1] + answer(row, 2) * push[2];
    }
    free = place = still + z[0] * moved[0] + z[1] * moved[1] + z[2] * moved[2];
    candidate = false;
  }
};

/// What is remembered of a contact node.
template <class Vec>
struct NodeMemory {
  Vec force;                      ///< in the frame of the sector                [N/m], [N]
  Vec filtered, filtered_before;  ///< forces that the residual answers to       [N/m], [N]
  std::array<Vec, 3> place{};     ///< from the center, newest first, fixed axes         [m]
  std::array<double, 2> gap{};    ///< newest first                                      [m]
  int known = 0;                  ///< number of places that are known

  /// At the end of a step.
  void keep(Vec now, double gap_now, Vec force_now) noexcept {
    place = {now, place[0], place[1]};
    gap = {gap_now, gap[0]};
    known = std::min(3, known + 1);
    force = force_now;
  }
  /// The distance that a node slides in a step that ends at a place: from where it was or, where it
  /// was above the ground, from where it came to it within the step. @pre known > 0
  /// @param way of the center @param bend by which its way to the ground is bent            [m]
  [[nodiscard]] Vec slid(Vec way, Vec end, bool touched, double bend) const noexcept {
    const Vec x = place[0];
    if (known < 2 || touched || gap[0] <= 0.0) return way + end - x;
    const double tau = landing(gap[0], gap[0] - gap[1] + bend, bend);
    const Vec change = x - place[1];
    const Vec second = known < 3 ? Vec{} : x - 2.0 * place[1] + place[2];
    const Vec before = tau * (change + 0.5 * second) + 0.5 * tau * tau * second;
    return (1.0 - tau) * way + end - x - before;
  }
};

/// Twice the energies of the residual: aᵀ G b of the filtered forces at the end of the step, at its
/// end and start, at its start [J/m], [J].
struct ResidualProducts {
  double end = 0.0, across = 0.0, start = 0.0;
};

template <int D>
class ReducedWheel {
 protected:
  using Vec = typename SectorRing<D>::Vec;
  using Complexes = std::complex<double>;
  using Vector = HarmonicModes::Vector;
  using Matrix = HarmonicModes::Matrix;
  using Modes = WheelModes<D>;

  /// All but the settings must outlive it. @param flat: one normal for all of the ground
  ReducedWheel(const SectorRing<D>& ring, const WheelModel& model, const StepSettings& settings,
               bool flat);
  ~ReducedWheel() = default;

  /// Sets the matrices of a step, and with them the answers of the contact nodes at its end.
  void use_spin(const WheelMotion& m);
  /// A motion that ends as this one does, with its spin all the time.
  [[nodiscard]] WheelMotion still(const WheelMotion& m) const noexcept;
  void rest_modes();
  void fill_lever(std::size_t harmonic, double spin);
  void factorise(std::size_t harmonic);
  /// The state at the end of the step from what pushes it in the middle.
  void finish_middle(std::size_t harmonic);
  void relax_modes();
  void push_by(const HarmonicModes& modes, const Vector& force, Vector& out) const;
  void move_contact();
  /// Adds a force in the frame of its sector to those on the modes. @param wave of its sector
  void push_modes(int node, Complex wave, Vec force);

  void twist_modes();
  void turn_modes(double angle);

  [[nodiscard]] double work_on_modes() const;
  void account_branches(WheelEnergy& e) const;
  [[nodiscard]] ResidualProducts account_creep(const CreepMemory& creep, WheelEnergy& e) const;
  [[nodiscard]] double account_residual(const WheelMotion& m, const ResidualProducts& of,
                                        WheelEnergy& e) const;
  /// By which a step bends the way of a node to the ground [m].
  [[nodiscard]] double bend_of(const WheelMotion& m) const noexcept {
    return 0.5 * m.spin_next * m.spin_next * model_.radius * settings_.dt * settings_.dt;
  }

  void project(double angle, std::span<const Vec> field, bool velocity);
  [[nodiscard]] Vector mean_velocity(std::size_t harmonic) const;

  [[nodiscard]] static std::size_t n_mode_numbers(const WheelModel& model) noexcept;
  void save_modes(std::vector<double>& out) const;
  void restore_modes(SavedNumbers& from);
  /// Takes the tables of a spin; matrices of another one are made by the next step.
  void restore_spin(double spin);

  [[nodiscard]] BranchStep branches(std::size_t harmonic) const noexcept {
    return {model_.branches, harmonics_[harmonic].squares, modes_[harmonic].turn, settings_.dt};
  }
  [[nodiscard]] bool is_whole() const noexcept { return ring_.n_sectors() == 1; }
  /// None of a ring of one sector, whose waves are 1.
  [[nodiscard]] std::span<const RingHarmonic> waves_of_sectors() const noexcept {
    return is_whole() ? std::span<const RingHarmonic>{} : harmonics_;
  }
  /// The angle at which the modes are at the end of the step.
  [[nodiscard]] double waves_at(const WheelMotion& m) const noexcept {
    return m.kept_spin ? m.angle + settings_.dt * *m.kept_spin : m.angle_next;
  }
  [[nodiscard]] int n_nodes() const noexcept { return static_cast<int>(sector_.size()); }
  [[nodiscard]] int sector(int node) const noexcept {
    return sector_[static_cast<std::size_t>(node)];
  }
  /// Place among the contact nodes of a sector.
  [[nodiscard]] int local(int node) const noexcept {
    return local_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] Vec arm(int node) const noexcept {
    return ring_
        .place[static_cast<std::size_t>(ring_.contact[static_cast<std::size_t>(local(node))])];
  }
  /// The node of the body that a contact node is.
  [[nodiscard]] std::size_t node_of(int node) const noexcept {
    return ring_.stiffness.node(
        static_cast<std::size_t>(ring_.contact[static_cast<std::size_t>(local(node))]),
        static_cast<std::size_t>(sector(node)));
  }

  const SectorRing<D>& ring_;
  const std::vector<RingHarmonic>& harmonics_;
  const WheelModel& model_;
  const StepSettings settings_;
  const int n_contact_;  ///< C
  const bool flat_;
  TableShares shares_{1.0};       ///< of the model's residuals, at the spin at the end of the step
  Eigen::VectorXd centrifugal_;   ///< (rows) of that spin                                    [m]
  int version_ = 1;               ///< of the spin, counted
  double residual_before_ = 0.0;  ///< energy at its start by the spin of the step before
  double spin_ = 0.0, spin_rate_ = 0.0;  ///< of the matrices, at the end of the last step
  bool has_matrices_ = false, new_table_ = false, has_shift_ = false;
  bool on_moving_rim_ = false;  ///< in the law
  std::vector<Modes> modes_;
  std::vector<int> seen_;            ///< nodes near the ground in the last step
  std::vector<std::size_t> solved_;  ///< places of the candidates among the near nodes

 private:
  /// Energy of the residual at the end of the last step.
  [[nodiscard]] virtual double residual_stored() const = 0;
  /// Finds the matrices of a harmonic. With h = ½Δt the middle of the step solves
  /// [c, -h; hL, c + hD] (y_m, p_m) = (y, p + hf).
  virtual void fill_step(std::size_t harmonic, double spin, double rate) = 0;

  void take_spin(const WheelMotion& m, double rate, double end);
  void take_tables(double spin);
  void shift_modes();
  [[nodiscard]] Matrix reply_times_step(const Modes& s, const RingHarmonic& of) const;

  std::vector<int> sector_, local_;  ///< (N C) of each contact node, so that none is divided for
};

}  // namespace rondo::rom
