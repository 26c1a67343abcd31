// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx512.hpp"

#include "rondo/integrators/fused/kernels/solid/wheel.hpp"

namespace rondo::dynamics::kernels {
constinit const SolidWheelTable avx512_solid_wheel = {solid_wheel_strip, solid_wheel_way};
}  // namespace rondo::dynamics::kernels
