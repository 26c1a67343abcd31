// SPDX-License-Identifier: BSD-3-Clause
/// @file  The step of a wheel in three dimensions on a loaded rim: that of the plane
/// (integrators/general/wheel_integrator.hpp) with absolute velocities along the axle as well.
#pragma once
#include "rondo/integrators/solid/solid_contacts.hpp"
#include "rondo/integrators/solid/solid_forces.hpp"
#include "rondo/integrators/solid/solid_rim.hpp"
#include "rondo/model/integrator.hpp"

namespace rondo::dynamics {

class SolidWheelIntegrator final : public Integrator, public Resumable {
 public:
  /// @pre model.solid and model.rim, the scheme "symplectic"
  SolidWheelIntegrator(const Model& model, const State& start);

  void advance(std::span<StepReport> reports, State* last = nullptr) noexcept override;
  void fields(State& state) const noexcept override;
  [[nodiscard]] Resumable* resumable() noexcept override { return this; }
  [[nodiscard]] SavedState save() const override;
  void restore(const SavedState& saved) override;

 private:
  StepReport step() noexcept;
  void move(StepEnergy& energy) noexcept;
  ContactReport push(Vec3 gravity, Vec3& force, double& moment) noexcept;
  void find_next() noexcept;
  void add_works(Vec3 gravity, Works& works) const noexcept;
  [[nodiscard]] Vec3 arm(std::size_t k) const noexcept {
    return Vec3(model_.reference[k], model_.solid->axial[k]) + u_[k];
  }
  /// Velocities of the half steps before and after, as the rim sees them [m/s].
  [[nodiscard]] Vec3 relative_before(std::size_t k) const noexcept {
    return (u_[k] - before_[k]) / model_.dt;
  }
  [[nodiscard]] Vec3 relative_after(std::size_t k) const noexcept {
    return (next_[k] - u_[k]) / model_.dt;
  }

  const Model& model_;
  long long step_;
  SolidRim rim_;
  std::vector<Vec3> before_, u_, next_;  ///< u_n, u_{n+1}, u_{n+2}
  std::vector<Vec3> v_, v_next_;         ///< absolute, in the axes of R_{n+1}                 [m/s]
  std::vector<Vec3> absolute_;           ///< V of the half step after, axes of the wheel      [m/s]
  SolidForces forces_;
  SolidContacts contacts_;
  Ledger ledger_;
};

}  // namespace rondo::dynamics
