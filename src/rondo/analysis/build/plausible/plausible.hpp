// SPDX-License-Identifier: BSD-3-Clause
/// @file  Whether the numbers of a case mean what their user thinks: loads, pressures and angles in
/// other units than SI, a section that is not about its middle plane (docs/cases.md, Physical
/// figures). Warnings, each a sentence with key, value, what it means, and the likely cause.
#pragma once
#include <string>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::study {

// Bounds beyond which there is a warning.
inline constexpr double least_pressure = 1e3;          ///< [Pa]
inline constexpr double least_pressure_share = 1e-4;   ///< and over the softest modulus
inline constexpr double least_inflation_share = 1e-3;  ///< the same of the air of a tyre
inline constexpr double least_load_share = 0.1;        ///< load over the weight of the body
inline constexpr double least_deflection = 1e-4;       ///< over the outer radius
inline constexpr double clear_share =
    1.0;  ///< gap above the ground over the radius: less may be meant
inline constexpr double far_share = 10.0;   ///< that of a wheel of free height at the start
inline constexpr double off_middle = 0.05;  ///< offset of the tread over its width
inline constexpr double wide_angle = 0.35;  ///< slip angle, camber [rad]

/// Adds what there is to say of loads, pressures, angles, and the section. @param materials one for
/// each region of the mesh
void warn_of_senses(const Case& c, const mesh::Mesh& mesh,
                    const std::vector<fem::Material>& materials,
                    std::vector<std::string>& warnings);

/// The body does not reach the ground; empty: it does. @param height least of the center above
/// the ground [m]
[[nodiscard]] std::string stays_above_ground(double height, double radius);

/// A wheel of free height starts far above the ground; empty: it does not. @param height of the
/// center above the ground at t = 0 [m]
[[nodiscard]] std::string starts_far_above(double height, double radius);

/// Whether a load is so small beside the weight of the body that it is warned of.
[[nodiscard]] bool is_hardly_loaded(double load, const mesh::Mesh& mesh,
                                    const std::vector<fem::Material>& materials);
/// Whether the pressure of a tyre is so small that it is warned of.
[[nodiscard]] bool is_hardly_inflated(const Case& c, const std::vector<fem::Material>& materials);

/// The body is pressed in by next to nothing; empty: by more. @param key that says how far
[[nodiscard]] std::string hardly_pressed(const std::string& key, double deflection, double radius);

}  // namespace rondo::study
