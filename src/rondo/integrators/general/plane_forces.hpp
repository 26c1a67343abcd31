// SPDX-License-Identifier: BSD-3-Clause
/// @file  Forces on the nodes in the plane, in the frame in which a node moves, as the readable
/// steps use them: those of the deformation (model/internal_force.hpp), stiffness damping and
/// pressures. SolidForces (integrators/solid) is the counterpart in three dimensions.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "rondo/model/internal_force.hpp"
#include "rondo/model/loaded_rim.hpp"

namespace rondo::dynamics {

class PlaneForces {
 public:
  /// The model must outlive it. @param start u_0 and, of free bodies, poses
  PlaneForces(const Model& model, const State& start);

  /// Forces at u_{n+1}. @param v v_{n+1/2}, relative to the rim
  /// @return strain energy of the half step before                                  [J/m]
  double evaluate(std::span<const Vec2> u, std::span<const Vec2> v,
                  const FrameStep& frame) noexcept;
  /// Derivative of the strain energy with respect to the position of a node: minus the force [N/m]
  [[nodiscard]] Vec2 gradient(std::size_t k) const noexcept { return gradient_[k]; }
  /// β times the rate of the gradient                                                   [N/m]
  [[nodiscard]] Vec2 damping(std::size_t k) const noexcept {
    return damping_.empty() ? Vec2{} : damping_[k];
  }
  /// Force of the pressures; 0 where there are none.
  [[nodiscard]] Vec2 load(std::size_t k) const noexcept {
    return load_.empty() ? Vec2{} : load_[k];
  }
  /// Action of the pressures on the rim, by the clamped nodes.
  [[nodiscard]] RimForce on_rim() const noexcept { return pressure_on_rim(model_, load_); }
  [[nodiscard]] std::span<const Pose> poses() const noexcept { return internal_->poses(); }
  [[nodiscard]] MaterialReport material() const noexcept { return internal_->material(); }

  void save(SavedState& saved) const { internal_->save(saved); }
  void restore(const SavedState& saved) { internal_->restore(saved); }

 private:
  const Model& model_;
  const std::unique_ptr<InternalForce> internal_;
  std::span<const Vec2> gradient_;  ///< (n) at the last u
  std::vector<Vec2> damping_;       ///< (n); empty: β = 0
  std::vector<Vec2> load_;          ///< (n); empty: no pressures
};

}  // namespace rondo::dynamics
