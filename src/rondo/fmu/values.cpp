// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fmu/values.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rondo::fmu {
namespace {

constexpr double farthest = 1e6;      // m
constexpr double fastest = 1e4;       // m/s
constexpr double fastest_spin = 1e5;  // rad/s
constexpr double fastest_turn = 1e3;  // rad/s, of camber and yaw

constexpr Variable in_plane[] = {
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
    {"hub_velocity_y", &Values::hub_velocity_up, Kind::input, "m/s", "likewise, upwards", -fastest,
     fastest},
    {"hub_angular_velocity", &Values::hub_angular_velocity, Kind::input, "rad/s",
     "likewise; > 0 rolls towards +x", -fastest_spin, fastest_spin},
    {"tyre_mass", &Values::tyre_mass, Kind::calculated, "kg",
     "to be added to that of the hub, its weight too: force_x and force_y are without"},
    {"tyre_inertia", &Values::tyre_inertia, Kind::calculated, "kg.m2",
     "about the hub, undeformed, to be added to that of the hub: torque is without"},
    {"force_x", &Values::force_x, Kind::output, "N",
     "of the tyre on the hub along x, mean over the communication step"},
    {"force_y", &Values::force_up, Kind::output, "N", "likewise, upwards"},
    {"torque", &Values::torque, Kind::output, "N.m",
     "of the tyre on the hub, mean over the communication step; > 0 drives towards +x"},
    {"contact_force_x", &Values::contact_force_x, Kind::output, "N",
     "of the ground on the tyre along x, mean over the communication step"},
    {"contact_force_y", &Values::contact_force_up, Kind::output, "N", "likewise, upwards"},
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

constexpr Variable in_space[] = {
    {"friction", &Values::friction, Kind::parameter, "1",
     "Coulomb's, of tyre and ground; where the case has a table or patches, its coefficient, which "
     "their factors multiply",
     0.0, 100.0},
    {"ground_height", &Values::ground_height, Kind::parameter, "m",
     "height at which the ground of the case has its zero", -farthest, farthest},
    {"hub_x_start", &Values::hub_x_start, Kind::parameter, "m", "x of the hub at the start",
     -farthest, farthest},
    {"hub_y_start", &Values::hub_left_start, Kind::parameter, "m",
     "y of the hub at the start, to the left", -farthest, farthest},
    {"hub_height_start", &Values::hub_height_start, Kind::parameter, "m",
     "height of the hub at the start", -farthest, farthest},
    {"camber_start", &Values::camber_start, Kind::parameter, "rad",
     "camber at the start; > 0 leans the top of the wheel to the left", -most_camber, most_camber},
    {"step", &Values::step, Kind::parameter, "s",
     "largest internal step: a communication step has as many equal ones as it needs", 0.0, 1.0,
     true},
    {"hub_velocity_x", &Values::hub_velocity_x, Kind::input, "m/s",
     "of the hub along the heading of the wheel at the end of the communication step, to which it "
     "goes linearly",
     -fastest, fastest},
    {"hub_velocity_y", &Values::hub_velocity_left, Kind::input, "m/s",
     "likewise to the left of the heading, along the ground", -fastest, fastest},
    {"hub_velocity_z", &Values::hub_velocity_up, Kind::input, "m/s", "likewise, upwards", -fastest,
     fastest},
    {"hub_angular_velocity", &Values::hub_angular_velocity, Kind::input, "rad/s",
     "likewise of the wheel about its axle; > 0 rolls ahead", -fastest_spin, fastest_spin},
    {"camber_rate", &Values::camber_rate, Kind::input, "rad/s",
     "likewise of the camber; > 0 leans the top of the wheel to the left", -fastest_turn,
     fastest_turn},
    {"yaw_rate", &Values::yaw_rate, Kind::input, "rad/s",
     "likewise of the heading about the normal of the ground; > 0 turns it to the left",
     -fastest_turn, fastest_turn},
    {"tyre_mass", &Values::tyre_mass, Kind::calculated, "kg",
     "to be added to that of the hub, its weight too: the forces are without"},
    {"tyre_inertia", &Values::tyre_inertia, Kind::calculated, "kg.m2",
     "about the axle, undeformed, to be added to that of the hub: torque is without"},
    {"tyre_inertia_across", &Values::tyre_inertia_across, Kind::calculated, "kg.m2",
     "about a diameter through the hub, undeformed, likewise: the moments are without it and "
     "without the gyroscopic moments of both"},
    {"force_x", &Values::force_x, Kind::output, "N",
     "of the tyre on the hub along the heading, mean over the communication step"},
    {"force_y", &Values::force_left, Kind::output, "N", "likewise, to the left"},
    {"force_z", &Values::force_up, Kind::output, "N", "likewise, upwards"},
    {"moment_x", &Values::moment_x, Kind::output, "N.m",
     "of the tyre on the hub about the heading, through the center of the hub, mean over the "
     "communication step"},
    {"moment_y", &Values::moment_left, Kind::output, "N.m",
     "likewise about the axis to the left; without camber it is torque"},
    {"moment_z", &Values::moment_up, Kind::output, "N.m", "likewise about the axis upwards"},
    {"torque", &Values::torque, Kind::output, "N.m",
     "the part of the moments about the axle; > 0 drives ahead"},
    {"contact_force_x", &Values::contact_force_x, Kind::output, "N",
     "of the ground on the tyre along the heading, mean over the communication step"},
    {"contact_force_y", &Values::contact_force_left, Kind::output, "N", "likewise, to the left"},
    {"contact_force_z", &Values::contact_force_up, Kind::output, "N", "likewise, upwards"},
    {"contact_moment_x", &Values::contact_moment_x, Kind::output, "N.m",
     "of the ground on the tyre about the heading, through the contact centre, mean over the "
     "communication step: overturning"},
    {"contact_moment_y", &Values::contact_moment_left, Kind::output, "N.m",
     "likewise about the axis to the left: rolling resistance"},
    {"contact_moment_z", &Values::contact_moment_up, Kind::output, "N.m",
     "likewise about the axis upwards: aligning"},
    {"hub_x", &Values::hub_x, Kind::output, "m",
     "of the hub along the heading at the start: integral of the velocities"},
    {"hub_y", &Values::hub_left, Kind::output, "m",
     "likewise, to the left of the heading at the start"},
    {"hub_height", &Values::hub_height, Kind::output, "m",
     "integral of hub_velocity_z: trapezoids"},
    {"hub_angle", &Values::hub_angle, Kind::output, "rad",
     "integral of hub_angular_velocity, > 0 as it: trapezoids"},
    {"camber", &Values::camber, Kind::output, "rad", "integral of camber_rate: trapezoids"},
    {"yaw", &Values::yaw, Kind::output, "rad", "integral of yaw_rate, from 0: trapezoids"},
    {"loaded_radius", &Values::loaded_radius, Kind::output, "m",
     "distance of the hub from the contact centre, where the line in the plane of the wheel from "
     "the hub down meets the ground"},
    {"contact_area", &Values::contact_length, Kind::output, "m2",
     "of the undeformed tyre that touches, in the last internal step"},
};

/// Whether the factors of a table are the same everywhere.
bool is_one_number(contact::FrictionTable table) {
  table.coefficient = 1.0;
  return table.is_constant();
}

}  // namespace

Dimension dimension_of(const study::Case& c) {
  return study::is_solid(c) ? Dimension::space : Dimension::plane;
}

std::span<const Variable> variables(Dimension dimension) noexcept {
  if (dimension == Dimension::space) return in_space;
  return in_plane;
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
  v.camber_start = v.camber = c.motion.camber;
  v.step = step;
  v.hub_velocity_x = c.motion.ahead(0.0);
  v.hub_velocity_left = 0.0 - c.motion.speed.at(0.0) * std::sin(c.motion.slip_angle.at(0.0));
  const bool is_free = c.rim && c.rim->free_y;
  v.hub_velocity_up = is_free ? 0.0 : c.motion.height.slope(0.0);
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
