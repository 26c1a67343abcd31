// SPDX-License-Identifier: BSD-3-Clause
/// @file  The variables of a wheel as an FMU (docs/fmu.md) as one table, from which getters,
/// setters and modelDescription.xml are made.
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "rondo/case/case.hpp"

namespace rondo::fmu {

/// Whether the wheel is one of a metre of width in its plane, or one in three dimensions.
enum class Dimension { plane, space };
[[nodiscard]] Dimension dimension_of(const study::Case& c);

/// SI units; in the plane for a wheel of width `width`. Of a vector, x is along the heading, "left"
/// and "up" as seen along it. Angular velocity, torque > 0: rolling ahead.
struct Values {
  // Parameters:
  double friction = 0.0, ground_height = 0.0, width = 1.0;
  double hub_x_start = 0.0, hub_left_start = 0.0, hub_height_start = 0.0, camber_start = 0.0;
  double step = 0.0;  ///< largest step within a communication step
  // Motion of the hub at the end of a communication step:
  double hub_velocity_x = 0.0, hub_velocity_left = 0.0, hub_velocity_up = 0.0;
  double hub_angular_velocity = 0.0, camber_rate = 0.0, yaw_rate = 0.0;
  // The tyre as a rigid body, undeformed; about its axle and about a diameter:
  double tyre_mass = 0.0, tyre_inertia = 0.0, tyre_inertia_across = 0.0;
  // Mean action of the tyre on the hub in a communication step, without rigid inertia and weight:
  double force_x = 0.0, force_left = 0.0, force_up = 0.0, torque = 0.0;
  double moment_x = 0.0, moment_left = 0.0, moment_up = 0.0;  ///< about the hub
  // Mean action of the ground on the tyre, moments about the contact centre:
  double contact_force_x = 0.0, contact_force_left = 0.0, contact_force_up = 0.0;
  double contact_moment_x = 0.0, contact_moment_left = 0.0, contact_moment_up = 0.0;
  // Values at the end of the communication step:
  double hub_x = 0.0, hub_left = 0.0, hub_height = 0.0, hub_angle = 0.0, camber = 0.0, yaw = 0.0;
  double loaded_radius = 0.0, contact_length = 0.0;  ///< in space an area [m2]
};

/// Largest camber, either way: axes of wheel and ground must not come close to each other [rad].
inline constexpr double most_camber = 0.78;

enum class Kind { parameter, calculated, input, output };

/// A row of the table; its index is the value reference.
struct Variable {
  const char* name;
  double Values::*value;
  Kind kind;
  const char* unit;
  const char* description;
  // Allowed range of parameters and inputs; others are errors or numbers that no step survives.
  double least = 0.0, most = 0.0;
  bool exclusive = false;  ///< whether `least` itself is excluded
};

/// The variables of a wheel: those in space are in the axes of ISO 8855, x ahead, y to the left, z
/// up.
[[nodiscard]] std::span<const Variable> variables(Dimension dimension) noexcept;

/// Start value of `friction`: a constant coefficient, or the coefficient of a table.
[[nodiscard]] double friction_of(const study::Case& c);
/// The friction of the ground where the variable is `friction`: a constant, or the table of the
/// case with this coefficient.
[[nodiscard]] contact::FrictionTable friction_with(const study::Case& c, double friction);

/// Start values from a case. @param step of the reduced wheel                                [s]
[[nodiscard]] Values start_values(const study::Case& c, double step);

/// What is wrong with a value, in words; empty: it is valid.
[[nodiscard]] std::string refusal(const Variable& variable, double value);

}  // namespace rondo::fmu
