// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of one instruction set. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/cyclic.hpp"
#include "rondo/integrators/fused/kernels/sparse.hpp"

namespace {

constexpr rondo::dynamics::kernels::Table table(const char* name) noexcept {
  return {name,
          {{cyclic_strip<false, false>, cyclic_strip<false, true>},
           {cyclic_strip<true, false>, cyclic_strip<true, true>}},
          low_columns,
          {{sparse_rows<false, false>, sparse_rows<false, true>},
           {sparse_rows<true, false>, sparse_rows<true, true>}}};
}

}  // namespace
