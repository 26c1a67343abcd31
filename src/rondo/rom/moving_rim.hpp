// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rim that moves freely in addition to the modes: its equations in the implicit step, its
/// loads and constraints (docs/reduced.md, 12).
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "rondo/model/integrator.hpp"
#include "rondo/rom/rim_modes.hpp"
#include "rondo/rom/rim_response.hpp"
#include "rondo/rom/saved_reduced.hpp"
#include "rondo/rom/step_matrices.hpp"

namespace rondo::rom {

/// (ċ_x, ċ_y, s), or the forces and the torque on them; counter-clockwise.
using RimVector = Eigen::Vector3d;

/// Matrices are reused for spins within this relative distance: it changes F_x by 1e-6 of F_y, and
/// the energy balance not at all.
inline constexpr double same_spin = 2e-4;

/// Calls of a step: begin(), use(), then try_step() and push() until settled(), finish().
class MovingRim {
 public:
  /// The rim at t = 0. Both arguments must outlive it. @pre model.rim, reduced.rim, midpoint steps
  MovingRim(const dynamics::Model& model, const ReducedModel& reduced);

  /// Call before begin(): in this and all later steps, prescribed components have these velocities
  /// at the end of the step and approach them linearly, whatever the tables say; their positions
  /// are the integral. Matrices are then reused for spins within `same_spin`.
  void lead(const RimVector& end) noexcept { led_ = end; }
  /// Computes loads of step n + 1 and predictions of the mean spin and displacement.
  void begin(long long n, const VectorXd& q);
  /// s_A: the spin for which the matrices of the step are made                       [rad/s]
  [[nodiscard]] double matrix_spin() const noexcept { return spin_; }
  /// Computes the equations of the rim with these matrices.
  void use(const StepMatrices& matrices);
  /// Makes the step without contact. Results are q and p at its end.
  void try_step(StepMatrices& matrices, const VectorXd& q, const VectorXd& p, VectorXd& q_end,
                VectorXd& p_end);
  /// Adds contact: a push on the modes, and the same impulses on the rim with the body.
  void push(StepMatrices& matrices, const VectorXd& modes, const RimVector& direct, VectorXd& q_end,
            VectorXd& p_end);
  /// Returns false if the brake would reverse the wheel or does not hold it: try again then.
  [[nodiscard]] bool settled(const VectorXd& p_mid);
  /// After settled(): in no try the brake could hold; the step is that of the last try.
  [[nodiscard]] bool gave_up() const noexcept { return gave_up_; }

  /// Finishes the step. @param modes the last push. Adds the works except those of contact and of
  /// the internal forces.
  void finish(const VectorXd& q, const VectorXd& p, const VectorXd& q_end, const VectorXd& p_end,
              dynamics::Works& works);

  /// Kinetic energy of body and rim, and energy of the springs.
  [[nodiscard]] dynamics::StepEnergy energy(const VectorXd& q, const VectorXd& p) const;

  /// Velocity after a step without contact, or with the pushes so far.
  [[nodiscard]] const RimVector& velocity() const noexcept { return now_; }
  [[nodiscard]] const RimVector& velocity_end() const noexcept { return end_; }
  [[nodiscard]] RimVector velocity_mean() const { return 0.5 * (now_ + end_); }
  [[nodiscard]] Vec2 center() const noexcept { return center_; }
  [[nodiscard]] Vec2 center_end() const noexcept;
  [[nodiscard]] double angle() const noexcept { return angle_.value(); }
  /// Angle at which contact searches the nodes, before the spin of the step is known [rad]
  [[nodiscard]] double angle_ahead() const noexcept { return angle() + model_.dt * spin_; }
  /// q_A: displacement in the arms of what turns with the rim.
  [[nodiscard]] const VectorXd& arm_modes() const noexcept { return q_arm_; }
  [[nodiscard]] const RimResponse& response() const noexcept { return response_; }

  /// Call between two steps; the argument of lead() is not included.
  [[nodiscard]] SavedRim save() const;
  /// @param n number of steps made
  void restore(long long n, const SavedRim& saved);

  /// Mass and inertia of rim and body, undeformed                           [kg/m], [kg·m]
  [[nodiscard]] double whole_mass() const noexcept { return rim_.mass + body_.mass; }
  [[nodiscard]] double whole_inertia() const noexcept { return rim_.inertia + body_.inertia; }

  /// Valid after finish(); the next step is not known, so `turn` and `advance` are 0.
  [[nodiscard]] const dynamics::FrameStep& frame() const noexcept { return frame_; }
  [[nodiscard]] const dynamics::RimReport& report() const noexcept { return report_; }

 private:
  enum class Brake { off, slips, locks };

  void set_lines(const StepMatrices& matrices);
  void hold(const StepMatrices& matrices);
  void set_known(const StepMatrices& matrices, const VectorXd& q, const VectorXd& p);
  [[nodiscard]] bool is_free(Index k) const noexcept;
  [[nodiscard]] RimVector reaction(const VectorXd& p_mid) const;
  void move(const RimVector& mean);
  void set_frame(double turn, Vec2 way);
  void add_works(const RimVector& mean, const RimVector& held, const VectorXd& p_mid,
                 dynamics::Works& works) const;
  [[nodiscard]] double scheme_work(const VectorXd& q, const VectorXd& p, const VectorXd& q_end,
                                   const VectorXd& p_end);

  const dynamics::Model& model_;
  const dynamics::RimBody& rim_;
  const ReducedModel& reduced_;
  const RimModes& body_;
  long long step_ = 0;
  CompensatedSum x_, y_, angle_;
  Vec2 center_;
  RimVector now_, end_;
  std::optional<RimVector> led_;  ///< argument of lead()
  double spin_before_ = 0.0;      ///< s at the beginning of the previous step
  VectorXd q_before_;             ///< (r) q at the same time
  VectorXd late_;  ///< (r) z of the previous step: what it left of its increments (R.9)

  // Data of the step: means that are known before it.
  double spin_ = 0.0;       ///< s_A
  VectorXd q_arm_;          ///< (r) q_A
  Vec2 gravity_;            ///< [m/s2]
  RimVector load_, known_;  ///< F, T [N/m, N]; right sides of the equations
  double braking_ = 0.0;    ///< largest torque of the brake [N]
  Brake brake_ = Brake::off;
  double direction_ = 0.0;  ///< sign of the spin while the brake slips
  int tries_ = 0;
  bool gave_up_ = false;
  RimVector direct_;  ///< contact impulses on the rim with the body

  Eigen::Matrix<double, Eigen::Dynamic, 2> across_;  ///< (r, 2) E⊥ = -E J
  VectorXd turned_arm_, carried_arm_;                ///< (r) ĵ = j + J q_A, f̂ = x + (G + 1) q_A
  MatrixXd forward_, back_;                          ///< (r, 3) B, Cᵀ
  Eigen::Matrix3d mass_;                             ///< D
  RimResponse response_;
  VectorXd load_modes_, work_;
  dynamics::FrameStep frame_;
  dynamics::RimReport report_;
};

}  // namespace rondo::rom
