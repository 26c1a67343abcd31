// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of one instruction set. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/cyclic.hpp"
#include "rondo/integrators/fused/kernels/sparse.hpp"
#include "rondo/integrators/fused/kernels/wheel_cyclic.hpp"
#include "rondo/integrators/fused/kernels/wheel_sparse.hpp"

namespace {

constexpr rondo::dynamics::kernels::Table table(const char* name) noexcept {
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
          {{wheel_strip<false, false>, wheel_strip<false, true>},
           {wheel_strip<true, false>, wheel_strip<true, true>}},
          wheel_strip_way,
          {{wheel_rows<false, false>, wheel_rows<false, true>},
           {wheel_rows<true, false>, wheel_rows<true, true>}},
          wheel_rows_way};
}

}  // namespace
