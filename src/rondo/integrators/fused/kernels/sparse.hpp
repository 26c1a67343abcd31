// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loops of the sparse operator over packs of rows. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/update.hpp"

namespace {

using rondo::dynamics::kernels::lanes;
using rondo::dynamics::kernels::SparseRows;

/// K u of a pack of rows.
inline Vectors sparse_product(const SparseRows& s, std::ptrdiff_t pack) noexcept {
  const std::int64_t first = s.start[pack];
  Vectors product;
  row_products(s.start[pack + 1] - first, s.blocks + first * 4 * lanes, s.column + first * lanes,
               s.now, product.x, product.y);
  return product;
}

/// The force of the loads on a pack.
inline Vectors load_on(const SparseRows& s, std::ptrdiff_t pack) noexcept {
  Vectors load = {all(0.0), all(0.0)};
  for (int i = s.first_load[pack]; i < s.first_load[pack + 1]; ++i) {
    const Vectors force = load_vectors(s.loads + 2 * i * lanes, lanes);
    const Pack pressure = all(s.pressures[s.load_of[i]]);
    load = {fma(pressure, force.x, load.x), fma(pressure, force.y, load.y)};
  }
  return load;
}

/// @param force what the body does on them
template <bool Loaded, bool Beta, bool Unsteady>
inline Nodes sparse_nodes(const SparseRows& s, const Factors& f, std::ptrdiff_t pack,
                          const double* motion, Vectors force) noexcept {
  const double* constants = s.constants + pack * 4 * lanes;
  const Vectors reference = load_vectors(constants, lanes);
  Nodes n;
  load_pairs(s.now + pack * 2 * lanes, n.u.x, n.u.y);
  n.v = load_vectors(motion, lanes);
  n.force = force;
  n.before = Beta ? load_vectors(motion + 2 * lanes, lanes) : n.force;
  n.frame = {f.rate.x * reference.x, f.rate.x * reference.y};
  if constexpr (Unsteady) {
    n.frame = {fnma(f.rate.y, reference.y, n.frame.x), fma(f.rate.y, reference.x, n.frame.y)};
    n.frame = {n.frame.x + all(s.step->pull_x), n.frame.y + all(s.step->pull_y)};
  }
  n.dt_over_mass = load(constants + 3 * lanes);
  n.load = Loaded ? load_on(s, pack) : Vectors{all(0.0), all(0.0)};
  return n;
}

/// Nodes of a pack have masses of their own.
inline void add_sums(Pack mass, const Sums& pack, Sums& sums) noexcept {
  sums.kinetic = fma(mass, pack.kinetic, sums.kinetic);
  sums.strain = sums.strain + pack.strain;
  sums.frame = fma(mass, pack.frame, sums.frame);
  sums.mass = fma(mass, pack.mass, sums.mass);
  sums.stiffness = sums.stiffness + pack.stiffness;
  sums.load = sums.load + pack.load;
}

inline void store_sums(const Sums& sums, double* to) noexcept {
  using namespace rondo::dynamics::kernels;
  store(to + sum_kinetic * lanes, sums.kinetic);
  store(to + sum_strain * lanes, sums.strain);
  store(to + sum_frame * lanes, sums.frame);
  store(to + sum_mass * lanes, sums.mass);
  store(to + sum_stiffness * lanes, sums.stiffness);
  store(to + sum_load * lanes, sums.load);
}

template <bool Loaded, bool Beta, bool Unsteady>
void sparse_rows(const SparseRows& s) noexcept {
  const Factors f(*s.step);
  Sums sums = no_sums();
  for (std::ptrdiff_t pack = s.first_pack; pack < s.last_pack; ++pack) {
    double* motion = s.motion + pack * (Beta ? 4 : 2) * lanes;
    const Nodes n =
        sparse_nodes<Loaded, Beta, Unsteady>(s, f, pack, motion, sparse_product(s, pack));
    Sums own = no_sums();
    const Vectors after = update<Loaded, Beta, Unsteady>(f, n, own);
    add_sums(load(s.constants + (pack * 4 + 2) * lanes), own, sums);
    store_vectors(motion, lanes, after);
    if constexpr (Beta) store_vectors(motion + 2 * lanes, lanes, n.force);
    store_pairs(s.next + pack * 2 * lanes, fma(f.dt, after.x, n.u.x), fma(f.dt, after.y, n.u.y));
  }
  store_sums(sums, s.sums);
}

}  // namespace
