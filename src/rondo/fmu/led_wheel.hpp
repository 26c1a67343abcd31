// SPDX-License-Identifier: BSD-3-Clause
/// @file  The steps of a reduced wheel whose hub is led, in the plane or in three dimensions, and
/// what the hub feels in an interval of them: equations (F.1), (F.2) and (F.3) of docs/fmu.md.
#pragma once
#include <array>
#include <memory>
#include <string>

#include "rondo/analysis/reduced/prepare_wheel.hpp"
#include "rondo/case/setup.hpp"
#include "rondo/fmu/values.hpp"
#include "rondo/rom/solid_wheel_run.hpp"

namespace rondo::fmu {

/// Velocities of the hub that are inputs; of a plane wheel those of its plane.
[[nodiscard]] rom::HubVelocity velocities(const Values& v) noexcept;

class LedWheel {
 public:
  virtual ~LedWheel() = default;
  LedWheel(const LedWheel&) = delete;
  LedWheel& operator=(const LedWheel&) = delete;

  /// Begins an interval of steps. @param from velocities of the hub at its start
  virtual void begin(const rom::HubVelocity& from) = 0;
  /// Makes a step to these velocities at its end. Allocates nothing.
  virtual const dynamics::StepReport& step(const rom::HubVelocity& to) = 0;
  /// Writes the means over the steps of the interval and the places at its end.
  /// @param height of the ground's zero [m]. @param width by which forces of a metre are multiplied
  virtual void fill(double height, double width, Values& to) const = 0;
  /// Mass, and inertia about the axle and about a diameter, of a rim without mass and the body,
  /// undeformed; of a metre of width in the plane.
  virtual void weigh(Values& to) const;
  /// What is wrong with where the hub is, in words; empty: nothing. @param rim its radius [m]
  [[nodiscard]] virtual std::string misplaced(double rim) const = 0;

  [[nodiscard]] dynamics::SavedState save() const { return run().save(); }
  void restore(const dynamics::SavedState& saved) { run().restore(saved); }

 protected:
  /// @param model must outlive it
  explicit LedWheel(const dynamics::Model& model) noexcept : model_(model) {}

  /// What makes its steps.
  [[nodiscard]] virtual rom::ReducedRun& run() noexcept = 0;
  [[nodiscard]] virtual const rom::ReducedRun& run() const noexcept = 0;
  void make_step() { run().advance(report_); }
  [[nodiscard]] const dynamics::StepReport& last() const noexcept { return report_[0]; }
  [[nodiscard]] const rom::WheelRim& rim() const noexcept { return *run().rim(); }

  const dynamics::Model& model_;

 private:
  std::array<dynamics::StepReport, 1> report_;
};

/// The wheel at t = 0. All must outlive it. @param values velocities and place of the hub
[[nodiscard]] std::unique_ptr<LedWheel> led_wheel(const study::Setup& setup,
                                                  study::PreparedWheel& wheel,
                                                  const dynamics::State& start,
                                                  const Values& values);

}  // namespace rondo::fmu
