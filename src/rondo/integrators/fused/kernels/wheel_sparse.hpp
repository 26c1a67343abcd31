// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loops of the sparse operator on a loaded rim. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/sparse.hpp"
#include "rondo/integrators/fused/kernels/wheel_update.hpp"

namespace {

/// @param force what the body does on them
template <bool Heavy>
inline WheelNodes wheel_nodes(const SparseRows& s, std::ptrdiff_t pack, Vectors force) noexcept {
  const double* motion = s.motion + pack * 4 * lanes;
  const double* constants = s.constants + pack * 4 * lanes;
  WheelNodes n;
  load_pairs(s.now + pack * 2 * lanes, n.u.x, n.u.y);
  load_pairs(s.next + pack * 2 * lanes, n.u_before.x, n.u_before.y);
  n.a = load_vectors(motion, lanes);
  n.force = force;
  n.before = load_vectors(motion + 2 * lanes, lanes);
  n.reference = load_vectors(constants, lanes);
  n.mass = load(constants + 2 * lanes);
  n.dt_over_mass = load(constants + 3 * lanes);
  n.pull = {all(0.0), all(0.0)};
  if constexpr (Heavy) n.pull = {all(s.wheel->pull_x), all(s.wheel->pull_y)};
  return n;
}

inline void store_wheel(const SparseRows& s, std::ptrdiff_t pack, const WheelNodes& n,
                        Vectors after) noexcept {
  double* motion = s.motion + pack * 4 * lanes;
  store_vectors(motion, lanes, after);
  store_vectors(motion + 2 * lanes, lanes, n.force);
}

template <bool Heavy>
inline void store_wheel_sums(const SparseRows& s, const WheelSums& sums,
                             const Resultants& resultants) noexcept {
  const Pack none = all(0.0);  // what this kernel has not
  for (int k = 0; k < rondo::dynamics::kernels::n_wheel_sums; ++k) store(s.sums + k * lanes, none);
  const auto set = [&](int k, Pack value) { store(s.sums + k * lanes, value); };
  for_sums(sums, set);
  for_resultants<Heavy>(resultants, set);
}

template <bool Heavy>
void wheel_rows(const SparseRows& s) noexcept {
  const WheelPacks f(*s.wheel);
  WheelSums sums = no_wheel_sums();
  Resultants resultants = no_resultants();
  for (std::ptrdiff_t pack = s.first_pack; pack < s.last_pack; ++pack) {
    const WheelNodes n = wheel_nodes<Heavy>(s, pack, sparse_product(s, pack));
    store_wheel(s, pack, n, wheel_update<Heavy>(f, n, sums, resultants));
  }
  store_wheel_sums<Heavy>(s, sums, resultants);
}

inline void wheel_rows_way(const SparseRows& s) noexcept {
  const WayPacks way(*s.way);
  const Vectors hub = {all(s.way->hub_x), all(s.way->hub_y)};
  for (std::ptrdiff_t pack = s.first_pack; pack < s.last_pack; ++pack) {
    Vectors u;
    load_pairs(s.now + pack * 2 * lanes, u.x, u.y);
    u = wheel_way(way, hub, load_vectors(s.constants + pack * 4 * lanes, lanes), u,
                  load_vectors(s.motion + pack * 4 * lanes, lanes));
    store_pairs(s.next + pack * 2 * lanes, u.x, u.y);
  }
}

}  // namespace
