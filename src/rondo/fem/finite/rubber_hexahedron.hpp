// SPDX-License-Identifier: BSD-3-Clause
/// @file  The hexahedron of rubber at finite strain: an isochoric energy at 2×2×2 points, and a
/// volumetric energy of the element's mean dilatation (Q1P0; Simo, Taylor and Pister 1985).
#pragma once
#include "rondo/fem/finite/energy.hpp"
#include "rondo/fem/rubber.hpp"
#include "rondo/fem/solid/hexahedron.hpp"

namespace rondo::fem::finite {

struct RubberEnergy : Energy<8> {
  double least = 0.0;  ///< smallest det F of the points; <= 0: the element has no energy
};

/// @param points of the undeformed element; u displacements of its corners [m].
/// They are kept apart from X because their differences would lose digits in the sum.
[[nodiscard]] RubberEnergy rubber_hexahedron(const HexahedronPoints& points,
                                             const HexahedronCorners& u, const Rubber& rubber);

/// Energy and forces alone, for steps in time. Not numbers where a det F <= 0.
struct RubberForce {
  double energy = 0.0;        ///< [J]
  HexahedronCorners force{};  ///< its gradient, by corners [N]
};
[[nodiscard]] RubberForce rubber_force(const HexahedronPoints& points, const HexahedronCorners& u,
                                       const Rubber& rubber) noexcept;

/// Largest principal stretch at the points, as above.
[[nodiscard]] double largest_stretch(const HexahedronPoints& points, const HexahedronCorners& u);

}  // namespace rondo::fem::finite
