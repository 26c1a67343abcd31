// SPDX-License-Identifier: BSD-3-Clause
/// @file  The readable step on a loaded rim of a wheel in three dimensions
/// (general/wheel_step.hpp): that of the plane with absolute velocities along the axle as well.
#pragma once
#include "rondo/integrators/general/wheel_step.hpp"
#include "rondo/integrators/solid/solid_contacts.hpp"
#include "rondo/integrators/solid/solid_forces.hpp"
#include "rondo/model/solid/solid_rim.hpp"

namespace rondo::dynamics {

struct SpaceWheel {
  using Vec = Vec3;
  using Forces = SolidForces;
  using Rim = SolidRim;
  struct Contacts : SolidContacts {
    using SolidContacts::SolidContacts;
    /// With absolute velocities, as in PlaneWheel.
    ContactReport solve(const Model& model, State& state) noexcept {
      return SolidContacts::solve(SolidContactStep(model, state.frame), state);
    }
  };
};
extern template class WheelStep<SpaceWheel>;

class SolidWheelIntegrator final : public WheelStep<SpaceWheel> {
  using WheelStep::WheelStep;
};

}  // namespace rondo::dynamics
