// SPDX-License-Identifier: BSD-3-Clause
/// @file  Sums of the energy ledger over the packs of a row, in the plane and in space. Included
/// after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/kernels.hpp"

namespace {

/// Sums of the row in hand; those with the mass are multiplied by it when the row is done.
struct Sums {
  Pack kinetic, strain, frame, mass, stiffness, load;
};

inline Sums no_sums() noexcept {
  const Pack zero = all(0.0);
  return {zero, zero, zero, zero, zero, zero};
}

/// Adds the first n lanes.
inline void add_first_lanes(int n, const Sums& part, Sums& sums) noexcept {
  const Pack zero = all(0.0);
  sums.kinetic = sums.kinetic + first_lanes(n, part.kinetic, zero);
  sums.strain = sums.strain + first_lanes(n, part.strain, zero);
  sums.frame = sums.frame + first_lanes(n, part.frame, zero);
  sums.mass = sums.mass + first_lanes(n, part.mass, zero);
  sums.stiffness = sums.stiffness + first_lanes(n, part.stiffness, zero);
  sums.load = sums.load + first_lanes(n, part.load, zero);
}

/// Adds the sums of a row to those of its chunk. @param to (n_sums, lanes)
template <bool Loaded>
inline void add_row_sums(double* to, double mass, const Sums& s) noexcept {
  using namespace rondo::dynamics::kernels;
  const Pack m = all(mass);
  const auto add = [&](int k, Pack value) { store(to + k * lanes, load(to + k * lanes) + value); };
  const auto add_mass = [&](int k, Pack value) {
    store(to + k * lanes, fma(m, value, load(to + k * lanes)));
  };
  add_mass(sum_kinetic, s.kinetic);
  add(sum_strain, s.strain);
  add_mass(sum_frame, s.frame);
  add_mass(sum_mass, s.mass);
  add(sum_stiffness, s.stiffness);
  if constexpr (Loaded) add(sum_load, s.load);
}

}  // namespace
