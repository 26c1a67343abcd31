// SPDX-License-Identifier: BSD-3-Clause
/// @file  The steps of a reduced run (docs/reduced.md, 4 to 6), for whoever drives those of a full
/// one: reports and fields are those of dynamics::Integrator. The midpoint rule knows displacements
/// and velocities both at whole steps; the velocity of a state is, as there, the one half a step
/// before, P̄.
#pragma once
#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rondo/core/process_wide.hpp"
#include "rondo/model/integrator.hpp"
#include "rondo/rom/contact_problem.hpp"
#include "rondo/rom/moving_rim.hpp"
#include "rondo/rom/saved_reduced.hpp"

namespace rondo::rom {

/// Smallest and largest so far. None: low > high.
struct Extent {
  double low = 1.0, high = 0.0;
  void take(double value) noexcept {
    const bool none = low > high;
    low = none ? value : std::min(low, value);
    high = none ? value : std::max(high, value);
  }
  [[nodiscard]] double largest() const noexcept { return std::max(-low, high); }  ///< |value|
};

/// Where a rim that moves by itself came, signs as the user's.
struct RimExtents {
  Extent spin, speed, height;  ///< [rad/s], [m/s], [m]
};

/// What the steps so far took.
struct StepFigures {
  long long factored = 0;  ///< matrices made anew, as the spin had changed
  double factor_wall_s = 0.0;
  double contact_wall_s = 0.0;  ///< points, law and impulses of all steps
  double wall_s = 0.0;          ///< of all steps, without their observers
  double slowest_step_s = 0.0;
  long long tables = 0;  ///< of contact nodes, one a phase of the disk between two sectors
  long long contact_steps = 0;
  long long iterations = 0;  ///< of the contact solver, all steps
  int iterations_max = 0;
  int contacts_max = 0;
  long long more_rows_than_modes = 0;  ///< steps with more rows of contact than modes
  long long not_converged = 0;         ///< steps whose contact missed the solver's
                                       ///< tolerance, or whose brake no try held
  RimExtents rim;                      ///< none where [motion] drives the rim
};

/// What a reduced integrator works with; all must outlive it.
struct IntegratorInput {
  const mesh::Mesh& mesh;
  const dynamics::Model& model;  ///< dt: of the reduced step
  const rom::ReducedModel& reduced;
  StepFigures& figures;  ///< counted here
  StepScheme scheme = StepScheme::midpoint;
  /// false: of the fields of a state only u on the boundary is filled; lift() makes the others
  bool lifts = true;
};

class ReducedIntegrator final : public dynamics::Integrator {
 public:
  /// @param start u and v at t = 0, turning frame: what the modes do not hold of them is lost
  ReducedIntegrator(const IntegratorInput& input, const dynamics::State& start);
  ~ReducedIntegrator() override;

  void advance(std::span<dynamics::StepReport> reports,
               dynamics::State* last = nullptr) noexcept override;
  void fields(dynamics::State& state) const noexcept override;

  /// Contacts of the last step, with their impulses.
  [[nodiscard]] std::span<const PointContact> contacts() const noexcept {
    if (!contact_) return {};
    return contact_->contacts();
  }
  /// (r) coefficients of displacement and velocity, after the last step.
  [[nodiscard]] const VectorXd& displacement() const noexcept { return q_; }
  [[nodiscard]] const VectorXd& velocity() const noexcept { return p_; }
  /// (r) of the velocity that a state has, half a step before its displacement, and the angle that
  /// lifts it: central differences carry it to the frame of the displacement. @pre a step is made
  [[nodiscard]] const VectorXd& state_velocity() const noexcept {
    return input_.scheme == StepScheme::central ? carried_ : p_mid_;
  }
  [[nodiscard]] double state_velocity_angle() const noexcept;
  /// u and v of the state after the last step, on all nodes.
  void lift(dynamics::State& state) const noexcept;

  /// Between two steps. @throws std::bad_alloc
  [[nodiscard]] SavedReducedState save() const;
  /// It is one of an integrator like this, as far as sizes tell.
  [[nodiscard]] bool fits(const SavedReducedState& saved) const noexcept;
  /// Goes on to the same bits as the integrator that saved it, of the same input. The contacts of
  /// the last step are not among what it knows. @pre fits()
  void restore(const SavedReducedState& saved);
  /// MovingRim::lead(), before each step. @pre input.model.rim
  void lead(const RimVector& end);

 private:
  /// The frame over one step. The midpoint rule sees its means over the step, central differences
  /// what it is at the end.
  struct Motion {
    double dt, carry, spin, spin_rate;
    double turn;  ///< of the step to come, central differences [rad]
    double angle_before, angle;
    Vec2 center_before, center, velocity_before, velocity;
    Vec2 pull;  ///< c̈ - g, frame of the model [m/s2]
  };
  /// Rigid part of what contact points of the material move with in a step.
  struct Carrier {
    Vec2 velocity;        ///< ċ, frame of the model [m/s]
    const VectorXd& arm;  ///< (r) displacement in the arms of s
  };
  void step(dynamics::StepReport& report);
  void step_driven(dynamics::StepReport& report);
  void start_central();
  [[nodiscard]] Motion motion_of_step() const;
  void set_load(const Motion& motion);
  void use_matrices(const Motion& motion);
  void solve_contact(const Motion& motion, dynamics::ContactReport& report);
  void find_middle();
  void count_solver(const ContactOutcome& outcome, dynamics::ContactReport& report);
  void count_contacts(const Motion& motion, const Carrier& carrier,
                      dynamics::ContactReport& report);
  void balance(const Motion& motion, dynamics::StepReport& report);
  [[nodiscard]] dynamics::StepEnergy energy();
  // On a rim that moves by itself (integrator_rim.cpp).
  void step_on_rim(dynamics::StepReport& report);
  void press_on_rim(dynamics::ContactReport& report);
  void balance_on_rim(dynamics::StepReport& report);
  void fill(dynamics::State& state);
  void fill_contacts(double angle, std::vector<dynamics::ActiveContact>& active) const;

  const OneBlasThread one_blas_thread_;  ///< products too small for more
  const IntegratorInput input_;
  std::vector<int> candidates_;  ///< (N) place in mesh.boundary, ring after ring
  mutable rom::Lift lift_;
  std::optional<rom::BoundaryLift> boundary_lift_;  ///< none: states are lifted whole
  std::unique_ptr<ContactSolver> contact_;          ///< none: no ground
  std::unique_ptr<StepMatrices> matrices_;
  std::unique_ptr<MovingRim> rim_;  ///< none: [motion] drives the rim
  dynamics::Ledger ledger_;
  long long n_ = 0;  ///< steps made
  VectorXd q_, p_;   ///< (r) at the end of the last step; central: p half a step later
  VectorXd q_end_, p_end_;
  VectorXd carried_;        ///< (r) p before the push: of the beginning; central: moved to the end
  VectorXd q_mid_, p_mid_;  ///< (r) q̄; central: q at the end; p̄
  VectorXd load_;           ///< (r) Δt F
  VectorXd push_;           ///< (r) Hᵀ r of the last step
  VectorXd work_, other_;   ///< (r)
  dynamics::FrameStep frame_;
};

}  // namespace rondo::rom
