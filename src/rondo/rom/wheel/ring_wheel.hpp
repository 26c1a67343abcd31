// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rolling ring in a few modes whose contact is exact (docs/reduced.md): modes carry the
/// dynamics, the compliance of the contact nodes carries all the rest, contact nodes have no mass
/// and touch the ground where they are. All in the plane, per metre of width.
#pragma once
#include <Eigen/LU>
#include <array>
#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "rondo/contact/coupled/block.hpp"
#include "rondo/contact/ground.hpp"
#include "rondo/core/vec2.hpp"
#include "rondo/rom/wheel/creep/branch_strains.hpp"
#include "rondo/rom/wheel/creep_field.hpp"
#include "rondo/rom/wheel/gap_law.hpp"
#include "rondo/rom/wheel/left_behind.hpp"
#include "rondo/rom/wheel/ring_harmonics.hpp"
#include "rondo/rom/wheel/sliding_memory.hpp"
#include "rondo/rom/wheel/wheel_model.hpp"
#include "rondo/rom/wheel/wheel_outcome.hpp"
#include "rondo/rom/wheel/wheel_rim.hpp"

namespace rondo::rom {

/// Which distance a node slides in a step.
enum class SlipRule {
  anchored,  ///< from where it was, or from where it came to the ground within the step
  bdf2,      ///< by the backward difference of second order, without landing within a step
};

struct WheelSettings {
  double dt = 0.0;                 ///< [s]
  double mass_damping = 0.0;       ///< α                                        [1/s]
  double stiffness_damping = 0.0;  ///< β                                          [s]
  contact::Friction friction;      ///< μ
  double theta = 0.6;              ///< share of the new force in that on the modes
  SlipRule slip = SlipRule::anchored;
  /// (C) Boundary of each contact node of a sector, for its pressure; read only where the friction
  /// is no constant [m]
  std::vector<double> lengths{};
};

/// A node that the ground presses.
struct WheelContact {
  int node = 0;       ///< sector · C + place among the contact nodes of a sector
  Vec2 normal;        ///< of the ground, fixed frame
  Vec2 force;         ///< on the node, fixed frame                                [N/m]
  double gap = 0.0;   ///< [m]
  double slip = 0.0;  ///< along the normal turned by -90°                           [m]
  contact::Status status = contact::Status::open;
};

struct WheelReport : WheelOutcome {
  Vec2 force;       ///< of the ground, at the end of the step                       [N/m]
  Vec2 mean_force;  ///< θ of it and 1 - θ of that at the start: what moves the modes and the rim
  std::span<const WheelContact> contacts;  ///< valid until the next step
};

class RingWheel {
 public:
  /// All but the settings must outlive it.
  RingWheel(const Ring& ring, const WheelModel& model, const contact::Ground& ground,
            const WheelSettings& settings);

  /// Starts from the stationary spin, at angle_next and center_next.
  void start(const WheelMotion& motion);
  /// Starts from fields of all nodes in the co-rotating frame, (n) each: of these their modes, and
  /// the forces that hold contact nodes which touch the ground.
  void start(const WheelMotion& motion, std::span<const Vec2> u, std::span<const Vec2> v);
  /// Force of the ground at the start, and its torque about the center [N/m], [N]
  [[nodiscard]] RimVector force_at_start() const;
  /// Allocates nothing unless the law of contact needs pivoting.
  [[nodiscard]] WheelReport step(const WheelMotion& motion);
  /// Makes a step on a rim that moves by itself, and adds its works, with that of the scheme. It
  /// allocates where the spin has left that of the matrices.
  /// @param n number of steps made
  [[nodiscard]] WheelReport step(long long n, WheelRim& rim, dynamics::Works& works);
  /// What the deformation holds of the momentum of the whole, after the last step.
  [[nodiscard]] WheelSums sums() const;

  /// @param softened by the spin: elastic energy as of steps on tables
  [[nodiscard]] WheelEnergy energy_at_start(bool softened) const;
  /// Displacement of the free nodes after the last step, in the co-rotating frame; (n).
  /// @param angle θ at its end
  void displacement(double angle, std::span<Vec2> u) const;
  /// Writes that of the contact nodes alone, and allocates nothing.
  void contact_displacement(double angle, std::span<Vec2> u) const;
  /// And the mean velocity in it. @param angle θ in its middle
  void velocity(double angle, std::span<Vec2> v) const;
  /// W[lag]: displacement at the end of a step of contact node i by a force on j, i - j = lag.
  [[nodiscard]] Eigen::MatrixXd compliance(int lag);

