// SPDX-License-Identifier: BSD-3-Clause
/// @file  2×2 matrices between contact frames, velocities and impulses.
#pragma once
#include <array>

#include "rondo/core/complex.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::contact {

/// A 2×2 matrix by rows: nn, nt, tn, tt.
using Block = std::array<double, 4>;

constexpr Vec2 apply(const Block& a, Vec2 b) noexcept {
  return {a[0] * b.x + a[1] * b.y, a[2] * b.x + a[3] * b.y};
}
/// Aᵀ b, which is also the row bᵀ A.
constexpr Vec2 transposed(const Block& a, Vec2 b) noexcept {
  return {a[0] * b.x + a[2] * b.y, a[1] * b.x + a[3] * b.y};
}
constexpr Block times(const Block& a, const Block& b) noexcept {
  return {a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2],
          a[2] * b[1] + a[3] * b[3]};
}
constexpr Block sum(const Block& a, const Block& b) noexcept {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
constexpr Block minus(const Block& a) noexcept {
  return {-a[0], -a[1], -a[2], -a[3]};
}
constexpr Block inverse(const Block& a) noexcept {
  const double d = 1.0 / (a[0] * a[3] - a[1] * a[2]);
  return {d * a[3], -d * a[1], -d * a[2], d * a[0]};
}
/// The product with a complex number.
constexpr Block block_of(Complex a) noexcept {
  return {a.re, -a.im, a.im, a.re};
}

/// A 2 × 2 block by what it does to z = x + iy: same z + mirrored z̄.
struct ComplexBlock {
  Complex same, mirrored;
};
constexpr ComplexBlock complex_block(const Block& a) noexcept {
  return {{0.5 * (a[0] + a[3]), 0.5 * (a[2] - a[1])}, {0.5 * (a[0] - a[3]), 0.5 * (a[2] + a[1])}};
}
constexpr Block block_of(const ComplexBlock& a) noexcept {
  return {a.same.re + a.mirrored.re, a.mirrored.im - a.same.im, a.same.im + a.mirrored.im,
          a.same.re - a.mirrored.re};
}

/// A response G of one node to an impulse on another, between their contact frames.
/// @param to, from  turn velocities of the one and of the other into their contact frames
constexpr Block in_frames(Complex to, const Block& g, Complex from) noexcept {
  return times(block_of(to), times(g, block_of(conj(from))));
}

}  // namespace rondo::contact
