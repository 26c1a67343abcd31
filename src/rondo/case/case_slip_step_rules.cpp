// SPDX-License-Identifier: BSD-3-Clause
/// Rules of a step of the slip in steady rolling (docs/cases.md).
#include <fmt/format.h>

#include <cmath>

#include "rondo/case/case_rules.hpp"

namespace rondo::study {
namespace {

constexpr std::string_view angle_step = "analysis.slip_angle_step",
                           ratio_step = "analysis.slip_ratio_step",
                           step_distance = "analysis.step_distance";

/// What the rows of a step cannot do.
void check_stepped_wheel(CaseValues& in, const Case& c, std::string_view step) {
  if (!is_solid(c))
    in.fault(step, "is of wheels in three dimensions, and this body is plane",
             "a disk.width; or a dynamic analysis with tables in [motion]");
  if (c.analysis.slip != RollingSlip::upwind)
    in.fault("analysis.slip",
             fmt::format("a wheel that rolls on after {} counts its ways from one sample before, "
                         "by one formula alone",
                         step),
             "\"upwind\"");
  if (c.inflation && c.inflation->nonlinear != TyreMotion::linear)
    in.fault("inflation.nonlinear",
             fmt::format("a wheel that rolls on after {} has linear forces", step),
             "\"none\"; or a dynamic analysis with tables in [motion]");
}

void check_step_size(CaseValues& in, const Case& c, std::string_view step) {
  const AnalysisCase& a = c.analysis;
  if (!in.good({step})) return;
  if ((step == angle_step ? *a.slip_angle_step : *a.slip_ratio_step) == 0.0)
    in.fault(step, "is 0: nothing changes", "a small change that is not 0");
  if (step == angle_step && in.good({"motion.slip_angle"}) &&
      !(std::abs(c.motion.slip_angle.at(0.0) + *a.slip_angle_step) < 1.5))
    in.fault(step, "leads to a slip angle of 1.5 rad or more", "a smaller change");
  if (step == ratio_step && (a.traction || a.torque))
    in.fault(step, "the slip ratio follows from the traction or the torque",
             "motion.speed instead of analysis.traction or analysis.torque; or " +
                 std::string(angle_step));
}

}  // namespace

void check_slip_step(CaseValues& in, const Case& c) {
  const bool turns = in.has(angle_step), slips = in.has(ratio_step);
  if (in.has(step_distance) && !turns && !slips)
    in.fault(step_distance, "is given without a step",
             fmt::format("{} or {} as well", angle_step, ratio_step));
  if (!turns && !slips) return;
  const std::string_view step = turns ? angle_step : ratio_step;
  if (turns && slips)
    in.fault(ratio_step, fmt::format("is given together with {}", angle_step), "one of them");
  if (!in.has(step_distance))
    in.fault(step_distance, fmt::format("is missing, and {} is given", step),
             "a distance of some relaxation lengths, for a tyre 3 m");
  check_stepped_wheel(in, c, step);
  check_step_size(in, c, step);
}

}  // namespace rondo::study
