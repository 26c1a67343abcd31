// SPDX-License-Identifier: BSD-3-Clause
/// Rules of steady rolling: a disk of equal sectors on flat ground; either height or load, and one
/// of speed, traction and torque, is given (docs/cases.md).
#include <fmt/format.h>

#include <cmath>

#include "rondo/case/case_rules.hpp"

namespace rondo::study {
namespace {

void check_steady_body(CaseValues& in, const Case& c) {
  if (in.has_table("mesh"))
    in.fault("mesh", "is not known to have equal sectors, which steady rolling needs",
             "a [disk], smooth or treaded; of a mesh, a dynamic analysis");
  if (!c.mesh && c.free_rim)
    in.fault("disk.rim", "steady rolling needs a disk that is bonded to its rim", "\"bonded\"");
  const bool is_thin = is_generated(c) && !c.disk.tread && c.disk.radial < 2;
  if (is_thin && c.analysis.massless_contact && in.good({"disk.mesh.radial"}))
    in.fault("disk.mesh.radial", "the nodes below the contact nodes are held by the rim",
             "at least 2");
}

void check_constant(CaseValues& in, std::string_view key, const dynamics::Table& value) {
  if (in.good({key}) && value.points().size() > 1)
    in.fault(key, "is a table, but a steady state needs one value", "a number");
}

void check_steady_motion(CaseValues& in, const Case& c) {
  constexpr std::string_view spin = "motion.angular_velocity";
  check_constant(in, spin, c.motion.angular_velocity);
  check_constant(in, "motion.speed", c.motion.speed);
  check_constant(in, "motion.height", c.motion.height);
  check_constant(in, "motion.gravity", c.motion.gravity);
  check_constant(in, "motion.slip_angle", c.motion.slip_angle);
  if (in.has(spin) && in.good({spin}) && c.motion.angular_velocity.at(0.0) == 0.0)
    in.fault(spin, "a body that does not turn does not roll",
             is_solid(c) ? "not 0; analysis.kind = \"dynamic\" sets one down that is at rest"
                         : "not 0; analysis.kind = \"crush\" presses one that is at rest");
  if (c.motion.slope != 0.0)
    in.fault("motion.slope", "steady rolling does not support a slope", "0, or a dynamic analysis");
  for (std::size_t k = 0; k < c.pressures.size(); ++k)
    check_constant(in, item_of("load.pressure", k) + ".value", c.pressures[k].pressure);
}

/// Exactly one key of each pair must be given.
void check_given(CaseValues& in) {
  constexpr std::string_view height = "motion.height", load = "analysis.load",
                             speed = "motion.speed", traction = "analysis.traction",
                             torque = "analysis.torque";
  if (in.has(load) && in.has(height))
    in.fault(load, "is given together with motion.height: one follows from the other",
             "one of motion.height and analysis.load");
  if (!in.has(load) && !in.has(height))
    in.fault(height, "is missing, and so is analysis.load: one of them says how deep the body is",
             "one of motion.height and analysis.load");
  constexpr const char* one = "one of motion.speed, analysis.traction and analysis.torque";
  const std::string_view given[] = {speed, traction, torque};
  std::string_view first;
  for (const std::string_view key : given) {
    if (!in.has(key)) continue;
    if (!first.empty())
      in.fault(key, fmt::format("is given together with {}: one follows from the other", first),
               one);
    if (first.empty()) first = key;
  }
  if (first.empty())
    in.fault(speed, "is missing, and so are analysis.traction and analysis.torque", one);
}

void check_traction(CaseValues& in, const Case& c) {
  const AnalysisCase& a = c.analysis;
  if (!a.load || !a.traction || !c.ground || !in.good({"ground.friction"})) return;
  const double most = contact::largest_friction(c.ground->friction) * *a.load;
  if (!(std::abs(*a.traction) < most))
    in.fault("analysis.traction",
             "the whole contact would slide, which does not determine the speed",
             most > 0.0 ? fmt::format("> {0:.6g} and < {1:.6g}, {2} times analysis.load; or "
                                      "motion.speed instead",
                                      -most, most,
                                      c.ground->friction.is_constant()
                                          ? "ground.friction"
                                          : "the largest coefficient of ground.friction")
                        : std::string("motion.speed instead, because without friction no traction "
                                      "determines it; or ground.friction above 0"));
}

void check_samples(CaseValues& in, Case& c) {
  constexpr std::string_view samples = "analysis.samples_per_sector";
  AnalysisCase& a = c.analysis;
  const bool treaded = is_generated(c) && c.disk.tread.has_value();
  if (!in.has(samples) && is_solid(c))
    a.samples_per_sector = treaded ? 8 : c.section && !c.inflation ? 2 : 4;
  if (c.inflation && !in.has("analysis.inertia")) a.inertia = RollingMasses::waves;
  if (c.inflation && !in.has("analysis.estimate_slip_error")) a.estimate_slip_error = true;
  const bool rubs = !c.ground || contact::largest_friction(c.ground->friction) > 0.0;
  if (c.inflation && rubs && a.samples_per_sector == 1)
    c.warnings.emplace_back(
        "analysis.samples_per_sector = 1: a node that is seen closed for the first time counts as "
        "having stuck for a whole sector, and the lateral force of a tyre is too large; 4");
  if (!in.has(samples) && !is_solid(c) && treaded) a.samples_per_sector = 16;
  if (!a.massless_contact && a.samples_per_sector > 1)
    in.fault("analysis.massless_contact",
             fmt::format("with {} samples a sector, contact nodes with mass chatter",
                         a.samples_per_sector),
             "true, or analysis.samples_per_sector = 1");
}

constexpr std::string_view start = "initial.state";

void check_start_body(CaseValues& in, const Case& c) {
  if (c.mesh)
    in.fault(start,
             "a mesh from a file is not known to have equal sectors, which steady rolling needs",
             "\"stationary\", and a run long enough to settle; or a [disk]");
  if (!c.mesh && c.free_rim)
    in.fault(start, "a free body is not turned by a rim: it does not roll steadily", "\"rest\"");
  if (!c.mesh && !c.disk.tread && c.disk.radial < 2 && in.good({"disk.mesh.radial"}))
    in.fault("disk.mesh.radial",
             "a start in steady rolling moves the mass of the contact nodes to the nodes below "
             "them, which are held by the rim",
             "at least 2; or initial.state = \"stationary\"");
}

/// A quantity that changes at the start has no steady state; it may change later.
void check_still(CaseValues& in, std::string_view key, const dynamics::Table& value) {
  if (in.good({key}) && value.slope(0.0) != 0.0)
    in.fault(key, "changes from t = 0 on, but a start in steady rolling needs one value",
             "a number, or a table whose first two points, from t = 0 on, have the same value");
}

void check_start_motion(CaseValues& in, const Case& c) {
  constexpr std::string_view spin = "motion.angular_velocity";
  check_still(in, spin, c.motion.angular_velocity);
  check_still(in, "motion.speed", c.motion.speed);
  check_still(in, "motion.height", c.motion.height);
  check_still(in, "motion.gravity", c.motion.gravity);
  for (std::size_t k = 0; k < c.pressures.size(); ++k)
    check_still(in, item_of("load.pressure", k) + ".value", c.pressures[k].pressure);
  if (is_held(c) && in.good({spin}) && c.motion.angular_velocity.at(0.0) == 0.0)
    in.fault(start, "the angular velocity at t = 0 is 0: a body that does not turn does not roll",
             "\"rest\"; or motion.angular_velocity other than 0");
  if (c.motion.slope != 0.0)
    in.fault(start, "steady rolling does not support a slope",
             "\"stationary\"; or motion.slope = 0");
  if (c.rim && !c.pressures.empty())
    in.fault(start,
             "with a [rim] pressures act on the deformed edges, in steady rolling on the "
             "undeformed ones",
             "\"stationary\"; or no [rim], or no [[load.pressure]]");
}

}  // namespace

std::optional<double> flat_ground_below(const Case& c, double radius) {
  if (is_on_road_surface(c) || has_obstacles_of_own_axes(c)) return std::nullopt;
  const contact::GroundShape& shape = c.ground->shape;
  const double angle = c.ground->edge_angle;  // the half width reaches beside the center then
  const double half = c.wheel.width ? 0.5 * *c.wheel.width : radius;
  const double aside = angle == 0.0 ? 0.0 : std::abs(std::sin(angle)) * half;
  const double reach = radius + shape.fillet + aside, center = c.motion.start_x * std::cos(angle);
  const double from = center - reach, to = center + reach;
  std::optional<double> height;
  const std::size_t last = shape.profile.size() - 1;
  for (std::size_t k = 0; k < last; ++k) {  // the end segments are infinite
    const Vec2 a = shape.profile[k], b = shape.profile[k + 1];
    if ((k > 0 && a.x >= to) || (k + 1 < last && b.x <= from)) continue;
    if (a.y != b.y || (height && *height != a.y)) return std::nullopt;
    height = a.y;
  }
  return height;
}

void check_steady_start(CaseValues& in, const Case& c) {
  check_start_body(in, c);
  check_start_motion(in, c);
  if (!in.has_table("ground"))
    in.fault(start, "there is no ground to roll on", "\"stationary\"; or a [ground]");
  else if (has_obstacles_of_own_axes(c))
    in.fault(ground_key(c),
             "a start in steady rolling takes obstacles of one angle, on level ground",
             "one angle for all obstacles and ground.profile = \"flat\"; or initial.state = "
             "\"stationary\"");
  else if (in.good(
               {"ground", "ground.profile", "ground.road", "ground.fillet", "disk.outer_radius"}) &&
           c.ground && contact::shape_faults(c.ground->shape).empty() && !c.mesh &&
           !flat_ground_below(c, c.disk.outer_radius))
    in.fault(ground_key(c),
             fmt::format("is not flat below the body at t = 0, from x = {:.6g} to {:.6g} m, as a "
                         "start in steady rolling requires",
                         c.motion.start_x - c.disk.outer_radius - c.ground->shape.fillet,
                         c.motion.start_x + c.disk.outer_radius + c.ground->shape.fillet),
             "another motion.start_x, or obstacles further away; or initial.state = "
             "\"stationary\"");
}

void check_steady_rolling(CaseValues& in, Case& c) {
  check_steady_body(in, c);
  if (has_rubber(c))
    in.fault("analysis.kind", "steady rolling is of small strain, and rubber is not",
             "\"dynamic\", and a run long enough to settle; or material.model = \"linear\"");
  check_steady_motion(in, c);
  check_given(in);
  check_traction(in, c);
  check_samples(in, c);
  check_slip_step(in, c);
  check_flat_ground(in, c, "steady rolling");
  if (c.body_contact.between != BodyContact::none)
    in.fault("contact.between", "steady rolling supports contact with the ground only", "\"none\"");
  if (in.has_table("rim"))
    in.fault("rim", "steady rolling does not support a rim that forces move",
             "analysis.load, analysis.traction or analysis.torque instead, or a dynamic analysis");
}

}  // namespace rondo::study
