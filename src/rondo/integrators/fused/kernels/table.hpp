// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of one instruction set. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/cyclic.hpp"
#include "rondo/integrators/fused/kernels/low_columns.hpp"
#include "rondo/integrators/fused/kernels/sparse.hpp"

namespace {

constexpr rondo::dynamics::kernels::Table table(
    const char* name, const rondo::dynamics::kernels::WheelTable& wheel,
    rondo::dynamics::RingProduct ring, const rondo::dynamics::kernels::RubberTable& rubber,
    const rondo::dynamics::kernels::SolidTable& solid) noexcept {
  return {name,
          {{{cyclic_strip<false, false, false>, cyclic_strip<false, false, true>},
            {cyclic_strip<false, true, false>, cyclic_strip<false, true, true>}},
           {{cyclic_strip<true, false, false>, cyclic_strip<true, false, true>},
            {cyclic_strip<true, true, false>, cyclic_strip<true, true, true>}}},
          low_columns,
          {{{sparse_rows<false, false, false>, sparse_rows<false, false, true>},
            {sparse_rows<false, true, false>, sparse_rows<false, true, true>}},
           {{sparse_rows<true, false, false>, sparse_rows<true, false, true>},
            {sparse_rows<true, true, false>, sparse_rows<true, true, true>}}},
          &wheel,
          ring,
          &rubber,
          &solid};
}

}  // namespace
