// SPDX-License-Identifier: BSD-3-Clause
/// @file  Forces on the nodes of a wheel in three dimensions, in the co-rotating frame, as the
/// readable steps take them: K u, or those of a wheel that is not linear about its state; stiffness
/// damping, pressures (docs/wheel3d.md, docs/tyre.md).
#pragma once
#include <span>
#include <vector>

#include "rondo/core/sum.hpp"
#include "rondo/core/vec3.hpp"
#include "rondo/model/internal_work.hpp"
#include "rondo/model/loaded_rim.hpp"
#include "rondo/model/solid/swept_part.hpp"
#include "rondo/model/viscous_branches.hpp"

namespace rondo::dynamics {

class SolidForces {
 public:
  /// The model must outlive it. @param start u_0: evaluate() begins with u_1
  SolidForces(const Model& model, const State& start);

  /// Forces at u_{n+1}. @return strain energy of the half step before, ½ u_{n+1}ᵀ K u_n; with
  /// nonlinear cords or viscous branches the work A_n + ½ f_n·(u_{n+1} - u_n) that their forces
  /// took so far [J]
  double evaluate(std::span<const Vec3> u, std::span<const Vec3> v,
                  const FrameStep& frame) noexcept;
  [[nodiscard]] Vec3 gradient(std::size_t k) const noexcept { return now_[k]; }
  /// β (K u_{n+1} - K u_n)/Δt, without viscous branches, which have their own loss.
  [[nodiscard]] Vec3 damping(std::size_t k) const noexcept {
    Vec3 change = now_[k] - before_[k];
    if (branches_) change -= branches_->force()[k] - branches_->force_before()[k];
    return model_.stiffness_damping / model_.dt * change;
  }
  /// Force of the pressures on any node, clamped or not; 0 where there are no pressures.
  [[nodiscard]] Vec3 load(std::size_t k) const noexcept {
    return load_.empty() ? Vec3{} : load_[k];
  }

  /// Action of the loads on the rim. Pressures act on undeformed faces, so that their forces round
  /// the axle cancel; along the axle nothing moves the rim but its tables. What is left is the
  /// moment of the forces of the state at rest.
  [[nodiscard]] RimForceOf<Vec3> on_rim() const noexcept { return {{}, moment_}; }
  [[nodiscard]] MaterialReport material() const noexcept { return report_; }

  void save(SavedState& saved) const;
  void restore(const SavedState& saved);

 private:
  [[nodiscard]] bool keeps_work() const noexcept { return swept_ || branches_; }
  /// Forces at u, without those of branches. @return the energy that is stored there, if the work
  /// is kept; else 0 [J]
  double find(std::span<const Vec3> u, double angle) noexcept;
  double add_work(std::span<const Vec3> u, double stored) noexcept;

  const Model& model_;
  std::vector<Vec3> now_, before_, load_;
  std::vector<Vec3> rest_;  ///< (n) forces of the state at rest on the nodes; empty: none [N]
  double moment_ = 0.0;     ///< on the rim, at u_{n+1} [N m]
  std::optional<SweptWheel> swept_;
  std::optional<ViscousBranches<fem::SolidSector>> branches_;
  // With either of them:
  InternalWork<Vec3> work_;     ///< A [J]
  CompensatedSum window_work_;  ///< W [J]
  CompensatedSum loss_;         ///< of the branches [J]
  MaterialReport report_;
};

/// (n) Forces of the state at rest on the nodes, in the co-rotating frame; empty: none [N].
[[nodiscard]] std::vector<Vec3> rest_forces(const Model& model);

/// Their moment on the rim, with the nodes displaced by u [N m].
[[nodiscard]] double rest_moment(std::span<const Vec3> rest, std::span<const Vec3> u) noexcept;

/// Forces of the model's pressures at a time, (n) in the co-rotating frame [N].
void solid_pressure_forces(const Model& model, double time, std::span<Vec3> load) noexcept;

}  // namespace rondo::dynamics
