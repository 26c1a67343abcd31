// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/ground/ground_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/analysis/build/ground/friction_rise.hpp"
#include "rondo/analysis/build/ground/road_reach.hpp"
#include "rondo/case/case_keys.hpp"

namespace rondo::study {
namespace {

using contact::FrictionPatch;
using contact::Obstacle;
using contact::ObstacleKind;

std::string_view name_of(ObstacleKind kind) {
  if (kind == ObstacleKind::step) return "step";
  return kind == ObstacleKind::cleat ? "cleat" : "pothole";
}

/// Whether the body is known not to come to a stretch of the ground.
bool is_missed(const Stretch& reach, double from, double to) {
  return std::isfinite(reach.from) && (reach.to < from || reach.from > to);
}

void warn_of_missed(const std::string& key, std::string_view what, const Stretch& reach, Setup& s) {
  s.warnings.push_back(
      fmt::format("{}: the body does not come to the {}: it comes to x = {:.4g} to {:.4g} m by the "
                  "tables of [motion]; give another place, in m, or a longer time.end",
                  key, what, reach.from, reach.to));
}

/// Half of the width of a wheel; 0 of a plane body                                          [m]
double half_width(const Setup& s) {
  double half = 0.0;
  if (s.mesh.is_solid())
    for (const double z : s.mesh.axial) half = std::max(half, std::abs(z));
  return half;
}

void tell_obstacles(const Case& c, const Stretch& reach, Setup& s) {
  for (std::size_t k = 0; k < c.ground->obstacles.size(); ++k) {
    const Obstacle& o = c.ground->obstacles[k];
    const double length = o.kind == ObstacleKind::step ? 0.0 : o.length / std::cos(o.angle);
    std::string text =
        fmt::format("a {} of {:.4g} m at x = {:.6g}", name_of(o.kind), o.height, o.at);
    if (length > 0.0) text += fmt::format(" to {:.6g}", o.at + length);
    text += " m";
    if (o.angle != 0.0) text += fmt::format(", at {:.3g} rad", o.angle);
    s.figures.emplace_back("obstacle", text);
    const double aside = std::abs(std::tan(o.angle)) * half_width(s);
    const double end = o.kind == ObstacleKind::step  // behind it is another level
                           ? std::numeric_limits<double>::infinity()
                           : o.at + length + aside;
    if (is_missed(reach, o.at - aside, end))
      warn_of_missed(item_of("ground.obstacle", k), name_of(o.kind), reach, s);
  }
}

/// Sides are those of the line t2 = 0 on the ground, which a wheel with a slip angle leaves.
void warn_of_drift(const Case& c, std::size_t k, Setup& s) {
  if (c.ground->friction.patches[k].side == contact::Side::both || !s.mesh.is_solid()) return;
  const double drift = c.motion.center(c.time.end).z, half = half_width(s);
  if (!(std::abs(drift) > 0.5 * half)) return;
  s.warnings.push_back(fmt::format(
      "ground.patch[{}].side: the wheel drifts by {:.3g} m to the {} until the end, more than a "
      "quarter of its width: left and right are those of the line on the ground along which it "
      "begins, not of the wheel; give a smaller motion.slip_angle, or a shorter time.end",
      k, std::abs(drift), drift > 0.0 ? "right" : "left"));
}

void tell_patches(const Case& c, const Stretch& reach, Setup& s) {
  const auto& patches = c.ground->friction.patches;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const FrictionPatch& patch = patches[k];
    const std::string_view side = patch.side == contact::Side::both   ? ""
                                  : patch.side == contact::Side::left ? " on the left"
                                                                      : " on the right";
    s.figures.emplace_back("friction", fmt::format("times {:.4g} from x = {:.6g} to {:.6g} m{}",
                                                   patch.factor, patch.from, patch.to, side));
    if (is_missed(reach, patch.from, patch.to))
      warn_of_missed(item_of("ground.patch", k), "patch", reach, s);
    warn_of_drift(c, k, s);
  }
}

void tell_friction_table(const contact::FrictionTable& table, Setup& s) {
  if (table.slip.empty() && table.pressure_exponent == 0.0) return;
  std::string text = fmt::format("{:.4g}", table.coefficient);
  if (!table.slip.empty()) {
    const auto [low, high] =
        std::ranges::minmax(table.slip, {}, [](const auto& point) { return point[1]; });
    text += fmt::format(", times {:.4g} to {:.4g} by the slip speed", low[1], high[1]);
  }
  if (const double k = table.pressure_exponent; k != 0.0)
    text += fmt::format(", times {:.4g} at {:.3g} Pa and below to {:.4g} at {:.3g} Pa and above",
                        std::pow(0.1, k), 0.1 * table.pressure_reference, std::pow(10.0, k),
                        10.0 * table.pressure_reference);
  s.figures.emplace_back("friction", text);
}

void warn_of_unknown_pressures(const Case& c, Setup& s) {
  if (c.initial.state == InitialState::steady_rolling &&
      c.ground->friction.pressure_exponent != 0.0)
    s.warnings.push_back(
        "initial.state: the first step does not know the pressures of a step before it, and takes "
        "a tenth of ground.friction.pressure_reference: its tangential force is that of another "
        "coefficient");
}

}  // namespace

void tell_ground(const Case& c, Steps steps, Setup& s) {
  if (!c.ground || !s.model.contact || c.analysis.kind != AnalysisKind::dynamic) return;
  const Stretch reach = reach_along(c, s.mesh);
  tell_obstacles(c, reach, s);
  tell_friction_table(c.ground->friction, s);
  tell_patches(c, reach, s);
  if (steps != Steps::of_full_run) return;
  tell_friction_rise(c, s);
  warn_of_unknown_pressures(c, s);
}

}  // namespace rondo::study
