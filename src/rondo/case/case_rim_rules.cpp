// SPDX-License-Identifier: BSD-3-Clause
/// Rules of [rim]: a free degree of freedom has a load and no table, a prescribed one the reverse
/// (docs/cases.md).
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "rondo/case/case_rules.hpp"

namespace rondo::study {
namespace {

using dynamics::RimBody;
using dynamics::Table;

bool is_below_zero(const Table& table) {
  return std::ranges::any_of(table.points(), [](const auto& point) { return point[1] < 0.0; });
}

bool is_above_zero(const Table& table) {
  return std::ranges::any_of(table.points(), [](const auto& point) { return point[1] > 0.0; });
}

/// A load on a degree of freedom.
struct Load {
  std::string_view key;
  std::string_view dof;  ///< as in rim.free
  bool is_free;
  bool is_zero;
};

void check_loads(CaseValues& in, const RimBody& rim) {
  const dynamics::RimSupport &x = rim.support_x, &y = rim.support_y;
  const Load loads[] = {
      {"rim.force_x", "speed", rim.free_x, rim.force_x.largest() == 0.0},
      {"rim.force_y", "height", rim.free_y, rim.force_y.largest() == 0.0},
      {"rim.torque", "angular_velocity", rim.free_spin, rim.torque.largest() == 0.0},
      {"rim.brake", "angular_velocity", rim.free_spin, rim.brake.largest() == 0.0},
      {"rim.support.x.stiffness", "speed", rim.free_x, x.stiffness == 0.0},
      {"rim.support.x.damping", "speed", rim.free_x, x.damping == 0.0},
      {"rim.support.y.stiffness", "height", rim.free_y, y.stiffness == 0.0},
      {"rim.support.y.damping", "height", rim.free_y, y.damping == 0.0},
  };
  for (const auto& [key, dof, is_free] : {std::tuple{"rim.support.x.at", "speed", rim.free_x},
                                          std::tuple{"rim.support.y.at", "height", rim.free_y}})
    if (!is_free && in.has(key))
      in.fault(key,
               fmt::format("has no effect, because motion.{} is held: it is not in rim.free", dof),
               fmt::format("no such key, or rim.free with \"{}\"", dof));
  for (const Load& load : loads)
    if (!load.is_free && !load.is_zero)
      in.fault(
          load.key,
          fmt::format("has no effect, because motion.{} is held: it is not in rim.free", load.dof),
          fmt::format("0, or rim.free with \"{}\"", load.dof));
}

void check_start(CaseValues& in, std::string_view dof, const Table& motion) {
  const std::string key = fmt::format("motion.{}", dof);
  const auto& points = motion.points();
  if (!in.good({key}) || (points.size() == 1 && points[0][0] == 0.0)) return;
  in.fault(key, "is a table, but rim.free names it: forces determine it",
           fmt::format("a number, the value at t = 0; or rim.free without \"{}\"", dof));
}

void check_inertia(CaseValues& in, std::string_view key, std::string_view what) {
  if (!in.has(key))
    in.fault(key, fmt::format("is missing: rim.free has {}", what),
             fmt::format("{}; that of the bonded nodes is added to it",
                         allowed_text(*find_case_key(key))));
}

void check_free(CaseValues& in, const Case& c) {
  const RimBody& rim = *c.rim;
  check_loads(in, rim);
  if (rim.free_x) check_start(in, "speed", c.motion.speed);
  if (rim.free_y) check_start(in, "height", c.motion.height);
  if (rim.free_spin) check_start(in, "angular_velocity", c.motion.angular_velocity);
  if (rim.free_x || rim.free_y)
    check_inertia(in, "rim.mass",
                  rim.free_x && rim.free_y ? "\"speed\" and \"height\""
                  : rim.free_x             ? "\"speed\""
                                           : "\"height\"");
  if (rim.free_spin) check_inertia(in, "rim.inertia", "\"angular_velocity\"");
}

void warn(Case& c) {
  const RimBody& rim = *c.rim;
  const bool is_pressed = is_below_zero(rim.force_y) || is_above_zero(c.motion.gravity) ||
                          rim.support_y.stiffness > 0.0;
  if (rim.free_y && c.ground && !is_pressed)
    c.warnings.emplace_back(
        "rim.free has \"height\", and nothing presses the wheel on the ground: rim.force_y is "
        "never below 0, motion.gravity never above 0, and rim.support.y has no stiffness");
  if (rim.free_spin && c.stress_stiffening != StressStiffening::none)
    c.warnings.emplace_back(
        "material.stress_stiffening: the stress stays that of the spin at t = 0, although the rim "
        "is free to turn faster or slower");
}

}  // namespace

void check_rim(CaseValues& in, Case& c) {
  if (!c.rim || !in_time.contain(c.analysis.kind)) return;
  if (!in.has("rim.support.x.at")) c.rim->support_x.at = c.motion.start_x;
  if (!in.has("rim.support.y.at")) c.rim->support_y.at = c.motion.height.at(0.0);
  if (!in.has("rim.free") || !in.good({"rim.free"})) return;
  check_free(in, c);
  warn(c);
}

}  // namespace rondo::study
