// SPDX-License-Identifier: BSD-3-Clause
/// @file  The loops of the sparse operator over rows with elements of rubber on them: their forces
/// beside those of K, and sums of the work of all of them, for K u is not all of the force.
/// Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/rubber/layout.hpp"
#include "rondo/integrators/fused/kernels/wheel_sparse.hpp"

namespace {

using rondo::dynamics::kernels::RubberRows;

/// Force of elements and K on a pack of rows: derivative of the energy. @param linear u·K u of
/// them, added to
inline Vectors force_on(const SparseRows& s, std::ptrdiff_t pack, Pack& linear) noexcept {
  Vectors force = sparse_product(s, pack), u;
  load_pairs(s.now + pack * 2 * lanes, u.x, u.y);
  linear = add_dot(u, force, linear);
  const RubberRows& r = *s.rubber;
  for (std::int64_t place = r.start[pack]; place < r.start[pack + 1]; ++place) {
    Vectors of_corner;
    gather_pairs(r.force, r.corner + place * lanes, of_corner.x, of_corner.y);
    force = {force.x + of_corner.x, force.y + of_corner.y};
  }
  return force;
}

template <bool Loaded, bool Beta, bool Unsteady>
void rubber_rows(const SparseRows& s) noexcept {
  using namespace rondo::dynamics::kernels;
  const Factors f(*s.step);
  Sums sums = no_sums();
  Pack mean_force = all(0.0), force_before = all(0.0), linear = all(0.0);
  for (std::ptrdiff_t pack = s.first_pack; pack < s.last_pack; ++pack) {
    double* motion = s.motion + pack * (Beta ? 4 : 2) * lanes;
    const Nodes n =
        sparse_nodes<Loaded, Beta, Unsteady>(s, f, pack, motion, force_on(s, pack, linear));
    Sums own = no_sums();
    const Vectors after = update<Loaded, Beta, Unsteady>(f, n, own);
    add_sums(load(s.constants + (pack * 4 + 2) * lanes), own, sums);
    force_before = add_dot(n.v, n.force, force_before);
    mean_force = add_dot({n.v.x + after.x, n.v.y + after.y}, n.force, mean_force);
    store_vectors(motion, lanes, after);
    if constexpr (Beta) store_vectors(motion + 2 * lanes, lanes, n.force);
    store_pairs(s.next + pack * 2 * lanes, fma(f.dt, after.x, n.u.x), fma(f.dt, after.y, n.u.y));
  }
  store_sums(sums, s.sums);
  store(s.sums + sum_mean_force * lanes, mean_force);
  store(s.sums + sum_force_before * lanes, force_before);
  store(s.sums + sum_linear * lanes, linear);
}

template <bool Heavy>
void rubber_wheel_rows(const SparseRows& s) noexcept {
  using namespace rondo::dynamics::kernels;
  const WheelPacks f(*s.wheel);
  WheelSums sums = no_wheel_sums();
  Resultants resultants = no_resultants();
  Pack force_before = all(0.0), linear = all(0.0);
  for (std::ptrdiff_t pack = s.first_pack; pack < s.last_pack; ++pack) {
    const WheelNodes n = wheel_nodes<Heavy>(s, pack, force_on(s, pack, linear));
    const Vectors after = wheel_update<Heavy>(f, n, sums, resultants);
    force_before = add_dot(n.before, minus(n.u, n.u_before), force_before);
    store_wheel(s, pack, n, after);
  }
  store_wheel_sums<Heavy>(s, sums, resultants);
  store(s.sums + wheel_strain * lanes, force_before);
  store(s.sums + wheel_linear * lanes, linear);
}

}  // namespace
