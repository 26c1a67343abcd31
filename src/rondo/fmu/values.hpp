// SPDX-License-Identifier: BSD-3-Clause
/// @file  The variables of a wheel as an FMU (docs/fmu.md): one table, which getters, setters and
/// modelDescription.xml come from.
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "rondo/case/case.hpp"

namespace rondo::fmu {

/// SI, of a wheel `width` wide. Angular velocity and torque > 0 are clockwise: rolling to +x.
struct Values {
  // Parameters.
  double friction = 0.0, ground_height = 0.0, width = 1.0;
  double hub_x_start = 0.0, hub_height_start = 0.0;
  double step = 0.0;  ///< largest one within
  // Motion of the hub: at the end of a communication step.
  double hub_velocity_x = 0.0, hub_velocity_y = 0.0, hub_angular_velocity = 0.0;
  // Of the tyre as a rigid body, undeformed.
  double tyre_mass = 0.0, tyre_inertia = 0.0;
  // Of the tyre on the hub without its rigid inertia and weight, means over the communication step.
  double force_x = 0.0, force_y = 0.0, torque = 0.0;
  double contact_force_x = 0.0, contact_force_y = 0.0;
  // At its end.
  double hub_x = 0.0, hub_height = 0.0, hub_angle = 0.0, loaded_radius = 0.0, contact_length = 0.0;
};

enum class Kind { parameter, calculated, input, output };

/// A row: its place in the table is the value reference.
struct Variable {
  const char* name;
  double Values::*value;
  Kind kind;
  const char* unit;
  const char* description;
  // Allowed of parameters and inputs: what is beyond is a slip, or no number that steps survive.
  double least = 0.0, most = 0.0;
  bool exclusive = false;  ///< `least` itself is not allowed
};

[[nodiscard]] std::span<const Variable> variables() noexcept;

/// Start values that a case gives. @param step of the reduced model                          [s]
[[nodiscard]] Values start_values(const study::Case& c, double step);

/// What is wrong with a value, in words; empty: nothing.
[[nodiscard]] std::string refusal(const Variable& variable, double value);

}  // namespace rondo::fmu
