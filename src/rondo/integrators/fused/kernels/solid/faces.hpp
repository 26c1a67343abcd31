// SPDX-License-Identifier: BSD-3-Clause
/// @file  Forces of the cords and of the air of a wheel in three dimensions, eight sectors at a
/// time (docs/tyre.md): what fem/finite/swept_forces.hpp finds one by one. Included after a
/// pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/solid/corners.hpp"

namespace {

using rondo::dynamics::kernels::SolidAirFace;
using rondo::dynamics::kernels::SolidCordFace;
using rondo::dynamics::kernels::SolidFaces;

/// Adds the forces of a line of cords. @return its energy
inline Pack cord_line(const SolidFaces& s, const SolidCordFace& face,
                      std::ptrdiff_t column) noexcept {
  Space u[4], f[4];
#pragma GCC unroll 4
  for (int a = 0; a < 4; ++a) {
    u[a] = corner_u(s, face.corner[a], column);
    f[a] = space_of(0.0, 0.0, 0.0);
  }
  Pack energy = all(0.0);
  const Pack zero = all(0.0), one = all(1.0);
#pragma GCC unroll 4
  for (int q = 0; q < 4; ++q) {
    Space y = space_of(face.rest[q][0], face.rest[q][1], face.rest[q][2]);
#pragma GCC unroll 4
    for (int a = 0; a < 4; ++a) y = add_times(all(face.slope[q][a]), u[a], y);
    const Pack stretch = square_root(add_dot(y, y, zero));
    const Pack strain = stretch - one + all(face.prestrain);
    const Pack force = all(face.stiffness) *
                       fma(all(face.compression), smaller(strain, zero), larger(strain, zero));
    const Pack length = all(face.length[q]);
    energy = fma(length * force, strain, energy);
    const Pack turns = length * force / stretch;
#pragma GCC unroll 4
    for (int a = 0; a < 4; ++a) f[a] = add_times(turns * all(face.slope[q][a]), y, f[a]);
  }
#pragma GCC unroll 4
  for (int a = 0; a < 4; ++a) add_corner(s, face.corner[a], column, f[a]);
  return all(0.5) * energy;
}

/// Adds the forces of the air on a face of the liner, -p times the gradient of its cone's volume
/// 4/3 m·(a × c) (fem/finite/enclosed_volume.hpp). @return its energy
inline Pack air_face(const SolidFaces& s, const SolidAirFace& face,
                     std::ptrdiff_t column) noexcept {
  constexpr double along_of[4] = {-0.25, 0.25, 0.25, -0.25},
                   across_of[4] = {-0.25, -0.25, 0.25, 0.25};
  Space middle = space_of(face.middle[0], face.middle[1], face.middle[2]),
        along = space_of(face.along[0], face.along[1], face.along[2]),
        across = space_of(face.across[0], face.across[1], face.across[2]);
#pragma GCC unroll 4
  for (int a = 0; a < 4; ++a) {
    const Space u = corner_u(s, face.corner[a], column);
    middle = add_times(all(0.25), u, middle);
    along = add_times(all(along_of[a]), u, along);
    across = add_times(all(across_of[a]), u, across);
  }
  const Pack share = all(-4.0 / 3.0 * s.pressure);
  const Space by_middle = cross(along, across), by_along = cross(across, middle),
              by_across = cross(middle, along);
#pragma GCC unroll 4
  for (int a = 0; a < 4; ++a) {
    Space f = {all(0.0), all(0.0), all(0.0)};
    f = add_times(share * all(0.25), by_middle, f);
    f = add_times(share * all(along_of[a]), by_along, f);
    f = add_times(share * all(across_of[a]), by_across, f);
    add_corner(s, face.corner[a], column, f);
  }
  return share * add_dot(middle, by_middle, all(0.0));
}

/// Finds the forces of all faces on all columns, and on those of the sector before the first.
void solid_faces(const SolidFaces& s) noexcept {
  using namespace rondo::dynamics::kernels;
  for (int pack = -1; pack * lanes < s.columns; ++pack) {
    const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(pack) * lanes;
    for (int i = 0; i < 6 * s.n_rows; ++i) store(s.force + i * s.stride + column, all(0.0));
    Pack energy = all(0.0);
    for (int i = 0; i < s.n_cords; ++i) energy = energy + cord_line(s, s.cords[i], column);
    for (int i = 0; i < s.n_air; ++i) energy = energy + air_face(s, s.air[i], column);
    if (pack < 0) continue;
    const int own = s.columns - static_cast<int>(column);
    const Pack more = energy - all(s.energy_of_state);
    double* const to = s.sums + (pack / solid_packs * s.n_sums + s.sum) * lanes;
    store(to, load(to) + all(2.0) * (own < lanes ? first_lanes(own, more, all(0.0)) : more));
  }
}

}  // namespace
