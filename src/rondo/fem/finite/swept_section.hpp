// SPDX-License-Identifier: BSD-3-Clause
/// @file  The section of a wheel at finite strain, from which all its equal sectors are made:
/// rubber, cords, the surface that holds the air.
#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/fem/finite/cord_face.hpp"
#include "rondo/fem/rubber.hpp"

namespace rondo::fem::finite {

struct SweptQuad {
  std::array<int, 4> corner{};  ///< in either sense
  int rubber = 0;
};

/// Edges of a curve in its direction: from, to.
using Curve = std::vector<std::array<int, 2>>;

/// A layer that was made on a drum and lifted into its mould: the number of cords around is the
/// same at all radii, and their angle α to the direction around follows from that on the drum,
/// cos α / r = cos α_g / (r_g (1 + e)).
struct Lift {
  double radius = 0.0;     ///< r_g of the drum [m]
  double extension = 0.0;  ///< e of the cords

  /// cos α at a radius; above 1: no cord is so far out. @param angle α_g on the drum [rad]
  [[nodiscard]] double cosine(double angle, double r) const noexcept {
    return std::cos(angle) * r / (radius * (1.0 + extension));
  }
};

/// A layer of cords along a curve.
struct Cords {
  std::string name;
  CordLaw law;
  double angle = 0.0;    ///< from the direction around towards that of the curve          [rad]
  double spacing = 0.0;  ///< across the cords                                           [m]
  std::optional<double> spacing_radius;  ///< where it is that: the number of cords around is the
                                         ///< same everywhere                          [m]
  std::optional<Lift> lift;              ///< then angle and spacing are those on the drum
  Curve lines;
  /// (lines) of a metre of cord beyond that of the rubber in its place; empty: 0 [kg/m]
  std::vector<double> excess_mass;
};

/// A flat end of the enclosed volume, from a node of the section to the axle.
struct Cap {
  int node = 0;
  double outward = 1.0;  ///< 1: it looks along +z, -1: along -z
};

struct SweptSection {
  int n_sectors = 0;        ///< >= 3
  std::vector<Vec2> place;  ///< (n) x is r, y is z: along the axle [m], r > 0
  std::vector<SweptQuad> quads;
  std::vector<Rubber> rubbers;
  std::vector<double> densities;  ///< of the rubbers [kg/m³]
  std::vector<Cords> cords;
  /// Pressed by the air, in either sense; each edge is of one quadrilateral alone. Of cords without
  /// rubber: with the air on the right of whoever walks along it in (r, z). Where it ends, its node
  /// is held or has a cap: elsewhere the air would leak, and its force be wrong.
  Curve liner;
  std::vector<Cap> caps;
  std::vector<char> held;  ///< (3n) displacements that are given: outwards 3a, around 3a + 1, along
                           ///< the axle 3a + 2
};

}  // namespace rondo::fem::finite
