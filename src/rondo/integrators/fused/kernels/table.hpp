// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of one instruction set. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/cyclic.hpp"
#include "rondo/integrators/fused/kernels/sparse.hpp"

namespace {

constexpr rondo::dynamics::kernels::Table table(const char* name) noexcept {
  return {name,
          {{{{cyclic_strip<false, false, false, false>, cyclic_strip<false, false, false, true>},
             {cyclic_strip<false, false, true, false>, cyclic_strip<false, false, true, true>}},
            {{cyclic_strip<false, true, false, false>, cyclic_strip<false, true, false, true>},
             {cyclic_strip<false, true, true, false>, cyclic_strip<false, true, true, true>}}},
           {{{cyclic_strip<true, false, false, false>, cyclic_strip<true, false, false, true>},
             {cyclic_strip<true, false, true, false>, cyclic_strip<true, false, true, true>}},
            {{cyclic_strip<true, true, false, false>, cyclic_strip<true, true, false, true>},
             {cyclic_strip<true, true, true, false>, cyclic_strip<true, true, true, true>}}}},
          low_columns,
          {{{{sparse_rows<false, false, false, false>, sparse_rows<false, false, false, true>},
             {sparse_rows<false, false, true, false>, sparse_rows<false, false, true, true>}},
            {{sparse_rows<false, true, false, false>, sparse_rows<false, true, false, true>},
             {sparse_rows<false, true, true, false>, sparse_rows<false, true, true, true>}}},
           {{{sparse_rows<true, false, false, false>, sparse_rows<true, false, false, true>},
             {sparse_rows<true, false, true, false>, sparse_rows<true, false, true, true>}},
            {{sparse_rows<true, true, false, false>, sparse_rows<true, true, false, true>},
             {sparse_rows<true, true, true, false>, sparse_rows<true, true, true, true>}}}}};
}

}  // namespace
