// SPDX-License-Identifier: BSD-3-Clause
/// @file  Forces on the nodes of a wheel in three dimensions, in the co-rotating frame, as the
/// readable steps take them: K u, stiffness damping, pressures (docs/wheel3d.md).
#pragma once
#include <span>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/vec3.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

class SolidForces {
 public:
  /// The model must outlive it. @param u u_n: evaluate() begins with u_{n+1}
  SolidForces(const Model& model, std::span<const Vec3> u);

  /// K u_{n+1}; what was there becomes K u_n.
  void evaluate(std::span<const Vec3> u, double time) noexcept;
  [[nodiscard]] Vec3 gradient(std::size_t k) const noexcept { return now_[k]; }
  /// K u_n.
  [[nodiscard]] Vec3 gradient_before(std::size_t k) const noexcept { return before_[k]; }
  /// β (K u_{n+1} - K u_n)/Δt.
  [[nodiscard]] Vec3 damping(std::size_t k) const noexcept {
    return model_.stiffness_damping / model_.dt * (now_[k] - before_[k]);
  }
  /// Force of the pressures on any node, clamped or not; 0 where there are no pressures.
  [[nodiscard]] Vec3 load(std::size_t k) const noexcept {
    return load_.empty() ? Vec3{} : load_[k];
  }

  /// K u_{n+1}: what another one goes on with.
  [[nodiscard]] const std::vector<Vec3>& saved() const noexcept { return now_; }
  void restore(std::span<const Vec3> saved) {
    RONDO_DEMAND(saved.size() == model_.n_nodes(), saved.size(), model_.n_nodes());
    now_.assign(saved.begin(), saved.end());
  }

 private:
  const Model& model_;
  std::vector<Vec3> now_, before_, load_;
};

/// Forces of the model's pressures at a time, (n) in the co-rotating frame [N].
void solid_pressure_forces(const Model& model, double time, std::span<Vec3> load) noexcept;

}  // namespace rondo::dynamics
