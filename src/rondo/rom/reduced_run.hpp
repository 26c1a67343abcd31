// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the runs of reduced wheels in the plane (wheel_run.hpp) and in three dimensions
/// (solid_wheel_run.hpp) have in common: the interface of a full run, the ledger, the rim, reports
/// and saved numbers. The wheel itself belongs to the classes derived from it.
#pragma once
#include <optional>
#include <vector>

#include "rondo/core/process_wide.hpp"
#include "rondo/model/integrator.hpp"
#include "rondo/rom/wheel/material_sums.hpp"
#include "rondo/rom/wheel/wheel_rim.hpp"

namespace rondo::rom {

/// Effort of the steps so far.
struct WheelFigures {
  long long contact_steps = 0;
  long long iterations = 0;  ///< of the contact law, all steps
  int iterations_max = 0, contacts_max = 0;
  long long second_method = 0;  ///< steps that WheelOutcome::second_method is true of
  long long not_converged = 0;  ///< steps whose contact law is not met, or whose brake does not
                                ///< hold
  long long late_friction = 0;  ///< steps whose μ is that by the step before
  double spin_max = 0.0;        ///< largest |s| of a rim that moves                     [rad/s]
  double wall_s = 0.0, slowest_step_s = 0.0;
};

class ReducedRun : public dynamics::Integrator, public dynamics::Resumable {
 public:
  [[nodiscard]] const WheelRim* rim() const noexcept { return rim_ ? &*rim_ : nullptr; }

  void advance(std::span<dynamics::StepReport> reports,
               dynamics::State* last = nullptr) noexcept final;
  void fields(dynamics::State& state) const noexcept final;
  [[nodiscard]] Resumable* resumable() noexcept final { return this; }
  [[nodiscard]] dynamics::SavedState save() const final;
  void restore(const dynamics::SavedState& saved) final;

 protected:
  /// All must outlive it. @param model dt: that of the reduced step
  /// @param law_residual of the law of contact, over the largest force: more is not converged
  /// @param candidates candidates_of() the ring
  ReducedRun(const dynamics::Model& model, const WheelModel& wheel, double law_residual,
             std::vector<std::size_t> candidates, WheelFigures& figures);

  /// The motion of a step that the tables give. Kinks are spread over the step that ends there.
  [[nodiscard]] WheelMotion motion_of(long long step) const;
  /// The end of a step that stops at t = 0, where the rim is, or where the tables have it.
  [[nodiscard]] WheelMotion motion_at_start() const;
  /// Begins the ledger with the energies at the start, after the rim has started.
  void begin_ledger(const WheelEnergy& at_start);
  /// Lists a node that the ground presses.
  dynamics::ActiveContact& list_contact(int contact_node);

  [[nodiscard]] virtual dynamics::StepEnergy energy_of(const WheelEnergy& wheel) const;
  /// Numbers in SavedState::ring beside those of the wheel. @param aside size of save_aside()
  [[nodiscard]] static std::size_t n_beside(const dynamics::Model& model, const WheelModel& wheel,
                                            std::size_t aside) noexcept;

  const dynamics::Model& model_;
  std::optional<WheelRim> rim_;
  long long n_ = 0;  ///< number of steps made
  dynamics::FrameStep frame_;

 private:
  /// Makes step n_ + 1 and adds the works that only this wheel knows. With a rim it sets the frame.
  [[nodiscard]] virtual const WheelOutcome& make_step(dynamics::Works& works) = 0;
  /// Sets impulse and moments, and lists the contacts. The frame is that of the end of the step.
  virtual void report_forces(dynamics::ContactReport& report) = 0;
  virtual void contact_displacement(double angle, Field& u) const = 0;
  virtual void displacement(double angle, Field& u) const = 0;
  virtual void velocity(double angle, Field& v) const = 0;
  [[nodiscard]] virtual std::vector<double> save_wheel() const = 0;
  virtual void restore_wheel(std::span<const double> numbers) = 0;
  /// What this wheel keeps beside rim and wheel, where the rim moves.
  [[nodiscard]] virtual std::vector<double> save_aside() const { return {}; }
  /// Called last. @param numbers all that follow those of wheel and rim
  virtual void restore_aside(std::span<const double> /*numbers*/) {}

  void step(dynamics::StepReport& report);
  [[nodiscard]] bool is_viscous() const noexcept { return n_sums_ > 0; }
  void report_contact(const WheelOutcome& wheel, dynamics::ContactReport& report);
  void count(const WheelOutcome& wheel, double seconds);
  void fill(dynamics::State& state) const;

  const OneBlasThread one_blas_thread_;  ///< products are too small for more
  const double law_residual_;
  const std::vector<std::size_t> candidates_;  ///< (N C) of the contact nodes
  WheelFigures& figures_;
  const std::size_t n_sums_;  ///< numbers of the sums of a viscous wheel
  dynamics::Ledger ledger_;
  MaterialSums sums_;  ///< of a viscous wheel
  std::vector<dynamics::ActiveContact> active_;
};

}  // namespace rondo::rom
