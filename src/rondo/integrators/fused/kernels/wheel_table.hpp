// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of one instruction set on a loaded rim. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/wheel_cyclic.hpp"
#include "rondo/integrators/fused/kernels/wheel_sparse.hpp"

namespace {

constexpr rondo::dynamics::kernels::WheelTable wheel_table() noexcept {
  return {{wheel_strip<false>, wheel_strip<true>},
          wheel_strip_way,
          {wheel_rows<false>, wheel_rows<true>},
          wheel_rows_way};
}

}  // namespace