  /// The numbers from which another wheel of this ring, and these settings, resumes bit for bit.
  /// @param friction of the settings
  [[nodiscard]] static std::size_t n_numbers(const Ring& ring, const WheelModel& model,
                                             const contact::Friction& friction) noexcept;
  [[nodiscard]] std::vector<double> save() const;
  /// @pre is_saved()
  void restore(std::span<const double> numbers);
  /// Whether numbers may come from save() of a wheel of this model.
  [[nodiscard]] static bool is_saved(const Ring& ring, const WheelModel& model,
                                     const contact::Friction& friction,
                                     std::span<const double> numbers) noexcept;

 private:
  using Complexes = std::complex<double>;
  using Vector = Eigen::VectorXcd;
  using Matrix = Eigen::MatrixXcd;

  /// The modes of a harmonic; their coefficients y and velocities p are one after the other.
  struct Modes {
    Modes(const RingHarmonic& of, bool whole, std::size_t n_branches);

    Vector state, before;   ///< (2r) at the end of the last step, and of the one before
    Vector force, outside;  ///< (r) of the contact, φ_cᴴ λ; of the frame
    Vector left;            ///< (r) of the forces that stay in space; ring of one sector
    Vector held;            ///< (r) of the contact at the start of the step, its share in it
    Vector ground;          ///< (2C) sum of e^{-ikψ} λ over the sectors, over their number
    Vector contact;         ///< (2C) φ_c y without new forces
    Vector pushed, work;    ///< (r), (2r)
    BranchStrains strain;
    // fill_step() sets these for a step.
    Complexes turn, lever;  ///< c = 1 + ½Δt iks; ½Δt/c                                         [s]
    double twisted = 0.0;   ///< ṡ                                                     [rad/s²]
    Eigen::VectorXd stiff;  ///< (r) ω² - s²                                              [1/s²]
    Matrix inverse;  ///< (r, r) of c + ½Δt (α + βω² + 2sJ) + ½Δt lever (ω² - s² + ṡJ)
    Matrix step, one;                    ///< (r, r) what is inverted; the identity
    Eigen::PartialPivLU<Matrix> factor;  ///< of it
    Matrix reply, answer;  ///< (r, 2C) inverse φ_cᴴ; (2C, 2C) share of the modes in W
    // On a rim that moves: what unit accelerations along x and of the angle do.
    Vector shift, twist;                  ///< (2r) at the end of the step
    Vector shift_contact, twist_contact;  ///< (2C) φ_c y of these
    Vector by_rate, by_place;             ///< (2C) momenta by new forces, through p and through y
  };
  /// The modes of a ring of one sector, where all is real.
  struct Real {
    Real() = default;
    /// @param shapes (2C, r) φ_c
    explicit Real(const Eigen::MatrixXd& shapes);
    /// (r) φ_cᵀ of a force on a contact node
    [[nodiscard]] auto on_modes(int node, Vec2 force) const {
      const Eigen::Index c = Eigen::Index{2} * node;
      return force.x * contact.col(c) + force.y * contact.col(c + 1);
    }

    Eigen::MatrixXd contact;             ///< (r, 2C) φ_cᵀ
    Eigen::VectorXd place, push;         ///< (r) y; φ_cᵀ λ of the forces so far
    Eigen::MatrixXd step, inverse, one;  ///< (r, r) as in Modes
    Eigen::PartialPivLU<Eigen::MatrixXd> factor;
    Eigen::MatrixXd reply;  ///< (r, 2C) y by forces on the contact nodes
    std::vector<int> made;  ///< (C) the version of these columns
  };
  using Columns = std::array<Vec2, 3>;
  /// A contact node near the ground.
  struct Near {
    int node = 0;
    Complex turn;  ///< e^{iψ} at the end of the step
    Complex wave;  ///< the same where the modes are, which only a rim that moves distinguishes
    Vec2 free;     ///< place from the center at the end of the step without new forces   [m]
    Vec2 place;    ///< and with them                                                     [m]
    Vec2 own, own_before;  ///< forces at both ends of the step, in the frame of the sector [N/m]
    bool candidate = false;
    int column = -1;  ///< of reply_, the first of two; -1: it has none
    // On a rim that moves.
    Vec2 still;     ///< `free` without accelerations beyond those of WheelRim::begin       [m]
    Columns moved;  ///< change of `place` by unit accelerations of x, y and the angle
    Columns push;   ///< momenta of x, y and the angle by a force: their products with it
    Columns reply;  ///< and the accelerations by it
  };
  /// What is remembered of a contact node.
  struct Memory {
    Vec2 force;                      ///< in the frame of the sector                [N/m]
    Vec2 filtered, filtered_before;  ///< forces that the residual answers to       [N/m]
    std::array<Vec2, 3> place{};     ///< from the center, newest first               [m]
    std::array<double, 2> gap{};     ///< newest first                                [m]
    int known = 0;                   ///< number of places that are known
    contact::Status status = contact::Status::open;
    double side = 0.0;
  };

