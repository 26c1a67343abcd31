// SPDX-License-Identifier: BSD-3-Clause
/// @file  What hexahedra of rubber of a wheel in three dimensions have beyond their tangent, eight
/// sectors at a time (docs/tyre.md): what fem/finite/rubber_remainder.hpp finds one by one.
/// Included after a pack_*.hpp.
///
/// An element is written in the modes of its corners, which its points see with factors of ±1: the
/// tangents g_i = ∂x/∂ξ_i come of them by sums alone, and the law of an isotropic rubber needs no
/// more than g_i and the metric of the undeformed element: I₁ = M_ik g_i·g_k, det F = g·(g × g)/V,
/// I₂ of cof F alike.
#pragma once
#include "rondo/core/simd/cube_root.hpp"
#include "rondo/integrators/fused/kernels/solid/corners.hpp"

namespace {

using rondo::dynamics::kernels::n_solid_modes;
using rondo::dynamics::kernels::SolidRubber;
using rondo::dynamics::kernels::SolidRubberElement;

constexpr int n_components = 3 * n_solid_modes;
/// The modes are in this order: along ξ, η, ζ; the products ξη, ηζ, ζξ; ξηζ.
enum Mode { mode_x, mode_y, mode_z, mode_xy, mode_yz, mode_zx, mode_xyz };

inline Space operator+(Space a, Space b) noexcept {
  return {a.r + b.r, a.t + b.t, a.z + b.z};
}
inline Space operator-(Space a, Space b) noexcept {
  return {a.r - b.r, a.t - b.t, a.z - b.z};
}
inline Space operator*(Pack s, Space a) noexcept {
  return {s * a.r, s * a.t, s * a.z};
}
inline Space load_mode(const double* x, int mode) noexcept {
  return load_space(x + 3 * mode * lanes, lanes);
}
inline void store_mode(double* x, int mode, Space a) noexcept {
  store_space(x + 3 * mode * lanes, lanes, a);
}

/// By 2 artanh(x / (2 + x)): to round-off where the volume is not halved or doubled.
inline Pack log_of_one_and(Pack x) noexcept {
  const Pack z = x / (all(2.0) + x), square = z * z;
  Pack sum = all(1.0 / 31.0);
  for (int k = 29; k > 0; k -= 2) sum = fma(sum, square, all(1.0 / k));
  return (z + z) * sum;
}

/// Tangents of the element at its points, (3, 4, 3, lanes): g_ξ by η and ζ, g_η by ξ and ζ, g_ζ by
/// ξ and η; also the forces on them.
struct Tangents {
  alignas(64) double of[3][4][3 * 8];
};

/// Tangents of one direction: a + s b + t c + s t d, s and t = ∓1.
inline void put_tangents(double (&to)[4][3 * 8], Space a, Space b, Space c, Space d) noexcept {
  const Space low = a - b, high = a + b, low_more = c - d, high_more = c + d;
  store_space(to[0], lanes, low - low_more);
  store_space(to[1], lanes, high - high_more);
  store_space(to[2], lanes, low + low_more);
  store_space(to[3], lanes, high + high_more);
}
/// The transpose of it.
inline void take_tangents(const double (&from)[4][3 * 8], Space& a, Space& b, Space& c,
                          Space& d) noexcept {
  const Space ll = load_space(from[0], lanes), hl = load_space(from[1], lanes),
              lh = load_space(from[2], lanes), hh = load_space(from[3], lanes);
  const Space low = ll + hl, low_way = hl - ll, high = lh + hh, high_way = hh - lh;
  a = low + high;
  b = low_way + high_way;
  c = high - low;
  d = high_way - low_way;
}

/// Places in Tangents of the point number q = x + 2 y + 4 z.
struct PointPlace {
  int yz, xz, xy;
};
inline PointPlace place_of(int q) noexcept {
  const int x = q & 1, y = (q >> 1) & 1, z = q >> 2;
  return {y + 2 * z, x + 2 * z, x + 2 * y};
}

/// J^(-1/3) at the points, and what the volume of the whole element does.
struct Volumes {
  alignas(64) double root[8][8];
  Pack pressure, energy;
};

/// The roots of all points together, so that none waits for another.
inline Volumes volumes_of(const SolidRubberElement& e, const Tangents& g) noexcept {
  Volumes v{};
  Pack sum = all(0.0), least = all(1e300);
#pragma GCC unroll 2
  for (int q = 0; q < 8; ++q) {
    const PointPlace p = place_of(q);
    const Space a = load_space(g.of[0][p.yz], lanes), b = load_space(g.of[1][p.xz], lanes),
                c = load_space(g.of[2][p.xy], lanes);
    const Pack det = add_dot(a, cross(b, c), all(0.0));
    store(v.root[q], det * all(1.0 / e.volume[q]));
    sum = sum + det;
    least = smaller(det, least);
  }
#pragma GCC unroll 4
  for (int q = 0; q < 8; ++q) store(v.root[q], inverse_cube_root(load(v.root[q])));
  const Pack less_one = (sum - all(e.whole_volume)) * all(1.0 / e.whole_volume);
  const Pack square = less_one * (all(2.0) + less_one);  // J² - 1
  const Pack good = square_root(least);                  // not a number where a det F < 0
  const Pack bulk = all(0.5 * e.bulk);
  v.pressure = bulk * square / (all(1.0) + less_one) + (good - good);
  v.energy = all(0.5 * e.whole_volume) * bulk * (square - all(2.0) * log_of_one_and(less_one));
  return v;
}

/// The forces of the law on the tangents at a point, but for those of the pressure.
struct PointForces {
  Space f[3];
  Pack energy;
};

/// Forces on the tangents at point q.
template <bool Bends, bool Second>
[[gnu::always_inline]] inline PointForces point_forces(const SolidRubberElement& e, int q, Space a,
                                                       Space b, Space c, Pack y,
                                                       Pack pressure) noexcept {
  const auto& m = e.metric[q];
  const Space cof[3] = {cross(b, c), cross(c, a), cross(a, b)};
  const auto with = [](const double(&of)[6], Space x, Space y, Space z, Space(&to)[3]) {
    const Pack xx = all(of[0]), yy = all(of[1]), zz = all(of[2]), xy = all(of[3]), yz = all(of[4]),
               zx = all(of[5]);
    to[0] = add_times(zx, z, add_times(xy, y, xx * x));
    to[1] = add_times(yz, z, add_times(yy, y, xy * x));
    to[2] = add_times(zz, z, add_times(yz, y, zx * x));
  };
  Space h[3];
  with(m, a, b, c, h);
  const Pack zero = all(0.0), third = all(1.0 / 3.0);
  const Pack first = add_dot(a, h[0], add_dot(b, h[1], add_dot(c, h[2], zero)));
  const Pack square = y * y, inverse = square * y;
  const Pack more = fma(square, first, all(-3.0));
  PointForces out;
  Pack slope = all(e.c10);
  out.energy = more * slope;
  if constexpr (Bends) {
    const Pack c20 = all(e.c20), c30 = all(e.c30);
    out.energy = more * fma(more, fma(more, c30, c20), slope);
    slope = fma(more, fma(more, all(3.0) * c30, all(2.0) * c20), slope);
  }
  const Pack by_first = all(2.0) * slope * square;
  Pack by_cof = fnma(by_first * first * third, inverse, pressure);
  const Pack scale = by_first * all(e.volume[q]);
  if constexpr (Second) {
    Space d[3];
    with(e.cometric[q], cof[0], cof[1], cof[2], d);
    const Pack second = add_dot(cof[0], d[0], add_dot(cof[1], d[1], add_dot(cof[2], d[2], zero)));
    const Pack c01 = all(e.c01), fourth = square * square;
    out.energy = fma(c01, fma(fourth, second, all(-3.0)), out.energy);
    const Pack twice = all(2.0) * c01 * fourth;
    by_cof = fnma(all(2.0) * third * twice * second, inverse, by_cof);
    const Pack by_second = twice * all(e.volume[q]);
    out.f[0] = by_second * (cross(b, d[2]) - cross(c, d[1]));
    out.f[1] = by_second * (cross(c, d[0]) - cross(a, d[2]));
    out.f[2] = by_second * (cross(a, d[1]) - cross(b, d[0]));
    for (int i = 0; i < 3; ++i)
      out.f[i] = add_times(scale, h[i], add_times(by_cof, cof[i], out.f[i]));
  } else {
    for (int i = 0; i < 3; ++i) out.f[i] = add_times(scale, h[i], by_cof * cof[i]);
  }
  out.energy = out.energy * all(e.volume[q]);
  return out;
}

/// @param modes, force (n_solid_modes, 3, lanes) of x, and the forces on them. @return the energy
template <bool Bends, bool Second>
[[gnu::noinline]] Pack element_forces(const SolidRubberElement& e, const double* modes,
                                      double* force) noexcept {
  Tangents g{}, f{};
  {
    const Space xy = load_mode(modes, mode_xy), yz = load_mode(modes, mode_yz),
                zx = load_mode(modes, mode_zx), xyz = load_mode(modes, mode_xyz);
    put_tangents(g.of[0], load_mode(modes, mode_x), xy, zx, xyz);
    put_tangents(g.of[1], load_mode(modes, mode_y), xy, yz, xyz);
    put_tangents(g.of[2], load_mode(modes, mode_z), zx, yz, xyz);
  }
  const Volumes volumes = volumes_of(e, g);
  Pack energy = volumes.energy;
  const Pack zero = all(0.0);
  for (int p = 0; p < 4; ++p) {
    store_space(f.of[1][p], lanes, {zero, zero, zero});
    store_space(f.of[2][p], lanes, {zero, zero, zero});
  }
  for (int yz = 0; yz < 4; ++yz) {
    const Space a = load_space(g.of[0][yz], lanes);
    Space sum = {zero, zero, zero};
#pragma GCC unroll 2
    for (int x = 0; x < 2; ++x) {
      const int q = x + 2 * yz;
      const PointPlace p = place_of(q);
      const Space b = load_space(g.of[1][p.xz], lanes), c = load_space(g.of[2][p.xy], lanes);
      const PointForces at =
          point_forces<Bends, Second>(e, q, a, b, c, load(volumes.root[q]), volumes.pressure);
      energy = energy + at.energy;
      sum = sum + at.f[0];
      store_space(f.of[1][p.xz], lanes, load_space(f.of[1][p.xz], lanes) + at.f[1]);
      store_space(f.of[2][p.xy], lanes, load_space(f.of[2][p.xy], lanes) + at.f[2]);
    }
    store_space(f.of[0][yz], lanes, sum);
  }
  Space one, xy, yz, zx, xyz, xy_more, yz_more, zx_more, xyz_more;
  take_tangents(f.of[0], one, xy, zx, xyz);
  store_mode(force, mode_x, one);
  take_tangents(f.of[1], one, xy_more, yz, xyz_more);
  store_mode(force, mode_y, one);
  xyz = xyz + xyz_more;
  take_tangents(f.of[2], one, zx_more, yz_more, xyz_more);
  store_mode(force, mode_z, one);
  store_mode(force, mode_xy, xy + xy_more);
  store_mode(force, mode_yz, yz + yz_more);
  store_mode(force, mode_zx, zx + zx_more);
  store_mode(force, mode_xyz, xyz + xyz_more);
  return energy;
}

inline Pack forces_of(const SolidRubberElement& e, const double* modes, double* force) noexcept {
  if (e.c01 != 0.0) return element_forces<true, true>(e, modes, force);
  if (e.c20 != 0.0 || e.c30 != 0.0) return element_forces<true, false>(e, modes, force);
  return element_forces<false, false>(e, modes, force);
}

/// Modes of u at the corners, 0 where `mask` is.
inline void modes_of(const SolidRubber& s, const SolidRubberElement& e, std::ptrdiff_t column,
                     Pack mask, double* modes) noexcept {
  const rondo::dynamics::kernels::SolidModeShares& c = s.shares;
  Space sum[2], x[2], y[2], xy[2];
#pragma GCC unroll 2
  for (int side = 0; side < 2; ++side) {
    Space u[4];
#pragma GCC unroll 4
    for (int a = 0; a < 4; ++a) u[a] = corner_u(s, e.corner[4 * side + a], column);
    const Space low = u[0] + u[1], high = u[2] + u[3], low_way = u[1] - u[0],
                high_way = u[2] - u[3];
    sum[side] = low + high;
    x[side] = low_way + high_way;
    y[side] = high - low;
    xy[side] = high_way - low_way;
  }
  const Pack one = all(c.one) * mask, two = all(c.two) * mask, three = all(c.three) * mask;
  store_mode(modes, mode_x, one * (x[0] + x[1]));
  store_mode(modes, mode_y, one * (y[0] + y[1]));
  store_mode(modes, mode_z, one * (sum[1] - sum[0]));
  store_mode(modes, mode_xy, two * (xy[0] + xy[1]));
  store_mode(modes, mode_yz, two * (y[1] - y[0]));
  store_mode(modes, mode_zx, two * (x[1] - x[0]));
  store_mode(modes, mode_xyz, three * (xy[1] - xy[0]));
}

/// Adds forces on modes, times a weight, to those on the corners.
inline void add_to_corners(const SolidRubber& s, const SolidRubberElement& e, std::ptrdiff_t column,
                           Pack weight, const double* force) noexcept {
  const rondo::dynamics::kernels::SolidModeShares& c = s.shares;
  const Pack one = all(c.one) * weight, two = all(c.two) * weight, three = all(c.three) * weight;
  const Space x = one * load_mode(force, mode_x), y = one * load_mode(force, mode_y),
              z = one * load_mode(force, mode_z), xy = two * load_mode(force, mode_xy),
              yz = two * load_mode(force, mode_yz), zx = two * load_mode(force, mode_zx),
              xyz = three * load_mode(force, mode_xyz);
#pragma GCC unroll 2
  for (int side = 0; side < 2; ++side) {
    const Space by_x = side == 0 ? x - zx : x + zx, by_y = side == 0 ? y - yz : y + yz,
                by_xy = side == 0 ? xy - xyz : xy + xyz;
    const Space left = by_x - by_xy, right = by_x + by_xy;
    const Space low = side == 0 ? Space{all(0.0) - (z.r + by_y.r), all(0.0) - (z.t + by_y.t),
                                        all(0.0) - (z.z + by_y.z)}
                                : z - by_y,
                high = side == 0 ? by_y - z : by_y + z;
    add_corner(s, e.corner[4 * side + 0], column, low - left);
    add_corner(s, e.corner[4 * side + 1], column, low + left);
    add_corner(s, e.corner[4 * side + 2], column, high + right);
    add_corner(s, e.corner[4 * side + 3], column, high - right);
  }
}

/// Takes the forces of the state and of the tangent from those on modes. @return their work
inline Pack take_tangent(const SolidRubberElement& e, const double* modes, double* force) noexcept {
  Pack u[n_components];
#pragma GCC unroll 21
  for (int n = 0; n < n_components; ++n) u[n] = load(modes + n * lanes);
  Pack work = all(0.0);
  const double* k = e.stiffness;
  for (int m = 0; m < n_components; ++m, k += n_components) {
    Pack a = all(k[0]) * u[0], b = all(k[1]) * u[1], c = all(k[2]) * u[2];
#pragma GCC unroll 6
    for (int n = 3; n < n_components; n += 3) {
      a = fma(all(k[n]), u[n], a);
      b = fma(all(k[n + 1]), u[n + 1], b);
      c = fma(all(k[n + 2]), u[n + 2], c);
    }
    const Pack linear = a + b + c, rest = all(e.force[m]);
    work = fma(load(modes + m * lanes), fma(all(0.5), linear, rest), work);
    store(force + m * lanes, load(force + m * lanes) - rest - linear);
  }
  return work;
}

/// One element on one pack of columns.
inline void rubber_pack(const SolidRubber& s, const SolidRubberElement& e,
                        std::ptrdiff_t column) noexcept {
  alignas(64) double way[n_components * 8], place[n_components * 8], force[n_components * 8];
  modes_of(s, e, column, load(s.mask + column), way);
#pragma GCC unroll 7
  for (int n = 0; n < n_components; ++n)
    store(place + n * lanes, load(way + n * lanes) + all(e.rest[n]));
  const Pack energy = forces_of(e, place, force) - all(e.energy);
  double* const sum = s.energy + column;
  store(sum, load(sum) + (energy - take_tangent(e, way, force)));
  add_to_corners(s, e, column, load(s.weight + column), force);
}

/// Adds the forces of all elements on the packs that are named to zero.
void solid_rubber(const SolidRubber& s) noexcept {
  for (int i = 0; i < s.n_cleared; ++i)
    for (int k = 0; k < s.n_rows; ++k)
      store(s.force + k * s.stride + static_cast<std::ptrdiff_t>(s.cleared[i]) * lanes, all(0.0));
  for (int e = 0; e < s.n_elements; ++e)
    for (int i = 0; i < s.n_packs; ++i)
      rubber_pack(s, s.elements[e], static_cast<std::ptrdiff_t>(s.packs[i]) * lanes);
}

/// Sets forces and energy of an element in the state, by the loops of the steps.
void solid_rubber_state(SolidRubberElement& e) noexcept {
  alignas(64) double place[n_components * 8], force[n_components * 8], energy[8];
  for (int n = 0; n < n_components; ++n) store(place + n * lanes, all(e.rest[n]));
  store(energy, forces_of(e, place, force));
  e.energy = energy[0];
  for (int n = 0; n < n_components; ++n) e.force[n] = force[n * lanes];
}

}  // namespace
