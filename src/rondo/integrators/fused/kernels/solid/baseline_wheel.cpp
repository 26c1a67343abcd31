// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_baseline.hpp"

#include "rondo/integrators/fused/kernels/solid/wheel.hpp"

namespace rondo::dynamics::kernels {
constinit const SolidWheelTable baseline_solid_wheel = {solid_wheel_strip, solid_wheel_way};
}  // namespace rondo::dynamics::kernels
