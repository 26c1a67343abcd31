// SPDX-License-Identifier: BSD-3-Clause
/// @file  The steps of a reduced wheel in three dimensions (solid/solid_wheel.hpp) with the
/// interface of a full run; what wheel_run.hpp does for a disk.
#pragma once
#include <optional>
#include <vector>

#include "rondo/rom/reduced_run.hpp"
#include "rondo/rom/solid/solid_wheel.hpp"

namespace rondo::rom {

/// Velocities of a hub that is led from outside.
struct HubVelocity {
  Vec3 along;         ///< along the heading, out of the ground, and to the right        [m/s]
  double spin = 0.0;  ///< s, counter-clockwise                                        [rad/s]
  double camber_rate = 0.0, yaw_rate = 0.0;  ///< of WheelAttitude                        [rad/s]
};

/// What the tables do not say of a hub that is led, at t = 0.
struct HubStart {
  double aside = 0.0;                        ///< place of the center along t2                [m]
  double camber_rate = 0.0, yaw_rate = 0.0;  ///< [rad/s]
};

/// What a hub felt in the last step; along its heading, out of the ground, and to the right.
struct HubReport {
  Vec3 held;            ///< force that held it against the ground and the inertia of the wheel [N]
  double torque = 0.0;  ///< torque that held its spin, counter-clockwise                  [N m]
  Vec3 force;           ///< mean force of the ground                                        [N]
  Vec3 moment;          ///< and its moment about the center                               [N m]
};

class SolidWheelRun final : public ReducedRun {
 public:
  /// All but the state must outlive it. @param model dt: that of the reduced step
  /// @param at_start u and v at t = 0, co-rotating frame; what is outside of the modes is lost
  SolidWheelRun(const dynamics::Model& model, const SolidRing& ring, const WheelModel& wheel,
                double law_residual, WheelFigures& figures, const dynamics::State& at_start,
                const HubStart& hub = {});

  /// Number of numbers in SavedState::ring.
  [[nodiscard]] static std::size_t n_numbers(const dynamics::Model& model, const SolidRing& ring,
                                             const WheelModel& wheel) noexcept;
  /// Whether numbers may come from save() of a run of this wheel.
  [[nodiscard]] static bool is_saved(const dynamics::Model& model, const SolidRing& ring,
                                     const WheelModel& wheel,
                                     std::span<const double> numbers) noexcept;

  /// In this and all later steps the hub has these velocities at the end of the step and approaches
  /// them linearly, whatever the tables say. @pre the model has a rim, of which nothing is free
  void lead(const HubVelocity& end) noexcept { led_ = end; }
  [[nodiscard]] const HubReport& hub() const noexcept { return hub_; }
  /// Camber and yaw after the last step [rad].
  [[nodiscard]] double camber() const noexcept { return camber_; }
  [[nodiscard]] double yaw() const noexcept { return yaw_; }

 private:
  const WheelOutcome& make_step(dynamics::Works& works) override;
  void report_forces(dynamics::ContactReport& report) override;
  [[nodiscard]] dynamics::StepEnergy energy_of(const WheelEnergy& wheel) const override;
  void contact_displacement(double angle, Field& u) const override {
    wheel_.contact_displacement(angle, u);
  }
  void displacement(double angle, Field& u) const override { wheel_.displacement(angle, u); }
  void velocity(double angle, Field& v) const override { wheel_.velocity(angle, v); }
  [[nodiscard]] std::vector<double> save_wheel() const override { return wheel_.save(); }
  void restore_wheel(std::span<const double> numbers) override { wheel_.restore(numbers); }
  [[nodiscard]] std::vector<double> save_aside() const override;
  void restore_aside(std::span<const double> numbers) override;

  [[nodiscard]] SolidMotion in_space(const WheelMotion& plane, long long step) const;
  void step_on_rim(dynamics::Works& works);
  void turn_hub(SolidMotion& motion);
  void set_frame(const SolidMotion& motion);
  [[nodiscard]] double lateral_rate(double t) const;

  SolidWheel wheel_;
  SolidWheelReport report_;    ///< of the last step
  const double aside_;         ///< place of the center along t2 at t = 0          [m]
  double camber_, yaw_ = 0.0;  ///< [rad]
  // Of a hub that is led:
  std::optional<HubVelocity> led_;
  double camber_rate_, yaw_rate_;  ///< at the end of the last step                    [rad/s]
  HubReport hub_;
  // Along t2, of a rim that moves:
  double lateral_ = 0.0;           ///< velocity                                       [m/s]
  double lateral_momentum_ = 0.0;  ///< of the deformation                             [N s]
  double lateral_force_ = 0.0;     ///< of the ground at the end of the last step        [N]
};

}  // namespace rondo::rom
