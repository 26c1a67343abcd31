// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/push/free_rolling.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/analysis/build/solid/solid_body.hpp"

namespace rondo::study {
namespace {

/// The tread that is pressed becomes shorter around the wheel, by the strain under Hertz's
/// pressure, (1 - 2ν)(1 + ν) p/E, which grows as the length of the contact: this times
/// sqrt(deflection/radius). Solid wheels of ν = 0, the worst, have 0.24.
constexpr double shortening = 0.35;
/// Inflation and spin make the circumference of a tyre grow by less than this.
constexpr double tyre_growth = 0.05;
/// Share of the outer radius by which a wheel of unknown height is pressed in at most.
constexpr double unknown_share = 0.1;

/// Half the extent along the axle; 0: plane [m].
double half_width(const mesh::Mesh& mesh) {
  return mesh.is_solid() ? 0.5 * width_of(mesh) : 0.0;
}

/// The most by which the wheel is pressed in, >= 0 [m].
double most_deflection(const Case& c, double half, const Wall& wall) {
  const bool is_given = !c.analysis.load && !(c.rim && c.rim->free_y);
  const bool is_uneven = c.ground->road.read || c.ground->has_own_axes;
  if (!is_given || is_uneven)
    return std::min(unknown_share * wall.radius, deep_share * wall.thickness);
  double height = c.motion.height.at(0.0), ground = c.ground->shape.profile.front().y;
  for (const auto& point : c.motion.height.points()) height = std::min(height, point[1]);
  for (const Vec2& point : c.ground->shape.profile) ground = std::max(ground, point.y);
  const double lean = std::abs(c.motion.camber);
  const double touching = wall.radius * std::cos(lean) + half * std::sin(lean);
  return std::max(touching - (height - ground), 0.0);
}

}  // namespace

FreeRadii free_radii(const Case& c, const mesh::Mesh& mesh, const Wall& wall) {
  const double half = half_width(mesh), lean = std::abs(c.motion.camber);
  const double deflection = most_deflection(c, half, wall);
  const double shorter = shortening * std::sqrt(deflection / wall.radius);
  // What leans touches the ground beside the middle plane, where its tread is nearer to the axle.
  const double nearest = wall.radius * std::pow(std::cos(lean), 2) - half * std::sin(lean);
  // Rubber that cannot give way runs through the contact faster, by its thickness over what is
  // left of it: solid wheels of ν = 0.49 have half of this.
  const double longer = c.inflation ? tyre_growth : std::max(deflection / wall.thickness, shorter);
  const double yaw = std::abs(c.analysis.turn_slip) * half;  // of the speed, at the sides
  return {(nearest - std::max(deflection, shorter * wall.radius)) * (1.0 - yaw),
          wall.radius * (1.0 + longer) * (1.0 + yaw)};
}

}  // namespace rondo::study
