// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fmu/values.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rondo::fmu {
namespace {

constexpr double farthest = 1e6;      // m
constexpr double fastest = 1e4;       // m/s
constexpr double fastest_spin = 1e5;  // rad/s

constexpr Variable table[] = {
    {"friction", &Values::friction, Kind::parameter, "1",
     "Coulomb's, of tyre and ground; where the case has a table or patches, its coefficient, which "
     "their factors multiply",
     0.0, 100.0},
    {"ground_height", &Values::ground_height, Kind::parameter, "m",
     "height at which the profile of the case has its zero", -farthest, farthest},
    {"width", &Values::width, Kind::parameter, "m",
     "of the tyre: multiplies forces and masses of the plane model", 0.0, 100.0, true},
    {"hub_x_start", &Values::hub_x_start, Kind::parameter, "m", "x of the hub at the start",
     -farthest, farthest},
    {"hub_height_start", &Values::hub_height_start, Kind::parameter, "m",
     "height of the hub at the start", -farthest, farthest},
    {"step", &Values::step, Kind::parameter, "s",
     "largest internal step: a communication step has as many equal ones as it needs", 0.0, 1.0,
     true},
    {"hub_velocity_x", &Values::hub_velocity_x, Kind::input, "m/s",
     "of the hub along x at the end of the communication step, to which it goes linearly", -fastest,
     fastest},
    {"hub_velocity_y", &Values::hub_velocity_y, Kind::input, "m/s", "likewise, upwards", -fastest,
     fastest},
    {"hub_angular_velocity", &Values::hub_angular_velocity, Kind::input, "rad/s",
     "likewise; > 0 rolls towards +x", -fastest_spin, fastest_spin},
    {"tyre_mass", &Values::tyre_mass, Kind::calculated, "kg",
     "to be added to that of the hub, its weight too: force_x and force_y are without"},
    {"tyre_inertia", &Values::tyre_inertia, Kind::calculated, "kg.m2",
     "about the hub, undeformed, to be added to that of the hub: torque is without"},
    {"force_x", &Values::force_x, Kind::output, "N",
     "of the tyre on the hub along x, mean over the communication step"},
    {"force_y", &Values::force_y, Kind::output, "N", "likewise, upwards"},
    {"torque", &Values::torque, Kind::output, "N.m",
     "of the tyre on the hub, mean over the communication step; > 0 drives towards +x"},
    {"contact_force_x", &Values::contact_force_x, Kind::output, "N",
     "of the ground on the tyre along x, mean over the communication step"},
    {"contact_force_y", &Values::contact_force_y, Kind::output, "N", "likewise, upwards"},
    {"hub_x", &Values::hub_x, Kind::output, "m", "integral of hub_velocity_x: trapezoids"},
    {"hub_height", &Values::hub_height, Kind::output, "m",
     "integral of hub_velocity_y: trapezoids"},
    {"hub_angle", &Values::hub_angle, Kind::output, "rad",
     "integral of hub_angular_velocity, > 0 as it: trapezoids"},
    {"loaded_radius", &Values::loaded_radius, Kind::output, "m",
     "distance of the hub from the ground"},
    {"contact_length", &Values::contact_length, Kind::output, "m",
     "of the deformed tyre that touches, in the last internal step"},
};

/// Whether the factors of a table are the same everywhere.
bool is_one_number(contact::FrictionTable table) {
  table.coefficient = 1.0;
  return table.is_constant();
}

}  // namespace

std::span<const Variable> variables() noexcept {
  return table;
}

double friction_of(const study::Case& c) {
  if (!c.ground) return 0.0;
  const contact::FrictionTable& table = c.ground->friction;
  return is_one_number(table) ? contact::largest_friction(table) : table.coefficient;
}

contact::FrictionTable friction_with(const study::Case& c, double friction) {
  contact::FrictionTable table;
  if (c.ground && !is_one_number(c.ground->friction)) table = c.ground->friction;
  table.coefficient = friction;
  return table;
}

Values start_values(const study::Case& c, double step) {
  Values v;
  v.friction = friction_of(c);
  v.hub_x_start = v.hub_x = c.motion.start_x;
  v.hub_height_start = v.hub_height = c.motion.height.at(0.0);
  v.step = step;
  v.hub_velocity_x = c.motion.speed.at(0.0);
  const bool is_free = c.rim && c.rim->free_y;
  v.hub_velocity_y = is_free ? 0.0 : c.motion.height.slope(0.0);
  v.hub_angular_velocity = c.motion.angular_velocity.at(0.0);
  return v;
}

std::string refusal(const Variable& variable, double value) {
  if (!std::isfinite(value)) return fmt::format("{} = {}: not a number", variable.name, value);
  const bool above = value > variable.least || (value == variable.least && !variable.exclusive);
  if (above && value <= variable.most) return {};
  return fmt::format("{} = {}: must be {} {} and at most {}", variable.name, value,
                     variable.exclusive ? "above" : "at least", variable.least, variable.most);
}

}  // namespace rondo::fmu
