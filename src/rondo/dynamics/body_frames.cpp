// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/body_frames.hpp"

#include <cmath>

namespace rondo::dynamics {

FrameStep fixed_frame_step(const Model& model, long long n) noexcept {
  Motion still;
  still.gravity = model.motion.gravity;
  return frame_step(still, n, model.dt);
}

BodyFrame::BodyFrame(const Model& model, const FrameStep& f) noexcept
    : frame(f),
      update(velocity_update(model.scheme, model.dt, model.mass_damping, f.spin)),
      contact(model, f, update) {}

BodyFrames::BodyFrames(const Model& model, const FrameStep& turning) noexcept
    : turning_(model, turning),
      fixed_(model, fixed_frame_step(model, std::llround(turning.time / model.dt))) {}

}  // namespace rondo::dynamics
