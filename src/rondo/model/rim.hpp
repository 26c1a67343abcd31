// SPDX-License-Identifier: BSD-3-Clause
/// @file  The rim, which carries the turning frame: where it is in each step. A rim that is driven
/// follows its tables; one that moves under load may know a single step ahead, once it has taken
/// what the body does to it.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// What the body's internal forces do to the rim in a step, turning frame.
struct RimImpulse {
  Vec2 impulse;                  ///< [N·s/m]
  double angular_impulse = 0.0;  ///< about the center                                [N·s]
};

class Rim {
 public:
  virtual ~Rim() = default;
  Rim() = default;
  Rim(const Rim&) = delete;
  Rim& operator=(const Rim&) = delete;

  /// The frame at t = 0.
  [[nodiscard]] virtual FrameStep start() const noexcept = 0;
  /// The frame of the next step.
  virtual FrameStep next() noexcept = 0;
  /// Before next(), where steps_ahead() is 1.
  virtual void take(const RimImpulse&) noexcept {}
  /// How often next() may be called before the first of these steps is made.
  [[nodiscard]] virtual int steps_ahead() const noexcept = 0;

  /// What it carries beside the number of the step, for restore() of a rim of the same model.
  [[nodiscard]] virtual std::vector<double> save() const { return {}; }
  /// @param step the last one made. @pre `saved` is of save() after it, or a start: empty
  virtual void restore(long long step, std::span<const double> saved) = 0;
};

/// Angle and center are tables of time (motion.hpp).
class DrivenRim final : public Rim {
 public:
  /// @param motion must outlive it. @param dt Δt [s]
  DrivenRim(const Motion& motion, double dt) noexcept : motion_(motion), dt_(dt) {}

  [[nodiscard]] FrameStep start() const noexcept override { return frame_step(motion_, 0, dt_); }
  FrameStep next() noexcept override { return frame_step(motion_, ++step_, dt_); }
  [[nodiscard]] int steps_ahead() const noexcept override { return 64; }
  void restore(long long step, std::span<const double> saved) override;

 private:
  const Motion& motion_;
  const double dt_;
  long long step_ = 0;
};

/// The rim that the model says. The model must outlive it.
[[nodiscard]] std::unique_ptr<Rim> make_rim(const Model& model);

}  // namespace rondo::dynamics
