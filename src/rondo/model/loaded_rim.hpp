// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rim that is a rigid body (docs/theory.md, section 10): its center and its spin, each
/// degree of freedom free under loads or held by a table, at t_n and, as differences, half a step
/// before and after. What the nodes feel of it are increments: the bonded nodes are part of it.
#pragma once
#include <span>
#include <vector>

#include "rondo/core/sum.hpp"
#include "rondo/model/integrator.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Turns in a step above this are no longer seen in differences of places [rad].
inline constexpr double most_turn = 0.3;

/// What the internal forces q of the free nodes do to the rim, co-rotating frame.
struct RimForce {
  Vec2 force;           ///< Σ q                                                         [N/m]
  double moment = 0.0;  ///< Σ y × q about the center, y = X + u                            [N]
};

class LoadedRim {
 public:
  /// At t = 0. The model must outlive it. @pre model.rim
  explicit LoadedRim(const Model& model) noexcept;

  /// Velocity and spin at t_{1/2}: half a step from t = 0.
  void start(const RimForce& q) noexcept;
  /// To the next t_{n+1}: frame() is its, without `turn` and `advance`.
  void move() noexcept;
  /// Velocity and spin of the half step after: `turn` and `advance` of frame(), report(), energy().
  void take(const RimForce& q) noexcept;

  [[nodiscard]] const FrameStep& frame() const noexcept { return frame_; }
  /// ċ of the half steps before and after t_{n+1}, fixed frame                         [m/s]
  [[nodiscard]] Vec2 velocity_before() const noexcept { return velocity_before_; }
  [[nodiscard]] Vec2 velocity() const noexcept { return velocity_; }
  /// s = sin(δ)/Δt of the same, counter-clockwise                                      [rad/s]
  [[nodiscard]] double spin_before() const noexcept { return spin_before_; }
  [[nodiscard]] double spin() const noexcept { return spin_; }
  /// e^{iδ} - 1 of the same, without cancellation.
  [[nodiscard]] Complex turn_before() const noexcept { return turn_minus_one(spin_before_); }
  [[nodiscard]] Complex turn() const noexcept { return turn_minus_one(spin_); }

  /// The rim's energies half a step before t_{n+1}, and its works in the step.
  [[nodiscard]] const StepEnergy& energy() const noexcept { return energy_; }
  [[nodiscard]] const RimReport& report() const noexcept { return report_; }

  static constexpr std::size_t n_numbers = 12;  ///< of what is saved

  /// Before move(): what another one of the same model goes on with, to the same bits.
  [[nodiscard]] std::vector<double> save() const;
  /// @param step the last one made. @pre `saved` is of save()
  void restore(long long step, std::span<const double> saved);

 private:
  [[nodiscard]] Complex turn_minus_one(double spin) const noexcept;
  [[nodiscard]] Vec2 held_velocity(double from) const noexcept;
  [[nodiscard]] double held_spin(double from) const noexcept;
  /// By the time h, from what was before.
  void advance(const RimForce& q, double h) noexcept;
  void advance_spin(double moment, double h) noexcept;

  const Model& model_;
  const RimBody& rim_;
  long long step_ = 0;
  CompensatedSum x_, y_, angle_;
  Vec2 velocity_before_, velocity_;
  double spin_before_ = 0.0, spin_ = 0.0;
  double turn_ = 0.0;  ///< δ = arcsin(Δt s) of the half step after                      [rad]
  FrameStep frame_;
  StepEnergy energy_;
  RimReport report_;
};

/// Of forces on the nodes those on clamped ones, which the rim feels. @param load (n), or empty
/// [N/m]
[[nodiscard]] RimForce pressure_on_rim(const Model& model, std::span<const Vec2> load) noexcept;

/// u_{n+2} - u_{n+1} of a node. @param arm X + u_{n+1} [m]
/// @param velocity V of the half step after, in the axes of R_{n+1} [m/s]
[[nodiscard]] Vec2 travel_on_rim(const LoadedRim& rim, double dt, Vec2 arm, Vec2 velocity) noexcept;

/// V of the half step between, in the axes of R_n, of a node that goes from u_n by `travel`.
[[nodiscard]] Vec2 velocity_on_rim(const LoadedRim& rim, double dt, Vec2 arm, Vec2 travel) noexcept;

}  // namespace rondo::dynamics
