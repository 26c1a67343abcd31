// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a step of the slip asks of a wheel, before it rolls on (docs/steady.md, Relaxation
/// lengths): its speed after the step, and how many steps of a sample its distance takes.
#pragma once
#include <string>

#include "rondo/case/case.hpp"

namespace rondo::study {

/// The largest number of steps, of one sample each, that analysis.step_distance may take.
inline constexpr int most_slip_steps = 20'000;

/// The speed at which dynamics::slip_ratio() is so much. @param rim ωR, of any sign [m/s].
/// @pre |ratio| < 1
[[nodiscard]] double speed_of_slip(double ratio, double rim);

/// The wheel that takes the step.
struct SteppedWheel {
  double radius = 0.0;  ///< outer, undeformed                          [m]
  int samples = 0;      ///< of a turn
};

/// The speed of the center after the step [m/s]. With a traction or a torque the case does not give
/// it, and the speed of the rim takes its place. @throws InputError: the slip ratio would be 1 or
/// more, or -1 or less
[[nodiscard]] double speed_after_step(const Case& c, const SteppedWheel& wheel);

/// @throws InputError: analysis.step_distance takes more steps than there may be at this speed
void refuse_many_steps(const Case& c, const SteppedWheel& wheel, double speed);

/// What `check` tells.
[[nodiscard]] std::string told_of_steps(const Case& c, const SteppedWheel& wheel);

}  // namespace rondo::study
