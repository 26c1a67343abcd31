// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rolling ring in a few modes whose contact is exact (docs/reduced.md): modes carry the
/// dynamics, the compliance of the contact nodes carries all the rest, contact nodes have no mass
/// and touch the ground where they are. All in the plane, per metre of width.
#pragma once
#include <Eigen/LU>
#include <optional>
#include <span>
#include <vector>

#include "rondo/contact/coupled/block.hpp"
#include "rondo/contact/ground.hpp"
#include "rondo/core/vec2.hpp"
#include "rondo/rom/wheel/base/reduced_wheel.hpp"
#include "rondo/rom/wheel/creep_field.hpp"
#include "rondo/rom/wheel/gap_law.hpp"
#include "rondo/rom/wheel/left_behind.hpp"
#include "rondo/rom/wheel/sliding_memory.hpp"

namespace rondo::rom {

/// Which distance a node slides in a step.
enum class SlipRule {
  anchored,  ///< from where it was, or from where it came to the ground within the step
  bdf2,      ///< by the backward difference of second order, without landing within a step
};

struct WheelSettings : StepSettings {
  contact::Friction friction;  ///< μ
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

class RingWheel final : private ReducedWheel<2> {
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
  /// A contact node near the ground; places are of the fixed frame.
  struct Near : NearNode<Vec2> {
    Vec2 own, own_before;  ///< forces at both ends of the step, in the frame of the sector [N/m]
    int column = -1;       ///< of reply_, the first of two; -1: it has none
  };
  struct Memory : NodeMemory<Vec2> {
    contact::Status status = contact::Status::open;
    double side = 0.0;
  };
  using Block = contact::Block;
  /// Forces of which the residual makes a displacement: those now, or what a step leaves of them.
  enum class Forces { now, left };
  static constexpr std::size_t numbers_of_node = 15;
  void fill_step(std::size_t harmonic, double spin, double rate) override;
  [[nodiscard]] Eigen::Matrix3d momenta_by_rate(double spin) const;
  void find_columns(const WheelMotion& motion);
  void accelerate_near(const RimVector& z, const Eigen::Matrix3d& answer);
  [[nodiscard]] RimVector push_on_rim() const;
  void accelerate_modes(const RimVector& z);
  [[nodiscard]] WheelRim::End end_of(const WheelReport& report, double ahead) const;
  void begin(const WheelMotion& motion);
  void move_contact();
  void look_at_start(const WheelMotion& motion, std::span<const Vec2> u, std::span<const Vec2> v);
  void press_at_start(const WheelMotion& motion, std::span<const Vec2> u);
  [[nodiscard]] std::vector<std::size_t> touching(const WheelMotion& motion,
                                                  std::span<const Vec2> u);
  [[nodiscard]] Eigen::VectorXd forces_that_hold(std::span<const std::size_t> nodes) const;
  void end_push();
  void make_beyond(int to, int from) const;
  [[nodiscard]] Block of_tables(int to, int from, double at_once, double later) const;
  [[nodiscard]] Block held(int to, int from) const;
  void make_answer(int to, int from);
  [[nodiscard]] Block whole_answer(int to, int from);
  void leave_forces(const WheelMotion& motion);
  void move_modes(const WheelMotion& motion);
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
  [[nodiscard]] ResidualProducts products() const;
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
    for (int node = 0; node < n_nodes(); ++node) work(node);
  }
  template <class Filtered>
  [[nodiscard]] Eigen::VectorXd by_contact(Filtered&& filtered) const;
  template <class Coefficients, class Filtered>
  void write_field(double angle, const Eigen::VectorXd& constant, Coefficients&& coefficients,
                   Filtered&& filtered, std::span<Vec2> field) const;
  [[nodiscard]] double residual_stored() const override {
    return creep_ ? creep_->memory().stored(shares_) : 0.5 * products().end;
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

  const contact::Ground& ground_;
  const contact::Friction friction_;  ///< μ
  const SlipRule slip_;
  // Entries of the tables are made when they are asked for; they are good where `made` is version_.
  mutable std::vector<Block> beyond_;  ///< (N, C, C) G[lag], frames of the sectors          [m²/N]
  mutable std::vector<int> beyond_made_;
  /// (N, C, C) W[lag], turned by the lag: `same` is that of the fixed frame             [m²/N]
  std::vector<contact::ComplexBlock> compliance_;
  std::vector<int> made_;
  Real real_;
  std::optional<LeftBehind> left_;        ///< of a ring of one sector
  std::optional<CreepField> creep_;       ///< of viscous materials, in place of filtered forces
  std::vector<NodeForce> forces_;         ///< on contact nodes at the end of a step, for it
  std::optional<SlidingMemory> sliding_;  ///< of friction that is no constant
  std::vector<Memory> memory_;            ///< (N C)
  std::vector<Vec2> reference_;  ///< (N C) X of each contact node, co-rotating frame    [m]
  std::vector<int> active_;      ///< nodes with a filtered force, ascending
  std::vector<Near> near_;
  /// (2 near, n_columns_) places of the near nodes by forces along x and y on those that have
  /// columns, fixed frame, columns one after the other [m²/N]
  std::vector<double> reply_;
  std::vector<double> moved_;  ///< (2 near) by the forces of the law                        [m]
  int n_columns_ = 0;
  std::vector<contact::Touch> touch_;  ///< of solved_, at `place`
  std::vector<GapContact> law_;
  std::vector<GapContact> law_before_;  ///< with μ by the step before
  std::vector<WheelContact> contacts_;
  GapLaw gap_law_;
};

}  // namespace rondo::rom
