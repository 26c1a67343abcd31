// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/slip_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/model/motion.hpp"

namespace rondo::study {
namespace {

using statics::RollingDrive;
using statics::RollingEnd;
using statics::RollingSolution;
using statics::RollingWindow;

/// A wheel that rolls more slowly on its way than at its end makes more steps than were foreseen:
/// no more than this.
constexpr std::size_t most_rows = 2 * most_slip_steps;

/// The part of the load that is carried where friction is at its limit, over all samples.
double sliding_share(const RollingSolution& s) {
  double all = 0.0, sliding = 0.0;
  for (std::size_t k = 0; k < s.status.size(); ++k) {
    const double force = s.force[3 * static_cast<Eigen::Index>(k)];
    all += force;
    if (s.status[k].status == contact::Status::slip) sliding += force;
  }
  return sliding / all;
}

class Roller {
 public:
  Roller(const Case& c, const BeforeStep& before)
      : case_(c), before_(before), rim_speed_(rim_speed()), drive_(before.drive) {
    const AnalysisCase& a = c.analysis;
    drive_.slip_angle += a.slip_angle_step.value_or(0.0);
    if (a.slip_ratio_step) drive_.speed = speed_after_step(c, before.wheel);
  }

  SlipStep roll();

 private:
  [[nodiscard]] double rim_speed() const noexcept {
    return -before_.window.harmonics().body().spin * before_.wheel.radius;
  }
  [[nodiscard]] double slip_ratio(double speed, const RollingDrive& drive) const noexcept {
    return dynamics::slip_ratio(rim_speed_, speed * std::cos(drive.slip_angle));
  }
  [[nodiscard]] SlipStepRow row_of(double distance, const RollingSolution& s,
                                   const RollingDrive& drive) const {
    return {distance, s.forces, s.height, s.speed, slip_ratio(s.speed, drive), drive.slip_angle};
  }
  bool find_after(SlipStep& step) const;
  [[nodiscard]] std::string trouble(const RollingSolution& s, const std::string& where) const;

  const Case& case_;
  const BeforeStep& before_;
  double rim_speed_;  ///< ωR [m/s]
  RollingDrive drive_;
};

std::string Roller::trouble(const RollingSolution& s, const std::string& where) const {
  std::string found = fmt::format("the contact was not solved, residual {:.3g}", s.residual);
  if (!s.friction.solved)
    found = fmt::format(
        "the coefficients of ground.friction did not settle, the largest still changes by {:.2g}",
        s.friction.change);
  if (s.end == RollingEnd::sliding) found = "the whole contact slides, which leaves the speed open";
  if (s.end == RollingEnd::no_contact) found = "nothing touches the ground";
  return fmt::format(
      "{}, {}: {}; a smaller step, or another analysis.samples_per_sector",
      case_.analysis.slip_angle_step ? "analysis.slip_angle_step" : "analysis.slip_ratio_step",
      where, found);
}

/// The state to which the wheel rolls, found at once.
bool Roller::find_after(SlipStep& step) const {
  RollingWindow<3> window = before_.window;
  const RollingSolution s = statics::solve_rolling_from(window, drive_, before_.solution);
  step.after = row_of(0.0, s, drive_);
  if (s.end != RollingEnd::solved) {
    step.trouble = trouble(s, "steady rolling after it");
    return false;
  }
  step.sliding = sliding_share(s);
  refuse_many_steps(case_, before_.wheel, s.speed);
  return true;
}

SlipStep Roller::roll() {
  const RollingWindow<3>& steady = before_.window;
  const double camber = case_.motion.camber, gravity = case_.motion.gravity.at(0.0);
  RollingWindow<3> window(steady.harmonics(), statics::SlipDifference::transient, camber, gravity);
  window.include(steady.pairs());
  RollingSolution s = before_.solution;
  SlipStep step{
      .rows = {row_of(0.0, s, before_.drive)}, .after = {}, .radius = before_.wheel.radius};
  if (!find_after(step)) return step;
  for (double distance = 0.0; distance < *case_.analysis.step_distance;) {
    s = statics::roll_on(window, drive_, s);
    distance += std::abs(s.speed) * window.time();
    const std::string where = fmt::format("{:.4g} m after it", distance);
    if (s.end != RollingEnd::solved) step.trouble = trouble(s, where);
    if (step.rows.size() > most_rows)
      step.trouble = fmt::format(
          "analysis.step_distance = {:.4g} m is more than {} samples: {}; a smaller one",
          *case_.analysis.step_distance, most_rows, where);
    if (!step.trouble.empty()) break;
    step.residual = std::max(step.residual, s.residual);
    step.rows.push_back(row_of(distance, s, drive_));
  }
  return step;
}

}  // namespace

SlipStep roll_after_step(const Case& c, const BeforeStep& before) {
  return Roller(c, before).roll();
}

}  // namespace rondo::study
