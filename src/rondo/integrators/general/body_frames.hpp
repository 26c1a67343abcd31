// SPDX-License-Identifier: BSD-3-Clause
/// @file  The two frames in which nodes move: the turning one of the rim, and the fixed one of
/// bodies that nothing holds (docs/theory.md, section 9).
#pragma once
#include <array>

#include "rondo/model/contact_node.hpp"

namespace rondo::dynamics {

/// A frame in the step at t_{n+1}.
struct BodyFrame {
  BodyFrame(const Model& model, const FrameStep& frame) noexcept;
  BodyFrame(const FrameStep& of, const VelocityUpdate& by, const ContactStep& with) noexcept
      : frame(of), update(by), contact(with) {}

  FrameStep frame;
  VelocityUpdate update;
  ContactStep contact;
};

class BodyFrames {
 public:
  BodyFrames(const Model& model, const FrameStep& turning) noexcept;
  /// For models in which no body is free.
  explicit BodyFrames(const BodyFrame& turning) noexcept : turning_(turning), fixed_(turning) {}

  [[nodiscard]] const BodyFrame& of(const Model& model, std::size_t node) const noexcept {
    return in_fixed_frame(model, node) ? fixed_ : turning_;
  }

 private:
  BodyFrame turning_, fixed_;
};

/// The frame that never moves, with the gravity of the model, at t = n dt.
FrameStep fixed_frame_step(const Model& model, long long n) noexcept;

}  // namespace rondo::dynamics
