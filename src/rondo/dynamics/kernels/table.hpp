// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of one instruction set. Included after a pack_*.hpp.
#pragma once
#include "rondo/dynamics/kernels/cyclic.hpp"

namespace {

constexpr rondo::dynamics::kernels::Table table(const char* name) noexcept {
  return {name,
          {{{cyclic_row<false, false, false>, cyclic_row<false, false, true>},
            {cyclic_row<false, true, false>, cyclic_row<false, true, true>}},
           {{cyclic_row<true, false, false>, cyclic_row<true, false, true>},
            {cyclic_row<true, true, false>, cyclic_row<true, true, true>}}},
          advance_row,
          low_columns};
}

}  // namespace
