// SPDX-License-Identifier: BSD-3-Clause
/// @file  The step of a wheel in three dimensions whose rim follows its tables, a readable pass a
/// term (docs/wheel3d.md): the reference that the fused one (integrators/fused/solid) is held to.
/// The scheme is that of the plane (docs/theory.md, section 3), its axial part without rotation.
#pragma once
#include "rondo/integrators/general/readable_step.hpp"
#include "rondo/integrators/solid/solid_contacts.hpp"
#include "rondo/integrators/solid/solid_forces.hpp"

namespace rondo::dynamics {

class SolidIntegrator final : public ReadableStep {
 public:
  /// @pre model.solid, no loaded rim, the scheme "symplectic"
  SolidIntegrator(const Model& model, const State& start);

 private:
  void make_step(StepEnergy& energy, StepReport& report) noexcept override;
  void save_fields(SavedState& saved) const override;
  void restore_fields(const SavedState& saved) override;
  void move(StepEnergy& energy) noexcept;
  void free_velocities(const VelocityUpdate& update, double axial_a) noexcept;
  void add_works(Works& works) const noexcept;
  [[nodiscard]] Vec3 acceleration_of_frame(Vec3 u, std::size_t k) const noexcept {
    const Vec3 arm = reference_of<Vec3>(model_, k) + u;
    return {frame_acceleration(state_.frame, arm.plane()), state_.frame.pull.z};
  }

  SolidForces forces_;
  SolidContacts contacts_;
};

}  // namespace rondo::dynamics
