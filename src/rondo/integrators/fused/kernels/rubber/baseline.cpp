// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_baseline.hpp"

#include "rondo/integrators/fused/kernels/rubber/table.hpp"

namespace rondo::dynamics::kernels {
constinit const RubberTable baseline_rubber = rubber_table();
}  // namespace rondo::dynamics::kernels
