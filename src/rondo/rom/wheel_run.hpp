// SPDX-License-Identifier: BSD-3-Clause
/// @file  The steps of a reduced wheel with exact contact (wheel/ring_wheel.hpp) with the interface
/// of a full run, on a rim that follows its tables or moves freely.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "rondo/core/process_wide.hpp"
#include "rondo/model/integrator.hpp"
#include "rondo/rom/wheel/material_sums.hpp"
#include "rondo/rom/wheel/ring_wheel.hpp"
#include "rondo/rom/wheel/whole_mesh.hpp"

namespace rondo::rom {

/// Effort of the steps so far.
struct WheelFigures {
  long long contact_steps = 0;
  long long iterations = 0;  ///< of the contact law, all steps
  int iterations_max = 0, contacts_max = 0;
  long long pivoted = 0;        ///< steps in which Newton's method did not end
  long long not_converged = 0;  ///< steps whose contact law is not met to 1e-9, or whose brake
                                ///< does not hold
  long long late_friction = 0;  ///< steps whose μ is that by the step before
  double spin_max = 0.0;        ///< largest |s| of a rim that moves                     [rad/s]
  double wall_s = 0.0, slowest_step_s = 0.0;
};

/// Spins up to which the residual of a wheel is to be known [rad/s].
struct KnownSpins {
  double least = 0.0;
  double most = 0.0;    ///< where no spin up to it is critical
  bool change = false;  ///< false: the spin is always `least`, or its opposite
};
/// What a viscous material adds to the model of a wheel.
struct WheelViscosity {
  std::vector<fem::ViscousBranch> branches{};  ///< the same ones in all of the body; none: elastic
  double stiffness_damping = 0.0;              ///< β beside them [s]
};
/// Sets the branches of a wheel and its creep.
void take_viscosity(const WheelViscosity& viscosity, WheelModel& wheel);

/// Finds the tables of a wheel: one for a spin that stays; else three between 0 and the largest,
/// where a polynomial in s² errs least (Chebyshev). @param residual by s²
void spread_residuals(const KnownSpins& spins, WheelModel& wheel,
                      const std::function<CreepResidual(double)>& residual);

/// @param whole of a ring of one sector (whole_mesh.hpp); of others null
[[nodiscard]] WheelModel make_wheel_model(const Ring& ring, std::vector<RingHarmonic> harmonics,
                                          const KnownSpins& spins, const WholeMesh* whole = nullptr,
                                          const WheelViscosity& viscosity = {});

class WheelRun final : public dynamics::Integrator, public dynamics::Resumable {
 public:
  /// All but the state must outlive it. @param model dt: that of the reduced step
  /// @param at_start u and v at t = 0, co-rotating frame; what is outside of the modes is lost
  WheelRun(const dynamics::Model& model, const Ring& ring, const WheelModel& wheel,
           WheelFigures& figures, const dynamics::State& at_start);

  /// Number of numbers in SavedState::ring.
  [[nodiscard]] static std::size_t n_numbers(const dynamics::Model& model, const Ring& ring,
                                             const WheelModel& wheel) noexcept;
  /// Whether numbers may come from save() of a run of this wheel.
  [[nodiscard]] static bool is_saved(const dynamics::Model& model, const Ring& ring,
                                     const WheelModel& wheel,
                                     std::span<const double> numbers) noexcept;
  /// Calls WheelRim::lead(). @pre the model has a rim
  void lead(const RimVector& end) noexcept { rim_->lead(end); }
  [[nodiscard]] const WheelRim* rim() const noexcept { return rim_ ? &*rim_ : nullptr; }

  void advance(std::span<dynamics::StepReport> reports,
               dynamics::State* last = nullptr) noexcept override;
  void fields(dynamics::State& state) const noexcept override;
  [[nodiscard]] Resumable* resumable() noexcept override { return this; }
  [[nodiscard]] dynamics::SavedState save() const override;
  void restore(const dynamics::SavedState& saved) override;

 private:
  [[nodiscard]] WheelMotion motion_of(long long step) const;
  void begin(const dynamics::State& at_start);
  void step(dynamics::StepReport& report);
  [[nodiscard]] bool is_viscous() const noexcept { return n_sums_ > 0; }
  [[nodiscard]] dynamics::StepEnergy energy_of(const WheelEnergy& wheel) const;
  void count(const WheelReport& wheel, double seconds);
  void report_contact(const WheelReport& wheel, dynamics::ContactReport& report) const;
  [[nodiscard]] int node_of(int contact_node) const noexcept;
  void fill(dynamics::State& state) const;

  const OneBlasThread one_blas_thread_;  ///< products are too small for more
  const dynamics::Model& model_;
  const Ring& ring_;
  WheelFigures& figures_;
  std::vector<int> candidate_;  ///< (n) place among the candidates; -1: none
  RingWheel wheel_;
  const std::size_t n_sums_;  ///< numbers of the sums of a viscous wheel
  std::optional<WheelRim> rim_;
  dynamics::Ledger ledger_;
  MaterialSums sums_;  ///< of a viscous wheel
  long long n_ = 0;    ///< number of steps made
  dynamics::FrameStep frame_;
  std::vector<dynamics::ActiveContact> active_;
};

}  // namespace rondo::rom
