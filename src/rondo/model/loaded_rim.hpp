// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rim that is a rigid body (docs/theory.md, section 10): center and spin at t_n and, as
/// differences, half a step before and after; each degree of freedom is free under loads or
/// prescribed by a table. Nodes see the rim by increments; bonded nodes are part of it.
#pragma once
#include <span>
#include <vector>

#include "rondo/core/sum.hpp"
#include "rondo/model/integrator.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Larger rotations per step cannot be recovered from differences of positions [rad].
inline constexpr double most_turn = 0.3;

/// Action of the internal forces q of the free nodes on the rim, in the co-rotating frame.
template <class Vec>
struct RimForceOf {
  Vec force;            ///< Σ q                                                    [N/m], [N]
  double moment = 0.0;  ///< Σ y × q about the axle, y = X + u                      [N], [N·m]
};
using RimForce = RimForceOf<Vec2>;

class LoadedRim {
 public:
  /// The rim at t = 0. The model must outlive it. @pre model.rim
  explicit LoadedRim(const Model& model) noexcept;

  /// Computes velocity and spin at t_{1/2}, half a step after t = 0.
  void start(const RimForce& q) noexcept;
  /// Moves to the next t_{n+1}; frame() is then valid there except for `turn` and `advance`.
  void move() noexcept;
  /// Velocity and spin half a step later: `turn`, `advance` of frame(), report(), energy().
  void take(const RimForce& q) noexcept;

  [[nodiscard]] const FrameStep& frame() const noexcept { return frame_; }
  /// ċ at the half steps before and after t_{n+1}, fixed frame                         [m/s]
  [[nodiscard]] Vec2 velocity_before() const noexcept { return velocity_before_; }
  [[nodiscard]] Vec2 velocity() const noexcept { return velocity_; }
  /// s = sin(δ)/Δt at the same half steps, counter-clockwise                           [rad/s]
  [[nodiscard]] double spin_before() const noexcept { return spin_before_; }
  [[nodiscard]] double spin() const noexcept { return spin_; }
  /// e^{iδ} - 1 at the same half steps, without cancellation.
  [[nodiscard]] Complex turn_before() const noexcept { return turn_minus_one(spin_before_); }
  [[nodiscard]] Complex turn() const noexcept { return turn_minus_one(spin_); }

  /// Acceleration of gravity at t_{n+1}, in the co-rotating frame                      [m/s²]
  [[nodiscard]] Vec2 gravity() const noexcept;
  /// u_{n+2} - u_{n+1} of a node. @param arm X + u_{n+1} [m]
  /// @param velocity V of the half step after, in the axes of R_{n+1} [m/s]
  [[nodiscard]] Vec2 travel(Vec2 arm, Vec2 velocity) const noexcept;
  /// V at the half step in between, in the axes of R_n, of a node that moves from u_n by `travel`.
  [[nodiscard]] Vec2 velocity_of(Vec2 arm, Vec2 travel) const noexcept;
  /// The motion in the plane in which the wheel turns: all of it.
  [[nodiscard]] const LoadedRim& plane() const noexcept { return *this; }

  /// The rim's energies half a step before t_{n+1}, and its works in the step.
  [[nodiscard]] const StepEnergy& energy() const noexcept { return energy_; }
  [[nodiscard]] const RimReport& report() const noexcept { return report_; }

  static constexpr std::size_t n_numbers = 12;  ///< size of what save() returns

  /// Call before move(): the numbers from which another rim of this model resumes bit for bit.
  [[nodiscard]] std::vector<double> save() const;
  /// @param step the last one made. @pre `saved` comes from save()
  void restore(long long step, std::span<const double> saved);

 private:
  [[nodiscard]] Complex turn_minus_one(double spin) const noexcept;
  [[nodiscard]] Vec2 held_velocity(double from) const noexcept;
  [[nodiscard]] double held_spin(double from) const noexcept;
  /// Advances velocity and spin by the time h.
  void advance(const RimForce& q, double h) noexcept;
  void advance_spin(double moment, double h) noexcept;

  const Model& model_;
  const RimBody& rim_;
  long long step_ = 0;
  CompensatedSum x_, y_, angle_;
  Vec2 velocity_before_, velocity_;
  double spin_before_ = 0.0, spin_ = 0.0;
  double turn_ = 0.0;  ///< δ = arcsin(Δt s) of the following half step                        [rad]
  FrameStep frame_;
  StepEnergy energy_;
  RimReport report_;
};

/// The part of the nodal forces on clamped nodes, which acts on the rim. @param load (n), or empty
/// [N/m]
[[nodiscard]] RimForce pressure_on_rim(const Model& model, std::span<const Vec2> load) noexcept;

}  // namespace rondo::dynamics
