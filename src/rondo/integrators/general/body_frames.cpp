// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/body_frames.hpp"

#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {

FrameStep fixed_frame_step(const Model& model, long long n) noexcept {
  FrameStep f;
  f.time = static_cast<double>(n) * model.dt;
  f.rotation = {1.0, 0.0};
  f.pull = Vec2{} - model.motion.gravity_at(f.time);
  return f;
}

BodyFrame::BodyFrame(const Model& model, const FrameStep& f) noexcept
    : frame(f),
      update(velocity_update(model.scheme, model.dt, model.mass_damping, f.spin)),
      contact(model, f, update) {}

BodyFrames::BodyFrames(const Model& model, const FrameStep& turning) noexcept
    : turning_(model, turning),
      fixed_(model, fixed_frame_step(model, std::llround(turning.time / model.dt))) {
  RONDO_ASSERT(model.dt > 0.0 && turning.time >= 0.0, model.dt, turning.time);
}

}  // namespace rondo::dynamics