  /// aᵀ G b of the filtered forces at the end of the step, at its end and start, at its start
  /// [J/m].
  struct Products {
    double end = 0.0, across = 0.0, start = 0.0;
  };
  using Block = contact::Block;
  using Shares = TableShares;  ///< of the model's residuals, at a spin
  /// Forces of which the residual makes a displacement: those now, or what a step leaves of them.
  enum class Forces { now, left };
  static constexpr std::size_t numbers_of_node = 15;
  void use_spin(const WheelMotion& motion);
  void take_spin(const WheelMotion& motion, double rate, double end);
  void fill_step(std::size_t harmonic, double spin, double rate);
  void push_by(const Modes& modes, const Vector& force, Vector& out) const;
  [[nodiscard]] BranchStep branches(std::size_t harmonic) const noexcept {
    return {model_.branches, harmonics_[harmonic].squares, modes_[harmonic].turn, settings_.dt};
  }
  void relax_modes();
  void shift_modes();
  void twist_modes();
  [[nodiscard]] Eigen::Matrix3d momenta_by_rate(double spin) const;
  void find_columns(const WheelMotion& motion);
  void accelerate_near(const RimVector& z, const Eigen::Matrix3d& answer);
  [[nodiscard]] RimVector push_on_rim() const;
  void accelerate_modes(const RimVector& z);
  [[nodiscard]] WheelRim::End end_of(const WheelReport& report, double ahead) const;
  void turn_modes(double angle);
  void begin(const WheelMotion& motion);
  void move_contact();
  void look_at_start(const WheelMotion& motion, std::span<const Vec2> u, std::span<const Vec2> v);
  void press_at_start(const WheelMotion& motion, std::span<const Vec2> u);
  [[nodiscard]] std::vector<std::size_t> touching(const WheelMotion& motion,
                                                  std::span<const Vec2> u);
  [[nodiscard]] Eigen::VectorXd forces_that_hold(std::span<const std::size_t> nodes) const;
  void push_modes(const Near& near, Vec2 own);
  void end_push();
  void project(double angle, std::span<const Vec2> field, bool velocity);
  void set_residual(double spin);
  void make_beyond(int to, int from) const;
  [[nodiscard]] Block of_tables(int to, int from, double at_once, double later) const;
  [[nodiscard]] Block held(int to, int from) const;
  void make_answer(int to, int from);
  [[nodiscard]] Block whole_answer(int to, int from);
  void leave_forces(const WheelMotion& motion);
  void move_modes(const WheelMotion& motion);
  [[nodiscard]] double waves_at(const WheelMotion& motion) const noexcept;
  void find_near(const WheelMotion& motion);
  [[nodiscard]] Vec2 displacement(int node, Complex turn, Forces forces) const;
  [[nodiscard]] Vec2 distance(const Near& near, const WheelMotion& motion) const;
  void find_reply(Near& from);
  void add_candidates(const WheelMotion& motion);
  void fill_law(const WheelMotion& motion);
  [[nodiscard]] Vec2 place_before(const Near& near, const WheelMotion& motion) const;
  [[nodiscard]] double friction_of(std::size_t candidate, const WheelMotion& motion) const;
  [[nodiscard]] double take_tangents(const WheelMotion& motion);
  void solve_law(const WheelMotion& motion, WheelReport& report);
  void solve(const WheelMotion& motion, WheelReport& report);
  void place_all();
  [[nodiscard]] bool turn_normals(const WheelMotion& motion) const;
  [[nodiscard]] bool join(const WheelMotion& motion);
  void take_forces(const WheelMotion& m, WheelReport& report);
  void account(const WheelMotion& motion, WheelReport& report);
  void account_modes(const WheelMotion& motion, WheelEnergy& energy) const;
  void account_branches(WheelEnergy& energy) const;
  [[nodiscard]] Products account_creep(WheelEnergy& energy) const;
  [[nodiscard]] double work_on_modes() const;
  [[nodiscard]] Products products() const;
  void remember(const WheelMotion& motion);
  void remember_sliding(const WheelMotion& motion);
  void slide_at_start(const WheelMotion& motion, std::span<const Vec2> v);
  /// Calls work(node) for all contact nodes whose forces the residual remembers, ascending.
  template <class Work>
  void for_remembered(Work&& work) const {
    if (!creep_) {
      for (const int node : active_) work(node);
      return;
    }
    for (int node = 0, n = static_cast<int>(memory_.size()); node < n; ++node) work(node);
  }
  template <class Filtered>
  [[nodiscard]] Eigen::VectorXd by_contact(Filtered&& filtered) const;
  template <class Coefficients, class Filtered>
  void write_field(double angle, const Eigen::VectorXd& constant, Coefficients&& coefficients,
                   Filtered&& filtered, std::span<Vec2> field) const;
  [[nodiscard]] Vec2 arm(int node) const noexcept {
    return ring_
        .place[static_cast<std::size_t>(ring_.contact[static_cast<std::size_t>(local(node))])];
  }
  [[nodiscard]] bool is_whole() const noexcept { return ring_.n_sectors() == 1; }
  [[nodiscard]] double residual_stored() const noexcept {
    return creep_ ? creep_->memory().stored(shares_) : 0.5 * products().end;
  }
  /// None of a ring of one sector, whose modes are in real_.
  [[nodiscard]] std::span<const RingHarmonic> waves_of_sectors() const noexcept {
    return is_whole() ? std::span<const RingHarmonic>{} : harmonics_;
  }
  [[nodiscard]] int sector(int node) const noexcept {
    return sector_[static_cast<std::size_t>(node)];
  }
  /// Place among the contact nodes of a sector.
  [[nodiscard]] int local(int node) const noexcept {
    return local_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] Memory& memory_of(int node) noexcept {
    return memory_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] const Memory& memory_of(int node) const noexcept {
    return memory_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] int lag(int to, int from) const noexcept {
    const int d = sector(to) - sector(from);
    return d < 0 ? d + ring_.n_sectors() : d;
  }
  /// Place of a pair of nodes in beyond_ and compliance_.
  [[nodiscard]] std::size_t pair(int to, int from) const noexcept {
    const auto c = static_cast<std::size_t>(n_contact_),
               d = static_cast<std::size_t>(lag(to, from));
    return (d * c + static_cast<std::size_t>(local(from))) * c +
           static_cast<std::size_t>(local(to));
  }
  [[nodiscard]] const Block& beyond(int to, int from) const {
    const std::size_t p = pair(to, from);
    if (beyond_made_[p] != version_) make_beyond(to, from);
    return beyond_[p];
  }
  [[nodiscard]] const contact::ComplexBlock& answer(int to, int from) {
    const std::size_t p = pair(to, from);
    if (made_[p] != version_) make_answer(to, from);
    return compliance_[p];
  }

