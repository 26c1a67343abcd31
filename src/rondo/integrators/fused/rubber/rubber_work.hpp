// SPDX-License-Identifier: BSD-3-Clause
/// @file  Strain energy of the ledger where there is rubber: what was done against the internal
/// forces, from U(u_0) on (docs/rubber.md, section 3). With it the balance closes whatever the
/// force is; whether the force is that of the energy is told beside.
#pragma once
#include <span>
#include <vector>

#include "rondo/core/sum.hpp"
#include "rondo/integrators/fused/rubber/rubber_forces.hpp"
#include "rondo/integrators/fused/step_context.hpp"
#include "rondo/model/integrator.hpp"

namespace rondo::dynamics {

class RubberWork {
 public:
  RubberWork(const Model& model, const State& start);

  /// Sets the strain energy of the half step before, and adds the work of the step at t_{n+1}.
  MaterialReport add(const RubberEnergy& energy, WholeStep& step) noexcept;
  /// Does the same with a loaded rim.
  MaterialReport add(const RubberEnergy& energy, const StepSums& sums, StepEnergy& step) noexcept;

  [[nodiscard]] std::vector<double> save() const;
  void restore(std::span<const double> numbers);
  /// The first two of SavedState::window.
  void save_window(std::span<double> numbers) const noexcept;
  void restore_window(std::span<const double> numbers) noexcept;

 private:
  template <class Vec>
  void begin(double stored, const State& start);
  MaterialReport report(const RubberEnergy& energy, double linear, double work) noexcept;

  const Model& model_;
  /// Without a loaded rim at the last half step, from v̄·f of whole steps; with one at t_n. [J/m]
  CompensatedSum work_;
  CompensatedSum window_;       ///< W, of a wheel with a window [J]
  CompensatedSum dissipation_;  ///< to the end of the last step's half step after [J/m]
};

}  // namespace rondo::dynamics
