// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rolling wheel in three dimensions in a few modes whose contact is exact
/// (docs/reduced.md): what wheel/ring_wheel.hpp does for a disk. Vectors of a contact node are
/// radial, tangential and axial in the frame of its sector, its own axes, unless they are said to
/// be of the fixed axes (t1, n, t2).
#pragma once
#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rondo/contact/space/space_ground.hpp"
#include "rondo/model/model.hpp"
#include "rondo/rom/solid/cone_law.hpp"
#include "rondo/rom/solid/harmonic_creep.hpp"
#include "rondo/rom/solid/solid_residual.hpp"
#include "rondo/rom/solid/wheel_attitude.hpp"
#include "rondo/rom/wheel/base/reduced_wheel.hpp"

namespace rondo::rom {

struct SolidWheelSettings : StepSettings {
  double law_residual = 1e-6;  ///< of the law of contact, over the largest force
};

/// The rim over a step.
struct SolidMotion {
  WheelMotion plane;                         ///< its center and pull along t1 and n
  double lateral = 0.0, lateral_next = 0.0;  ///< of the center, along t2                 [m]
  double lateral_pull = 0.0;                 ///< mean of c̈ - g along t2               [m/s²]
  WheelAttitude attitude, attitude_next;
  /// Mean angular velocity of the attitude and its mean rate, along x and y of the wheel
  /// [rad/s], [rad/s²]
  Vec2 turning, turning_rate;

  /// What these do to the shapes RingHarmonic::tilt of the harmonic 1 at the spin of the step.
  [[nodiscard]] std::complex<double> tilting(double spin) const noexcept {
    return spin * std::complex<double>(turning.x, -turning.y) -
           std::complex<double>(0.0, 0.5) * std::complex<double>(turning_rate.x, -turning_rate.y);
  }
  [[nodiscard]] Vec3 center() const noexcept { return {plane.center, lateral}; }
  [[nodiscard]] Vec3 center_next() const noexcept { return {plane.center_next, lateral_next}; }
};

/// A node that the ground presses; fixed axes.
struct SolidWheelContact {
  int node = 0;  ///< sector · C + place among the contact nodes of a sector
  contact::SpaceFrame frame;
  Vec3 force;             ///< on the node                                             [N]
  Vec3 moved;             ///< gap and distances slid, in the frame                    [m]
  double friction = 0.0;  ///< μ
  contact::Status status = contact::Status::open;
};

/// Forces of the ground on the wheel, and their moments about the center; fixed axes.
struct GroundForces {
  Vec3 force;   ///< [N]
  Vec3 moment;  ///< [N m]
};

struct SolidWheelReport : WheelOutcome {
  GroundForces end;   ///< at the end of the step
  GroundForces mean;  ///< θ of it and 1 - θ of that at its start: what moves modes and rim
  /// SolidWheel::lateral_momentum at the end and its mean in the step, for a rim that moves [N s].
  double lateral_momentum = 0.0, lateral_middle = 0.0;
  double lateral_work = 0.0;  ///< of the force at the end along t2, part of WheelEnergy::rim [J]
  /// The work that the moment at the end does on a hub that turns about the axes of the ground,
  /// which is a part of WheelEnergy::rim, and the work that the inertia of this turning does on the
  /// modes [J].
  double turning_work = 0.0, turning_inertia = 0.0;
  double load = 0.0;  ///< work of the constant loads on the modes                       [J]
  std::span<const SolidWheelContact> contacts;  ///< valid until the next step
};

class SolidWheel final : private ReducedWheel<3> {
 public:
  /// All but the settings must outlive it.
  SolidWheel(const SolidRing& ring, const WheelModel& model, const dynamics::ContactModel& ground,
             const SolidWheelSettings& settings);

  /// Starts from the stationary spin, at the end of a motion.
  void start(const SolidMotion& motion);
  /// Starts from fields of all nodes in the co-rotating frame, (n) each: of these their modes, and
  /// the forces that hold contact nodes which touch the ground.
  void start(const SolidMotion& motion, std::span<const Vec3> u, std::span<const Vec3> v);
  /// Allocates nothing but room for more contacts than ever before, and in Newton's method.
  [[nodiscard]] SolidWheelReport step(const SolidMotion& motion);

