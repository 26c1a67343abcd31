// SPDX-License-Identifier: BSD-3-Clause
/// @file  Cords: a line of the section that is swept from one side of an element to the other. They
/// have no thickness, carry force along themselves alone, and turn with the rubber.
#pragma once
#include <array>
#include <span>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/finite/energy.hpp"

namespace rondo::fem::finite {

/// The corners of a swept line from a to b: a and b here, b and a at the next place around.
using FaceCorners = std::array<Vec3, 4>;

/// The cords at a point of the face.
struct CordPoint {
  std::array<double, 4> slope{};  ///< of each corner: y = Σ slope x, whose length is the stretch
  double length = 0.0;            ///< metres of cord that the point stands for             [m]
};

struct CordLaw {
  double stiffness = 0.0;    ///< EA: force over nominal stretch                              [N]
  double prestrain = 0.0;    ///< e0: force EA (stretch - 1 + e0), there from the first step
  double compression = 1.0;  ///< share of the stiffness in compression, > 0
};

/// The four points of a face in the undeformed state.
/// @param angle of the cords, from the direction around (in the sense of growing angles) towards
/// the direction of the line from a to b [rad]
/// @param spacing of the cords at each of the points, across them                             [m]
[[nodiscard]] std::array<CordPoint, 4> cord_points(const FaceCorners& x,
                                                   const std::array<double, 4>& angle,
                                                   const std::array<double, 4>& spacing) noexcept;
/// Stretch and force of the cords at a point of the deformed face.
struct CordState {
  double stretch = 1.0;
  double force = 0.0;  ///< [N]
  Vec3 along;          ///< unit vector
};
[[nodiscard]] CordState cord_state(const CordPoint& point, const FaceCorners& x,
                                   const CordLaw& law) noexcept;

/// @param x deformed corners [m]
[[nodiscard]] Energy<4> cord_face(std::span<const CordPoint, 4> points, const FaceCorners& x,
                                  const CordLaw& law) noexcept;

/// Energy and forces of a face alone, for steps in time.
struct FaceForce {
  double energy = 0.0;          ///< [J]
  std::array<Vec3, 4> force{};  ///< its gradient, by corners [N]
};
[[nodiscard]] FaceForce cord_force(std::span<const CordPoint, 4> points, const FaceCorners& x,
                                   const CordLaw& law) noexcept;

}  // namespace rondo::fem::finite
