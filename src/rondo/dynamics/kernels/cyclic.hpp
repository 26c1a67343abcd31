// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loops of the cyclic operator over packs of sectors. Included after a pack_*.hpp.
#pragma once
#include "rondo/dynamics/kernels/update.hpp"

namespace {

using rondo::dynamics::kernels::CyclicEntry;
using rondo::dynamics::kernels::CyclicHeight;
using rondo::dynamics::kernels::CyclicRow;
using rondo::dynamics::kernels::group_packs;
using rondo::dynamics::kernels::lanes;
using rondo::dynamics::kernels::n_sums;

/// K u of N packs from column `column` on.
template <int N>
inline void product(const CyclicRow& r, std::ptrdiff_t column, Vectors* force) noexcept {
  for (int i = 0; i < N; ++i) force[i] = {all(0.0), all(0.0)};
  for (const CyclicEntry* e = r.entries; e != r.entries + r.n_entries; ++e) {
    const double* u = r.base + e->at + column;
    const Pack xx = all(e->k[0]), yx = all(e->k[1]), xy = all(e->k[2]), yy = all(e->k[3]);
#pragma GCC unroll 4
    for (int i = 0; i < N; ++i) {
      const Vectors c = load_vectors(u + i * lanes, r.stride);
      force[i].x = fma(xx, c.x, fma(xy, c.y, force[i].x));
      force[i].y = fma(yx, c.x, fma(yy, c.y, force[i].y));
    }
  }
}

/// Product, update and sums of N packs. Tail: the last own pack, of which only `columns` count.
template <int N, bool Tail, bool Beta, bool Printed, bool Pull>
inline void block(const CyclicRow& r, const Factors& f, int pack, Sums& sums) noexcept {
  const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(pack) * lanes;
  Vectors force[N];
  product<N>(r, column, force);
  const Pack x = all(r.x), y = all(r.y);
#pragma GCC unroll 4
  for (int i = 0; i < N; ++i) {
    const std::ptrdiff_t here = column + i * lanes;
    double* u = r.base + r.at + here;
    double* v = u + 2 * r.stride;
    double* p = u + 4 * r.stride;
    Nodes n;
    n.u = load_vectors(u, r.stride);
    n.v = load_vectors(v, r.stride);
    n.force = force[i];
    n.before = Beta ? load_vectors(p, r.stride) : force[i];
    n.arm = {x + n.u.x, y + n.u.y};
    n.dt_over_mass = all(r.dt_over_mass);
    if constexpr (Pull) {  // turned into the frame of each sector
      const Pack c = load(r.turn_x + here), s = load(r.turn_y + here);
      const Pack px = all(r.step->pull_x), py = all(r.step->pull_y);
      n.pull = {fma(py, s, px * c), fnma(px, s, py * c)};
    }
    if constexpr (!Tail) {
      store_vectors(v, r.stride, update<Beta, Printed, Pull>(f, n, sums));
      if constexpr (Beta) store_vectors(p, r.stride, n.force);
    } else {
      const int own = r.columns - static_cast<int>(here);
      Sums there = no_sums();
      Vectors after = update<Beta, Printed, Pull>(f, n, there);
      const Pack zero = all(0.0);
      sums.kinetic = sums.kinetic + first_lanes(own, there.kinetic, zero);
      sums.strain = sums.strain + first_lanes(own, there.strain, zero);
      sums.frame = sums.frame + first_lanes(own, there.frame, zero);
      sums.mass = sums.mass + first_lanes(own, there.mass, zero);
      sums.stiffness = sums.stiffness + first_lanes(own, there.stiffness, zero);
      sums.scheme = sums.scheme + first_lanes(own, there.scheme, zero);
      if (r.keep_tail) {
        after = {first_lanes(own, after.x, n.v.x), first_lanes(own, after.y, n.v.y)};
        if constexpr (Beta)
          n.force = {first_lanes(own, n.force.x, n.before.x),
                     first_lanes(own, n.force.y, n.before.y)};
      }
      store_vectors(v, r.stride, after);
      if constexpr (Beta) store_vectors(p, r.stride, n.force);
    }
  }
}

inline void add_sums(double* to, double mass, const Sums& s) noexcept {
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
  add_mass(sum_scheme, s.scheme);
}

template <bool Beta, bool Printed, bool Pull>
void cyclic_row(const CyclicRow& r) noexcept {
  const Factors f(*r.step);
  Sums halo = no_sums();
  if (r.first_pack < 0) block<1, false, Beta, Printed, Pull>(r, f, -1, halo);
  const int full = r.columns / lanes;  // own packs with nothing else in them
  int pack = 0;
  for (double* sums = r.sums; pack * lanes < r.columns; sums += n_sums * lanes) {
    Sums own = no_sums();
    const int end = pack + group_packs;
    for (; pack + block_packs <= end && pack + block_packs <= full; pack += block_packs)
      block<block_packs, false, Beta, Printed, Pull>(r, f, pack, own);
    for (; pack < end && pack < full; ++pack) block<1, false, Beta, Printed, Pull>(r, f, pack, own);
    if (pack < end && pack == full && pack * lanes < r.columns)
      block<1, true, Beta, Printed, Pull>(r, f, pack++, own);
    add_sums(sums, r.mass, own);
  }
  for (; pack < r.last_pack; ++pack) block<1, false, Beta, Printed, Pull>(r, f, pack, halo);
}

void advance_row(double* u, std::ptrdiff_t stride, double dt, int first_pack,
                 int last_pack) noexcept {
  const Pack step = all(dt);
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(first_pack) * lanes;
       at < static_cast<std::ptrdiff_t>(last_pack) * lanes; at += lanes) {
    double* x = u + at;
    const Vectors v = load_vectors(x + 2 * stride, stride), now = load_vectors(x, stride);
    store_vectors(x, stride, {fma(step, v.x, now.x), fma(step, v.y, now.y)});
  }
}

int low_columns(const CyclicHeight& h, int* columns) noexcept {
  int found = 0;
  const Pack rx = all(h.rotation_x), ry = all(h.rotation_y), limit = all(h.limit);
  const Pack x = all(h.x), y = all(h.y);
  for (int column = h.first; column < h.last; column += lanes) {
    const Pack c = load(h.turn_x + column), s = load(h.turn_y + column);
    const Vectors u = load_vectors(h.u + column, h.stride);
    const Pack up_x = fma(rx, s, ry * c), up_y = fnma(ry, s, rx * c);
    const Pack height = fma(up_x, x + u.x, up_y * (y + u.y));
    for (unsigned bits = not_above(height, limit); bits != 0; bits &= bits - 1) {
      const int at = column + __builtin_ctz(bits);
      if (at < h.last) columns[found++] = at;
    }
  }
  return found;
}

}  // namespace
