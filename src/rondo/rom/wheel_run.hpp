// SPDX-License-Identifier: BSD-3-Clause
/// @file  The steps of a reduced wheel with exact contact (wheel/ring_wheel.hpp) with the interface
/// of a full run, on a rim that follows its tables or moves freely.
#pragma once
#include "rondo/rom/reduced_run.hpp"
#include "rondo/rom/wheel/ring_wheel.hpp"

namespace rondo::rom {

class WheelRun final : public ReducedRun {
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

 private:
  const WheelOutcome& make_step(dynamics::Works& works) override;
  void report_forces(dynamics::ContactReport& report) override;
  void contact_displacement(double angle, Field& u) const override {
    wheel_.contact_displacement(angle, u);
  }
  void displacement(double angle, Field& u) const override { wheel_.displacement(angle, u); }
  void velocity(double angle, Field& v) const override { wheel_.velocity(angle, v); }
  [[nodiscard]] std::vector<double> save_wheel() const override { return wheel_.save(); }
  void restore_wheel(std::span<const double> numbers) override { wheel_.restore(numbers); }

  RingWheel wheel_;
  WheelReport report_;  ///< of the last step
};

}  // namespace rondo::rom
