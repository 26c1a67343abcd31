// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/step_speed.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/model/motion.hpp"

namespace rondo::study {
namespace {

double rim_speed_of(const Case& c, const SteppedWheel& wheel) {
  return c.motion.angular_velocity.at(0.0) * wheel.radius;
}

bool gives_speed(const Case& c) noexcept {
  return !c.analysis.traction && !c.analysis.torque;
}

/// How far a wheel rolls in a step of a sample [m].
double way_of_step(const Case& c, const SteppedWheel& wheel, double speed) {
  return std::abs(speed) * 2.0 * std::numbers::pi /
         (wheel.samples * std::abs(c.motion.angular_velocity.at(0.0)));
}

/// Infinite where it stands.
double steps_of(const Case& c, const SteppedWheel& wheel, double speed) {
  return std::ceil(*c.analysis.step_distance / way_of_step(c, wheel, speed));
}

/// At a ratio of 1 the wheel spins on one spot, at -1 it slides without turning.
void refuse_wide_slip(const Case& c, double before, double step) {
  if (std::abs(before + step) < 1.0) return;
  throw case_error(
      c, "analysis.slip_ratio_step",
      fmt::format("takes the slip ratio from {:.4g} to {:.4g}, where wheel and ground no longer "
                  "roll on each other",
                  before, before + step),
      fmt::format("a sum between -1 and 1: a step > {:.4g} and < {:.4g}", -1.0 - before,
                  1.0 - before));
}

}  // namespace

double speed_of_slip(double ratio, double rim) {
  RONDO_DEMAND(std::abs(ratio) < 1.0, ratio);
  const bool is_rim_faster = std::signbit(rim) ? ratio <= 0.0 : ratio >= 0.0;
  return is_rim_faster ? rim * (1.0 - std::abs(ratio)) : rim / (1.0 - std::abs(ratio));
}

double speed_after_step(const Case& c, const SteppedWheel& wheel) {
  const double rim = rim_speed_of(c, wheel), given = c.motion.speed.at(0.0);
  if (!gives_speed(c)) return rim;
  if (!c.analysis.slip_ratio_step) return given;
  const double ahead = std::cos(c.motion.slip_angle.at(0.0));
  const double before = dynamics::slip_ratio(rim, given * ahead),
               step = *c.analysis.slip_ratio_step;
  refuse_wide_slip(c, before, step);
  return speed_of_slip(before + step, rim) / ahead;
}

void refuse_many_steps(const Case& c, const SteppedWheel& wheel, double speed) {
  constexpr double most = most_slip_steps;
  if (steps_of(c, wheel, speed) <= most) return;
  const double way = way_of_step(c, wheel, speed);
  if (!(way > 0.0))
    throw case_error(c, "analysis.step_distance",
                     "the wheel does not roll on: its speed after the step is 0",
                     "a motion.speed other than 0");
  throw case_error(
      c, "analysis.step_distance",
      fmt::format("takes {:.4g} steps of a sample, {:.4g} m each at {:.4g} m/s",
                  steps_of(c, wheel, speed), way, speed),
      fmt::format(
          "at most {:.0f} steps, which are {:.4g} m{}{}", most, most * way,
          c.analysis.samples_per_sector > 1 ? "; or fewer analysis.samples_per_sector" : "",
          c.analysis.slip_ratio_step ? "; or a step that leaves the wheel more speed" : ""));
}

std::string told_of_steps(const Case& c, const SteppedWheel& wheel) {
  const bool is_given = gives_speed(c);
  return fmt::format("{:.4g} m rolled after it, {}{:.0f} steps, {} a turn",
                     *c.analysis.step_distance, is_given ? "" : "about ",
                     steps_of(c, wheel, speed_after_step(c, wheel)), wheel.samples);
}

}  // namespace rondo::study
