// SPDX-License-Identifier: BSD-3-Clause
/// @file  The readable step on a loaded rim in the plane (wheel_step.hpp).
#pragma once
#include <vector>

#include "rondo/integrators/general/general_contact.hpp"
#include "rondo/integrators/general/plane_forces.hpp"
#include "rondo/integrators/general/wheel_step.hpp"

namespace rondo::dynamics {

struct PlaneWheel {
  using Vec = Vec2;
  using Forces = PlaneForces;
  using Rim = LoadedRim;
  struct Contacts : GeneralContact {
    using GeneralContact::GeneralContact;
    /// With absolute velocities: v_next of `state`, without contact, becomes that with it.
    ContactReport solve(const Model& model, State& state);
    [[nodiscard]] const contact::KeptImpulses& impulses() const noexcept { return coupled().kept; }
    void set_impulses(const contact::KeptImpulses& impulses) { coupled().kept = impulses; }
  };
};
extern template class WheelStep<PlaneWheel>;

class WheelIntegrator final : public WheelStep<PlaneWheel> {
 public:
  using WheelStep::WheelStep;
  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() override {
    return contacts_.coupled().difficult.take();
  }
};

}  // namespace rondo::dynamics
