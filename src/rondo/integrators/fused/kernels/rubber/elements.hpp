// SPDX-License-Identifier: BSD-3-Clause
/// @file  The loop over elements of rubber, eight a register (docs/rubber.md, section 4). Included
/// after a pack_*.hpp.
#pragma once
#include "rondo/core/simd/cube_root.hpp"
#include "rondo/fem/hyperelastic/one_point.hpp"
#include "rondo/integrators/fused/kernels/rubber/layout.hpp"

namespace rondo::fem::hyperelastic {
template <>
inline Pack as<Pack>(double value) noexcept {
  return all(value);
}
}  // namespace rondo::fem::hyperelastic

namespace {

namespace rubber = rondo::fem::hyperelastic;
using rondo::dynamics::kernels::RubberElements;
static_assert(rondo::dynamics::kernels::lanes == 8 && sizeof(Pack) == 8 * sizeof(double));

inline Pack bounded(Pack j_less_1) noexcept {
  return larger(j_less_1, all(rubber::least_volume - 1.0));
}

/// By 2 artanh(x / (2 + x)): to round-off where the volume is not halved or doubled.
inline Pack log1p(Pack x) noexcept {
  const Pack z = x / (all(2.0) + x), square = z * z;
  Pack sum = all(1.0 / 31.0);
  for (int k = 29; k > 0; k -= 2) sum = fma(sum, square, all(1.0 / k));
  return (z + z) * sum;
}

/// The law of Ogden lane by lane: its powers are those of the library.
struct OgdenLanes {
  const rondo::fem::Rubber& of;
  explicit OgdenLanes(const rondo::fem::Rubber& r) noexcept : of(r) {}

  rubber::PlaneStress<Pack> operator()(Pack s, Pack j) const noexcept {
    double of_s[8], of_j[8], a[8], b[8], w[8];
    store(of_s, s);
    store(of_j, j);
    rubber::ogden_stress(of, of_s, of_j, a, b, w);
    return {load(a), load(b), load(w)};
  }
};

inline rubber::Bilinear<Pack> load_bilinear(const double* x) noexcept {
  return {{load(x), load(x + 8)}, {load(x + 16), load(x + 24)}, {load(x + 32), load(x + 40)}};
}

inline rubber::Bilinear<Pack> gather_corners(const RubberElements& e,
                                             std::ptrdiff_t pack) noexcept {
  rubber::Corners<Pack> u;
  const std::int32_t* node = e.node + pack * 4 * 8;
  for (std::size_t c = 0; c < 4; ++c) gather_pairs(e.now, node + c * 8, u[c].x, u[c].y);
  return rubber::bilinear(u);
}

/// The sums of RubberSums, lane by lane.
struct ElementSums {
  Pack before, after, energy;
};

/// Elements of a pack that are counted.
inline int lanes_of(const RubberElements& e, std::ptrdiff_t pack) noexcept {
  return pack + 1 == e.n_packs ? e.lanes_of_last : 8;
}

/// Steps of the branches of a pack, their stress added to that of the elements.
inline void add_branches(const RubberElements& e, std::ptrdiff_t pack,
                         const rubber::Bilinear<Pack>& x, const rubber::Bilinear<Pack>& u,
                         rubber::Bilinear<Pack>& by, ElementSums& sums) noexcept {
  const rubber::Gradient<Pack> g = rubber::local_gradient(x, 0.0, 0.0);
  const Pack area = cross(g.x, g.y);  // a quarter of the element's
  const auto state = rubber::point_state(g, rubber::local_gradient(u, 0.0, 0.0), all(1.0) / area);
  const Pack y = inverse_cube_root(all(1.0) + bounded(state.j_less_1));
  const auto c = rubber::right_cauchy_green(state.f);
  const int n = lanes_of(e, pack);
  for (int k = 0; k < e.n_branches; ++k) {
    double* at = e.history + (pack * e.n_branches + k) * 24;
    const Pack growth = all(e.branches[k].growth), modulus = all(e.branches[k].modulus);
    const rubber::Symmetric<Pack> old = {load(at), load(at + 8), load(at + 16)};
    const auto now = rubber::relaxed(old, c, y, growth), next = rubber::relaxed(now, c, y, growth);
    store(at, next.xx);
    store(at + 8, next.yy);
    store(at + 16, next.xy);
    const Pack at_now = rubber::unrelaxed(now, c, y);
    const Pack scale = first_lanes(n, all(2.0) * modulus * area, all(0.0));
    sums.before = fma(scale, rubber::unrelaxed(old, c, y) - at_now, sums.before);
    sums.after = fma(scale, at_now - rubber::unrelaxed(next, c, y), sums.after);
    sums.energy = fma(scale, at_now - all(3.0), sums.energy);
    rubber::add_stress(rubber::branch_stress(state.f, now, y, all(4.0) * modulus), g, 0.0, 0.0, by);
  }
}

inline double lanes_sum(Pack a) noexcept {
  double x[8];
  store(x, a);
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}
inline double least_lane(Pack a) noexcept {
  double x[8];
  store(x, a);
  double least = x[0];
  for (int i = 1; i < 8; ++i) least = x[i] < least ? x[i] : least;
  return least;
}

template <class Law, bool OnePoint>
void rubber_elements(const RubberElements& e) noexcept {
  const Law law(*e.rubber);
  const Pack bulk = all(e.rubber->bulk_modulus), shear = all(e.shear), zero = all(0.0);
  ElementSums sums = {zero, zero, zero};
  Pack least = all(1e300);
  for (std::ptrdiff_t pack = 0; pack < e.n_packs; ++pack) {
    const auto x = load_bilinear(e.geometry + pack * 48), u = gather_corners(e, pack);
    auto result = OnePoint ? rubber::one_point(x, u, law, bulk, shear)
                           : rubber::mean_dilatation(x, u, law, bulk);
    least = smaller(result.least, least);
    sums.energy = sums.energy + first_lanes(lanes_of(e, pack), result.energy, zero);
    if (e.n_branches > 0) add_branches(e, pack, x, u, result.by, sums);
    const rubber::Corners<Pack> force = rubber::at_corners(result.by);
    double* to = e.force + pack * 4 * 16;
    for (std::size_t c = 0; c < 4; ++c) store_pairs(to + c * 16, force[c].x, force[c].y);
  }
  *e.sums = {lanes_sum(sums.before), lanes_sum(sums.after), lanes_sum(sums.energy),
             least_lane(least)};
}

}  // namespace
