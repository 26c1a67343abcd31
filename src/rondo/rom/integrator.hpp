// SPDX-License-Identifier: BSD-3-Clause
/// @file  The steps of a reduced run (docs/reduced.md, 4 to 6), with the interface of a full one:
/// reports and fields are those of dynamics::Integrator. The midpoint rule has displacements and
/// velocities at whole steps; the velocity of a state is, as in a full run, that of half a step
/// before, P̄.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rondo/core/process_wide.hpp"
#include "rondo/model/integrator.hpp"
#include "rondo/rom/contact_problem.hpp"
#include "rondo/rom/step_matrices.hpp"

namespace rondo::rom {

/// Statistics of the steps so far.
struct StepFigures {
  long long factored = 0;  ///< how often matrices were made anew because the spin changed
  double factor_wall_s = 0.0;
  double contact_wall_s = 0.0;  ///< for points, law and impulses of all steps
  double wall_s = 0.0;          ///< of all steps, without their observers
  double slowest_step_s = 0.0;
  long long tables = 0;  ///< of contact nodes, one per phase of the disk between two sectors
  long long contact_steps = 0;
  long long iterations = 0;  ///< of the contact solver, all steps
  int iterations_max = 0;
  int contacts_max = 0;
  long long more_rows_than_modes = 0;  ///< steps with more contact rows than modes
  long long not_converged = 0;         ///< steps in which the contact missed the solver's tolerance
};

/// Data that a reduced integrator uses; all must outlive it.
struct IntegratorInput {
  const mesh::Mesh& mesh;
  const dynamics::Model& model;  ///< dt: that of the reduced step
  const rom::ReducedModel& reduced;
  StepFigures& figures;  ///< updated by the integrator
  StepScheme scheme = StepScheme::midpoint;
  /// false: of a state's fields only u on the boundary is filled; lift() computes the others
  bool lifts = true;
};

class ReducedIntegrator final : public dynamics::Integrator {
 public:
  /// @param start u and v at t = 0, co-rotating frame; their parts outside the modes are lost
  ReducedIntegrator(const IntegratorInput& input, const dynamics::State& start);
  ~ReducedIntegrator() override;

  void advance(std::span<dynamics::StepReport> reports,
               dynamics::State* last = nullptr) noexcept override;
  void fields(dynamics::State& state) const noexcept override;

  /// Contacts of the last step and their impulses.
  [[nodiscard]] std::span<const PointContact> contacts() const noexcept {
    if (!contact_) return {};
    return contact_->contacts();
  }
  /// (r) coefficients of displacement and velocity, after the last step.
  [[nodiscard]] const VectorXd& displacement() const noexcept { return q_; }
  [[nodiscard]] const VectorXd& velocity() const noexcept { return p_; }
  /// (r) coefficients of a state's velocity, half a step before its displacement, and the angle
  /// that lifts it: central differences take it to the displacement's frame. @pre a step is made
  [[nodiscard]] const VectorXd& state_velocity() const noexcept {
    return input_.scheme == StepScheme::central ? carried_ : p_mid_;
  }
  [[nodiscard]] double state_velocity_angle() const noexcept;
  /// Computes u and v of the state after the last step, on all nodes.
  void lift(dynamics::State& state) const noexcept;

 private:
  /// The frame over one step: the midpoint rule uses means over the step, central differences the
  /// values at its end.
  struct Motion {
    double dt, carry, spin, spin_rate;
    double turn;  ///< of the next step, central differences [rad]
    double angle_before, angle;
    Vec2 center_before, center, velocity_before, velocity;
    Vec2 pull;  ///< c̈ - g, frame of the model [m/s2]
  };
  /// Rigid part of the velocity of material contact points in a step.
  struct Carrier {
    Vec2 velocity;        ///< ċ, frame of the model [m/s]
    const VectorXd& arm;  ///< (r) displacement in the arms of s
  };
  void step(dynamics::StepReport& report);
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
  void fill(dynamics::State& state);
  void fill_contacts(double angle, std::vector<dynamics::ActiveContact>& active) const;

  const OneBlasThread one_blas_thread_;  ///< products are too small for more
  const IntegratorInput input_;
  std::vector<int> candidates_;  ///< (N) index in mesh.boundary, ring after ring
  mutable rom::Lift lift_;
  std::optional<rom::BoundaryLift> boundary_lift_;  ///< none: all nodes of states are lifted
  std::unique_ptr<ContactSolver> contact_;          ///< null: no ground
  std::unique_ptr<StepMatrices> matrices_;
  dynamics::Ledger ledger_;
  long long n_ = 0;  ///< number of steps made
  VectorXd q_, p_;   ///< (r) at the end of the last step; central: p half a step later
  VectorXd q_end_, p_end_;
  VectorXd carried_;        ///< (r) p before the push, at the beginning; central: moved to the end
  VectorXd q_mid_, p_mid_;  ///< (r) q̄; central: q at the end; p̄
  VectorXd load_;           ///< (r) Δt F
  VectorXd push_;           ///< (r) Hᵀ r of the last step
  VectorXd work_, other_;   ///< (r)
  dynamics::FrameStep frame_;
};

}  // namespace rondo::rom
