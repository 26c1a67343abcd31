// SPDX-License-Identifier: BSD-3-Clause
/// @file  The step of a wheel in three dimensions whose rim follows its tables, a readable pass a
/// term (docs/wheel3d.md): the reference that the fused one (integrators/fused/solid) is held to.
/// The scheme is that of the plane (docs/theory.md, section 3), its axial part without rotation.
#pragma once
#include "rondo/integrators/solid/solid_contacts.hpp"
#include "rondo/integrators/solid/solid_forces.hpp"
#include "rondo/model/integrator.hpp"

namespace rondo::dynamics {

class SolidIntegrator final : public Integrator, public Resumable {
 public:
  /// @pre model.solid, no loaded rim, the scheme "symplectic"
  SolidIntegrator(const Model& model, const State& start);

  void advance(std::span<StepReport> reports, State* last = nullptr) noexcept override;
  void fields(State& state) const noexcept override;
  [[nodiscard]] Resumable* resumable() noexcept override { return this; }
  [[nodiscard]] SavedState save() const override;
  void restore(const SavedState& saved) override;

 private:
  StepReport step() noexcept;
  void move(StepEnergy& energy) noexcept;
  void free_velocities(const VelocityUpdate& update, double axial_a) noexcept;
  void add_works(Works& works) const noexcept;
  [[nodiscard]] Vec3 arm(std::size_t k) const noexcept {
    return Vec3(model_.reference[k], model_.solid->axial[k]) + u_[k];
  }
  [[nodiscard]] Vec3 acceleration_of_frame(std::size_t k) const noexcept {
    return {frame_acceleration(frame_, arm(k).plane()), frame_.pull.z};
  }

  const Model& model_;
  long long step_;
  FrameStep frame_;
  std::vector<Vec3> u_, v_, v_next_;
  SolidForces forces_;
  SolidContacts contacts_;
  Ledger ledger_;
};

}  // namespace rondo::dynamics
