// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/operator.hpp"

#include "rondo/core/contract.hpp"
#include "rondo/core/threads.hpp"

namespace rondo::dynamics {
namespace {

Vec2 row_product(const fem::BlockCsr& k, std::size_t row, const Vec2* u) noexcept {
  double x = 0.0, y = 0.0;
  for (auto at = k.row_start[row]; at < k.row_start[row + 1]; ++at) {
    const auto b = static_cast<std::size_t>(at);
    const fem::BlockCsr::Block& block = k.values[b];
    const Vec2 column = u[k.column[b]];
    x += block[0] * column.x + block[2] * column.y;
    y += block[1] * column.x + block[3] * column.y;
  }
  return {x, y};
}

}  // namespace

void apply(const fem::BlockCsr& k, std::span<const Vec2> u, std::span<Vec2> out,
           int threads) noexcept {
  for_blocks(out.size(), threads, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t row = begin; row < end; ++row) out[row] = row_product(k, row, u.data());
  });
}

void apply_stiffness(const Model& model, std::span<const Vec2> u, std::span<Vec2> out) {
  if (!model.stiffness.row_start.empty()) return apply(model.stiffness, u, out, model.threads);
  RONDO_DEMAND(model.sector.has_value());
  fem::apply(*model.sector, u, out);
}

}  // namespace rondo::dynamics
