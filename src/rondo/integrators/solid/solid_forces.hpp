// SPDX-License-Identifier: BSD-3-Clause
/// @file  Forces on the nodes of a wheel in three dimensions, in the turning frame, as the readable
/// steps take them: K u, stiffness damping, pressures (docs/wheel3d.md).
#pragma once
#include <span>
#include <vector>

#include "rondo/core/vec3.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// A vector a node: those in the plane of the wheel, and their axial components.
struct SolidField {
  std::vector<Vec2> plane;
  std::vector<double> axial;

  SolidField() = default;
  explicit SolidField(std::size_t n) : plane(n), axial(n) {}
  [[nodiscard]] Vec3 at(std::size_t k) const noexcept { return {plane[k], axial[k]}; }
  void put(std::size_t k, Vec3 value) noexcept {
    plane[k] = value.plane();
    axial[k] = value.z;
  }
};

inline SolidField field_of(const std::vector<Vec2>& plane, const std::vector<double>& axial) {
  SolidField field;
  field.plane = plane;
  field.axial = axial;
  return field;
}

class SolidForces {
 public:
  /// The model must outlive it. @param u u_n: evaluate() begins with u_{n+1}
  SolidForces(const Model& model, const SolidField& u);

  /// K u_{n+1}; what was there becomes K u_n.
  void evaluate(const SolidField& u, double time) noexcept;
  [[nodiscard]] Vec3 gradient(std::size_t k) const noexcept { return now_.at(k); }
  /// K u_n.
  [[nodiscard]] Vec3 gradient_before(std::size_t k) const noexcept { return before_.at(k); }
  /// β (K u_{n+1} - K u_n)/Δt.
  [[nodiscard]] Vec3 damping(std::size_t k) const noexcept {
    return model_.stiffness_damping / model_.dt * (now_.at(k) - before_.at(k));
  }
  /// Of pressures; also on clamped nodes, where there are none in the sector: 0.
  [[nodiscard]] Vec3 load(std::size_t k) const noexcept {
    return load_.plane.empty() ? Vec3{} : load_.at(k);
  }

  /// K u_{n+1}: what another one goes on with.
  [[nodiscard]] const SolidField& saved() const noexcept { return now_; }
  void restore(SolidField saved) noexcept { now_ = std::move(saved); }

 private:
  const Model& model_;
  SolidField now_, before_, load_;
};

/// Forces of the model's pressures at a time, (n) in the turning frame [N].
void solid_pressure_forces(const Model& model, double time, SolidField& load) noexcept;

}  // namespace rondo::dynamics
