// SPDX-License-Identifier: BSD-3-Clause
/// @file  The keys of a wheel with cords that is inflated (docs/tyre.md).
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace rondo::study {

/// A layer of cords along a physical curve of the section.
struct CordsCase {
  std::string curve;
  double angle = 0.0;  ///< from the direction around to that of the curve                 [rad]
  std::optional<double> stiffness;  ///< EA of a cord; absent: by the next two         [N]
  std::optional<double> youngs_modulus, area;  ///< of a cord                            [Pa], [m²]
  double spacing = 0.0;                  ///< across the cords                              [m]
  std::optional<double> spacing_radius;  ///< where it is that, the number of cords around being
                                         ///< constant; absent: everywhere              [m]
  std::optional<double> density;         ///< of a cord; absent: see the next            [kg/m³]
  std::optional<double> excess_mass;     ///< of a metre of cord, less the rubber in its place; both
                                         ///< absent: 0                                 [kg/m]
  double prestrain = 0.0;
  double compression = 1.0;            ///< share of the stiffness that resists compression
  std::optional<double> green_radius;  ///< of the drum on which angle and spacing are measured [m]
  double green_extension = 0.0;        ///< of the cords from the drum to the mould
};

/// The way of a held curve when the wheel is mounted.
struct MountingCase {
  std::string curve;
  double radial = 0.0, axial = 0.0;  ///< [m]
};

/// What is nonlinear in the motion about the inflated state.
enum class TyreMotion {
  linear,
  cords,   ///< cords and air
  window,  ///< these, and rubber near the ground
  all,
};

/// Absent: the wheel is linear about its undeformed shape.
struct InflationCase {
  std::string curve;           ///< that the air presses on; empty: no air
  double pressure = 0.0;       ///< [Pa]
  std::optional<double> spin;  ///< absent: motion.angular_velocity at t = 0           [rad/s]
  std::vector<MountingCase> mounting;
  int steps = 5;
  TyreMotion nonlinear = TyreMotion::linear;
  double window = 0.61;  ///< to each side of the lowest point, for TyreMotion::window      [rad]
};

}  // namespace rondo::study