  /// Makes a step on a rim that moves by itself, and adds its works, with that of the scheme.
  /// @param n number of steps made
  /// @param aside its motion along t2: lateral numbers and attitude. At the end: that of the step
  [[nodiscard]] SolidWheelReport step(long long n, WheelRim& rim, SolidMotion& aside,
                                      dynamics::Works& works);
  /// What the deformation holds of the momentum of the whole, after the last step.
  [[nodiscard]] WheelSums sums(const SolidMotion& motion) const;
  /// That along t2 at a spin [N s].
  [[nodiscard]] double lateral_momentum(const SolidMotion& motion, double spin) const;
  /// Force of the ground along t2 after the last step [N].
  [[nodiscard]] double lateral_force() const noexcept { return last_.force.z; }
  /// Force of the ground after the last step along t1 and n, and its torque about the axle [N],
  /// [N m]
  [[nodiscard]] RimVector force_on_rim(const SolidMotion& motion) const;

  [[nodiscard]] WheelEnergy energy_at_start(bool softened) const;
  /// Displacement of the free nodes after the last step, in the co-rotating frame; (n).
  /// @param angle θ at its end
  void displacement(double angle, std::span<Vec3> u) const;
  /// Writes that of the contact nodes alone, and allocates nothing.
  void contact_displacement(double angle, std::span<Vec3> u) const;
  /// And the mean velocity in it. @param angle θ in its middle
  void velocity(double angle, std::span<Vec3> v) const;

  /// The numbers from which another wheel of this ring, and these settings, resumes bit for bit.
  [[nodiscard]] static std::size_t n_numbers(const SolidRing& ring,
                                             const WheelModel& model) noexcept;
  [[nodiscard]] std::vector<double> save() const;
  /// @pre is_saved()
  void restore(std::span<const double> numbers);
  /// Whether numbers may come from save() of a wheel of this model.
  [[nodiscard]] static bool is_saved(const SolidRing& ring, const WheelModel& model,
                                     std::span<const double> numbers) noexcept;

 private:
  /// A contact node near the ground; places and forces are in the frame of its sector.
  struct Near : NearNode<Vec3> {
    Vec3 force;  ///< at the end of the step                                              [N]
  };
  struct Memory : NodeMemory<Vec3> {
    Vec3 residual, residual_before;  ///< G of the filtered forces                         [m]
    double slip = 0.0;               ///< distance slid in the last step                   [m]
  };
  static constexpr std::size_t numbers_of_node = 22;

