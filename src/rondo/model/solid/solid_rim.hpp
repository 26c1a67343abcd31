// SPDX-License-Identifier: BSD-3-Clause
/// @file  A loaded rim (model/loaded_rim.hpp) under a wheel in three dimensions: it moves along t1
/// and n and turns about the axle as loads and tables say; along t2 it follows the slip angle.
/// Nothing else of it turns (docs/wheel3d.md). Under a disk it is the rim of the plane, to the bit.
#pragma once
#include "rondo/core/vec3.hpp"
#include "rondo/model/loaded_rim.hpp"

namespace rondo::dynamics {

class SolidRim {
 public:
  /// The model must outlive it. @pre model.rim
  explicit SolidRim(const Model& model) noexcept;

  // These do what LoadedRim does under the same names; vectors are in the co-rotating frame.
  void start(const RimForceOf<Vec3>& q) noexcept;
  void move() noexcept;
  void take(const RimForceOf<Vec3>& q) noexcept;
  [[nodiscard]] Vec3 gravity() const noexcept;

  /// With its lateral numbers.
  [[nodiscard]] const FrameStep& frame() const noexcept { return frame_; }
  /// ċ of the half steps before and after, axes of the wheel [m/s]
  [[nodiscard]] Vec3 velocity_before() const noexcept;
  [[nodiscard]] Vec3 velocity() const noexcept;
  [[nodiscard]] const LoadedRim& plane() const noexcept { return rim_; }
  /// Works along t2 among those that hold the rim.
  [[nodiscard]] StepEnergy energy() const noexcept;

  [[nodiscard]] Vec3 travel(Vec3 arm, Vec3 velocity) const noexcept;
  [[nodiscard]] Vec3 velocity_of(Vec3 arm, Vec3 travel) const noexcept;

  [[nodiscard]] std::vector<double> save() const { return rim_.save(); }
  void restore(long long step, std::span<const double> saved);

 private:
  [[nodiscard]] Vec3 on_ground(Vec3 force) const noexcept;
  [[nodiscard]] RimForce in_plane(const RimForceOf<Vec3>& q) const noexcept;
  /// Lateral velocity of the half step from t on [m/s].
  [[nodiscard]] double lateral_rate(double t) const noexcept;

  const Model& model_;
  GroundFrame ground_;
  LoadedRim rim_;
  FrameStep frame_;
  double lateral_before_, lateral_;  ///< ċ along t2                                 [m/s]
  double lateral_force_ = 0.0;       ///< Σ q along t2                               [N]
};

}  // namespace rondo::dynamics
