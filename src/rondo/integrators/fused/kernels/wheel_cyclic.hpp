// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loops of the cyclic operator on a loaded rim. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/cyclic.hpp"
#include "rondo/integrators/fused/kernels/wheel_update.hpp"

namespace {

using rondo::dynamics::kernels::n_wheel_sums;

/// Update and sums of one pack of a row.
template <bool Heavy>
inline void wheel_pack(const CyclicStrip& s, const WheelPacks& f, const CyclicRow& row,
                       std::ptrdiff_t column, Vectors force, WheelSums& sums,
                       Resultants& resultants) noexcept {
  const std::ptrdiff_t at = row.at + column;
  double* a = s.velocity + at;
  double* p = s.force + at;
  const Vectors none = {all(0.0), all(0.0)};
  WheelNodes n;
  n.pull = none;
  n.u = load_vectors(s.now + at, s.stride);
  n.u_before = load_vectors(s.next + at, s.stride);
  n.a = load_vectors(a, s.stride);
  n.force = force;
  n.before = load_vectors(p, s.stride);
  n.reference = {all(row.x), all(row.y)};
  n.mass = all(row.mass);
  n.dt_over_mass = all(row.dt_over_mass);
  if constexpr (Heavy) n.pull = to_sectors(s, column, s.wheel->pull_x, s.wheel->pull_y);
  const int own = own_lanes(s, column);
  if (own < lanes) n = own_nodes(own, n);
  const Vectors after = wheel_update<Heavy>(f, n, sums, resultants);
  store_vectors(a, s.stride, after);
  store_vectors(p, s.stride, n.force);
}

/// All rows of the strip on packs [first, last), at most a group.
template <bool Heavy>
inline void wheel_group(const CyclicStrip& s, const WheelPacks& f, int first, int last,
                        double* sums) noexcept {
  Forces force;
  product(s, first, last - first, force);
  const auto add = [&](int k, Pack value) {
    store(sums + k * lanes, load(sums + k * lanes) + value);
  };
  WheelSums own = no_wheel_sums();
  for (int pack = first; pack < last; ++pack) {
    const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(pack) * lanes;
    Resultants r = no_resultants();
    for (int i = 0; i < s.n_rows; ++i)
      wheel_pack<Heavy>(s, f, s.rows[i], column, force[i][pack - first], own, r);
    const Resultants turned = {from_sectors(s, column, r.force), from_sectors(s, column, r.change),
                               from_sectors(s, column, r.mass),
                               from_sectors(s, column, r.momentum)};
    for_resultants<Heavy>(turned, add);
  }
  for_sums(own, add);
}

template <bool Heavy>
void wheel_strip(const CyclicStrip& s) noexcept {
  const WheelPacks f(*s.wheel);
  const int own = (s.columns + lanes - 1) / lanes;
  double* sums = s.sums;
  for (int pack = 0; pack < own; pack += group_packs, sums += n_wheel_sums * lanes)
    wheel_group<Heavy>(s, f, pack, pack + group_packs < own ? pack + group_packs : own, sums);
}

void wheel_strip_way(const CyclicStrip& s) noexcept {
  const WayPacks way(*s.way);
  const int own = (s.columns + lanes - 1) / lanes;
  for (int pack = 0; pack < own; ++pack) {
    const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(pack) * lanes;
    const Vectors hub = to_sectors(s, column, s.way->hub_x, s.way->hub_y);
    for (int r = 0; r < s.n_rows; ++r) {
      const CyclicRow& row = s.rows[r];
      const std::ptrdiff_t at = row.at + column;
      const Vectors u =
          wheel_way(way, hub, {all(row.x), all(row.y)}, load_vectors(s.now + at, s.stride),
                    load_vectors(s.velocity + at, s.stride));
      store_vectors(s.next + at, s.stride, own_of(own_lanes(s, column), u));
    }
  }
}

}  // namespace
