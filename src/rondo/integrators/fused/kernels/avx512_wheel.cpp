// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx512.hpp"

#include "rondo/integrators/fused/kernels/wheel_table.hpp"

namespace rondo::dynamics::kernels {
constinit const WheelTable avx512_wheel = wheel_table();
}  // namespace rondo::dynamics::kernels
