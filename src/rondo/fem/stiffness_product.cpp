// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/stiffness_product.hpp"

#include "rondo/core/threads.hpp"

namespace rondo::fem {
namespace {

Vec2 row_product(const BlockCsr& k, std::size_t row, const Vec2* u) noexcept {
  double x = 0.0, y = 0.0;
  for (auto at = k.row_start[row]; at < k.row_start[row + 1]; ++at) {
    const auto b = static_cast<std::size_t>(at);
    const BlockCsr::Block& block = k.values[b];
    const Vec2 column = u[k.column[b]];
    x += block[0] * column.x + block[2] * column.y;
    y += block[1] * column.x + block[3] * column.y;
  }
  return {x, y};
}

}  // namespace

void apply(const BlockCsr& k, std::span<const Vec2> u, std::span<Vec2> out, int threads) noexcept {
  for_blocks(out.size(), threads, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t row = begin; row < end; ++row) out[row] = row_product(k, row, u.data());
  });
}

}  // namespace rondo::fem
