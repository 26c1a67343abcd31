// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rim that moves by itself beside the modes: its lines of the implicit step and what
/// pushes and holds it (docs/reduced.md, 12).
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

/// (ċ_x, ċ_y, s), or forces and torque on them; counter-clockwise.
using RimVector = Eigen::Vector3d;

/// Matrices serve the spins within this share of theirs: it changes F_x by 1e-6 of F_y, and the
/// balance not at all.
inline constexpr double same_spin = 2e-4;

/// A step: begin(), use(), then try_step() and push() until settled(), finish().
class MovingRim {
 public:
  /// At t = 0. Both must outlive it. @pre model.rim, reduced.rim, midpoint steps
  MovingRim(const dynamics::Model& model, const ReducedModel& reduced);

  /// Before begin(): what is held has these velocities at the end of the step and goes to them
  /// linearly, whatever the tables say, here and in all steps to come; its places are the integral.
  /// Matrices then serve the spins within `same_spin`.
  void lead(const RimVector& end) noexcept { led_ = end; }
  /// Loads of the step n + 1 and what it takes for the mean spin and displacement.
  void begin(long long n, const VectorXd& q);
  /// s_A: the spin that the matrices of the step are of                              [rad/s]
  [[nodiscard]] double matrix_spin() const noexcept { return spin_; }
  /// Their lines of the rim.
  void use(const StepMatrices& matrices);
  /// The step without contact. Out: q and p at its end.
  void try_step(StepMatrices& matrices, const VectorXd& q, const VectorXd& p, VectorXd& q_end,
                VectorXd& p_end);
  /// With contact: a push on the modes, and the same impulses on the rim with the body.
  void push(StepMatrices& matrices, const VectorXd& modes, const RimVector& direct, VectorXd& q_end,
            VectorXd& p_end);
  /// false: the brake would reverse the wheel, or does not hold it; another try takes the other.
  [[nodiscard]] bool settled(const VectorXd& p_mid);
  /// After settled(): no try was found that the brake can hold; the step is that of the last.
  [[nodiscard]] bool gave_up() const noexcept { return gave_up_; }

  /// To the end of the step. @param modes the last push. Adds the works but those of contact and
  /// of the internal forces.
  void finish(const VectorXd& q, const VectorXd& p, const VectorXd& q_end, const VectorXd& p_end,
              dynamics::Works& works);

  /// Kinetic energy of body and rim, and that of the springs.
  [[nodiscard]] dynamics::StepEnergy energy(const VectorXd& q, const VectorXd& p) const;

  /// As a step without contact, or with the pushes so far, leaves it.
  [[nodiscard]] const RimVector& velocity() const noexcept { return now_; }
  [[nodiscard]] const RimVector& velocity_end() const noexcept { return end_; }
  [[nodiscard]] RimVector velocity_mean() const { return 0.5 * (now_ + end_); }
  [[nodiscard]] Vec2 center() const noexcept { return center_; }
  [[nodiscard]] Vec2 center_end() const noexcept;
  [[nodiscard]] double angle() const noexcept { return angle_.value(); }
  /// By which contact finds the nodes, before the spin of the step is known        [rad]
  [[nodiscard]] double angle_ahead() const noexcept { return angle() + model_.dt * spin_; }
  /// q_A: arms of what turns with the rim.
  [[nodiscard]] const VectorXd& arm_modes() const noexcept { return q_arm_; }
  [[nodiscard]] const RimResponse& response() const noexcept { return response_; }

  /// Between two steps; what lead() said is not in it.
  [[nodiscard]] SavedRim save() const;
  /// @param n steps made
  void restore(long long n, const SavedRim& saved);

  /// Of rim and body, undeformed                                            [kg/m], [kg·m]
  [[nodiscard]] double whole_mass() const noexcept { return rim_.mass + body_.mass; }
  [[nodiscard]] double whole_inertia() const noexcept { return rim_.inertia + body_.inertia; }

  /// After finish(); what comes after the step is not known: `turn` and `advance` are 0.
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
  std::optional<RimVector> led_;  ///< of lead()
  double spin_before_ = 0.0;      ///< s at the beginning of the step before
  VectorXd q_before_;             ///< (r) likewise
  VectorXd late_;  ///< (r) z of the step before: what it left of its increments (R.9)

  // Of the step: means that are known before it.
  double spin_ = 0.0;       ///< s_A
  VectorXd q_arm_;          ///< (r) q_A
  Vec2 gravity_;            ///< [m/s2]
  RimVector load_, known_;  ///< F, T [N/m, N]; right sides of the lines
  double braking_ = 0.0;    ///< most of the brake [N]
  Brake brake_ = Brake::off;
  double direction_ = 0.0;  ///< of the spin while the brake slips
  int tries_ = 0;
  bool gave_up_ = false;
  RimVector direct_;  ///< impulses of contact on the rim with the body

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
