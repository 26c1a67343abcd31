// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/wheel_integrator.hpp"

#include "rondo/integrators/general/body_frames.hpp"

namespace rondo::dynamics {

ContactReport PlaneWheel::Contacts::solve(const Model& model, State& state) {
  const FrameStep& frame = state.frame;
  const BodyFrames frames({frame, {{1.0, 0.0}, {0.0, 0.0}}, ContactStep(model, frame)});
  return GeneralContact::solve(frames, frame.center.plane(), state);
}

template class WheelStep<PlaneWheel>;

}  // namespace rondo::dynamics
