// SPDX-License-Identifier: BSD-3-Clause
/// @file  A step of the slip angle or the slip ratio of a wheel that rolls steadily, and how it
/// rolls on (docs/steady.md, Relaxation lengths; docs/theory.md, 11.6).
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "rondo/analysis/steady/step_speed.hpp"
#include "rondo/case/case.hpp"
#include "rondo/core/column.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/statics/steady/rolling_transient.hpp"

namespace rondo::study {

/// The wheel at a distance from the step.
struct SlipStepRow {
  double distance = 0.0;  ///< rolled since the step [m]
  statics::RollingForces forces;
  double height = 0.0, speed = 0.0;           ///< of the center above the ground [m]; [m/s]
  double slip_ratio = 0.0, slip_angle = 0.0;  ///< [-], [rad]
};

struct SlipStep {
  std::vector<SlipStepRow> rows;  ///< the first before the step; then one for each sample
  SlipStepRow after;              ///< of steady rolling after the step
  double sliding = 0.0;           ///< share of the load on what slides there              [-]
  double radius = 0.0;            ///< of the wheel                                        [m]
  double residual = 0.0;          ///< of the law, largest of all                          [-]
  std::string trouble{};          ///< empty: all was solved
};

/// The state in which the step begins.
struct BeforeStep {
  const statics::RollingWindow<3>& window;  ///< of "upwind"
  const statics::RollingDrive& drive;
  const statics::RollingSolution& solution;
  SteppedWheel wheel;
};

[[nodiscard]] inline bool has_slip_step(const Case& c) noexcept {
  return c.analysis.slip_angle_step || c.analysis.slip_ratio_step;
}
/// Rolls on over analysis.step_distance. @throws InputError: it is too far at the speed that is
/// found
[[nodiscard]] SlipStep roll_after_step(const Case& c, const BeforeStep& before);

/// Writes slip-step.csv. @throws FileError
[[nodiscard]] io::CsvPlace write_slip_step(const SlipStep& step,
                                           const std::filesystem::path& directory);
void add_slip_step(const Case& c, const SlipStep& step, Json& json);
/// What the user is told.
[[nodiscard]] std::vector<std::string> notes_of(const Case& c, const SlipStep& step);
[[nodiscard]] std::vector<std::string> warnings_of(const Case& c, const SlipStep& step);
/// The columns of slip-step.csv.
std::vector<ColumnLabel> slip_step_labels();
std::vector<MemberText> slip_step_members();

}  // namespace rondo::study