  void use_spin(const WheelMotion& motion);
  void fill_step(std::size_t harmonic, double spin, double rate) override;
  void move_modes(const SolidMotion& motion);
  [[nodiscard]] Vec3 momentum_of(const Vector Modes::*of, bool places) const;
  [[nodiscard]] Eigen::Matrix3d momenta_by_rate(const SolidMotion& motion) const;
  void find_columns(const SolidMotion& motion);
  [[nodiscard]] RimVector push_on_rim() const;
  void accelerate_modes(const RimVector& z, const SolidMotion& motion);
  [[nodiscard]] WheelRim::End end_of(const SolidWheelReport& report, const SolidMotion& motion);
  void make_window();
  [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> beyond(int lag) const;
  [[nodiscard]] Vec3 product(int to, int from, Vec3 force) const noexcept;
  [[nodiscard]] Eigen::Matrix3d held(int to, int from) const;
  void renew_residuals();
  [[nodiscard]] Vec3 modal(int node, Complex wave, const Vector Modes::*of) const noexcept;
  [[nodiscard]] bool is_low(int sector, const SolidMotion& motion) const noexcept;
  void find_window(const SolidMotion& motion);
  void find_near(const SolidMotion& motion);
  void guess_forces(const SolidMotion& motion);
  [[nodiscard]] Vec3 fixed(const Near& near, Vec3 own, const SolidMotion& m) const noexcept {
    return m.attitude_next.to_fixed(near.turn * own);
  }
  [[nodiscard]] contact::SpaceTouch touch_of(const Near& near, const SolidMotion& m) const noexcept;
  [[nodiscard]] Vec3 distance(const Near& near, const SolidMotion& motion) const noexcept;
  [[nodiscard]] double friction_at(std::size_t candidate, double slip, double force) const;
  [[nodiscard]] double friction_before(std::size_t candidate, const SolidMotion& m,
                                       Vec3 free) const;
  void add_candidates(const SolidMotion& motion);
  void fill_law(const SolidMotion& motion);
  void place_all();
  [[nodiscard]] bool join(const SolidMotion& motion);
  [[nodiscard]] bool turn_normals(const SolidMotion& motion) const;
  void solve_law(SolidWheelReport& report);
  void solve(const SolidMotion& motion, SolidWheelReport& report);
  void take_forces(const SolidMotion& motion, SolidWheelReport& report);
  void filter_forces();
  void creep_under_forces();
  void account_modes(const SolidMotion& motion, SolidWheelReport& report) const;
  void account(const SolidMotion& motion, SolidWheelReport& report);
  [[nodiscard]] ResidualProducts products() const;
  [[nodiscard]] double work_of_turning(const SolidMotion& motion) const;
  void remember(const SolidMotion& motion);
  void begin(const SolidMotion& motion);
  void press_at_start(const SolidMotion& motion, std::span<const Vec3> u);
  template <class Filtered>
  [[nodiscard]] HarmonicCreep::Lagging amplitudes_of(Filtered&& filtered) const;
  template <class Coefficients>
  void write_field(double angle, const Eigen::VectorXd& constant, Coefficients&& coefficients,
                   const HarmonicCreep::Lagging& forces, std::span<Vec3> field) const;

  /// Share of a filtered force that a step leaves; those of viscous materials are in creep_.
  [[nodiscard]] double filter() const noexcept {
    if (creep_) return 0.0;
    const double lag = settings_.stiffness_damping / settings_.dt;
    return lag / (1.0 + lag);
  }
  [[nodiscard]] int wrapped(int sector) const noexcept {
    const int n = ring_.n_sectors();
    return (sector % n + n) % n;
  }
  [[nodiscard]] Memory& memory_of(int node) noexcept {
    return memory_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] const Memory& memory_of(int node) const noexcept {
    return memory_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] double residual_stored() const override;

  const dynamics::ContactModel& ground_;
  const double law_residual_;       ///< over the largest force
  const std::vector<double> area_;  ///< (C) of the ground that a contact node presses          [m²]
  /// (N, 3C, 3C) G at a spin between those of the model; of a viscous wheel what a new force does
  /// at the end of its step. Blocks of this version of the spin are made [m/N]
  mutable std::vector<double> tables_;
  mutable std::vector<int> made_;               ///< (N) version of each block
  mutable std::unique_ptr<SolidFields> field_;  ///< at the spin of the last one that was asked for
  std::vector<Memory> memory_;                  ///< (N C)
  std::optional<HarmonicCreep> creep_;     ///< of viscous materials, in place of filtered forces
  mutable std::vector<double> in_sector_;  ///< (3C) a field of it
  GroundForces last_;                      ///< at the end of the last step
  // Of the window: whole sectors, of which some node is near the ground or remembers a force.
  int first_ = 0, n_window_ = 0;  ///< first sector, number of sectors
  int n_made_ = 0;                ///< sectors for which the compliance is made
  WindowCompliance window_;
  Eigen::MatrixXd block_;      ///< (3C, 3C) of it, while it is made
  std::vector<Near> near_;     ///< (n_window, C)
  std::vector<double> moved_;  ///< (3 near) by the forces of the law, own axes            [m]
  std::vector<contact::SpaceTouch> touch_;  ///< of solved_, at `place`
  std::vector<ConeContact> cones_;
  std::vector<Vec3> place_before_;   ///< of these at the start of the step, fixed axes    [m]
  std::vector<ConeContact> before_;  ///< with μ by the step before
  ConeFriction friction_;            ///< friction_at(), if friction is not constant
  std::vector<SolidWheelContact> contacts_;
  ConeLaw law_;
};

}  // namespace rondo::rom
