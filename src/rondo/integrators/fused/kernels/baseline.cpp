// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_baseline.hpp"

#include "rondo/integrators/fused/kernels/rubber/layout.hpp"
#include "rondo/integrators/fused/kernels/solid/layout.hpp"
#include "rondo/integrators/fused/kernels/table.hpp"

namespace rondo::dynamics::kernels {
constinit const Table baseline_table =
    table("baseline", baseline_wheel, baseline_ring_product, baseline_rubber, baseline_solid);
}  // namespace rondo::dynamics::kernels