  const Ring& ring_;
  const std::vector<RingHarmonic>& harmonics_;
  const WheelModel& model_;
  const contact::Ground& ground_;
  const WheelSettings settings_;
  const int n_contact_;  ///< C
  const bool flat_;
  Shares shares_{1.0};            ///< of the spin at the end of the step
  double residual_before_ = 0.0;  ///< energy at its start by the spin of the step before   [J/m]
  Eigen::VectorXd centrifugal_;   ///< (rows) of the spin at its end          [m]
  // Entries of the tables are made when they are asked for; they are good where `made` is version_.
  int version_ = 1;                    ///< of the spin, counted
  mutable std::vector<Block> beyond_;  ///< (N, C, C) G[lag], frames of the sectors          [m²/N]
  mutable std::vector<int> beyond_made_;
  /// (N, C, C) W[lag], turned by the lag: `same` is that of the fixed frame             [m²/N]
  std::vector<contact::ComplexBlock> compliance_;
  std::vector<int> made_;
  Real real_;
  double spin_ = 0.0, spin_rate_ = 0.0;  ///< of the matrices, at the end of the last step
  bool has_matrices_ = false, new_table_ = false, has_shift_ = false;
  std::optional<LeftBehind> left_;        ///< of a ring of one sector
  std::optional<CreepField> creep_;       ///< of viscous materials, in place of filtered forces
  std::vector<NodeForce> forces_;         ///< on contact nodes at the end of a step, for it
  std::optional<SlidingMemory> sliding_;  ///< of friction that is no constant
  bool on_moving_rim_ = false;            ///< in the law
  std::vector<Modes> modes_;
  std::vector<Memory> memory_;       ///< (N C)
  std::vector<int> sector_, local_;  ///< (N C) of each contact node, so that none is divided for
  std::vector<Vec2> reference_;      ///< (N C) X of each contact node, co-rotating frame    [m]
  std::vector<int> active_;          ///< nodes with a filtered force, ascending
  std::vector<int> seen_;            ///< nodes of the last step's near_, ascending
  std::vector<Near> near_;
  /// (2 near, n_columns_) places of the near nodes by forces along x and y on those that have
  /// columns, fixed frame, columns one after the other [m²/N]
  std::vector<double> reply_;
  std::vector<double> moved_;  ///< (2 near) by the forces of the law                        [m]
  int n_columns_ = 0;
  std::vector<std::size_t> solved_;    ///< places of the candidates in near_
  std::vector<contact::Touch> touch_;  ///< of these, at `place`
  std::vector<GapContact> law_;
  std::vector<GapContact> law_before_;  ///< with μ by the step before
  std::vector<WheelContact> contacts_;
  GapLaw gap_law_;
};

}  // namespace rondo::rom
