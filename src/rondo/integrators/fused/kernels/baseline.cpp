// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_baseline.hpp"

#include "rondo/integrators/fused/kernels/table.hpp"

namespace rondo::dynamics::kernels {
constinit const Table baseline_table = table("baseline", baseline_wheel, baseline_ring_product);
}  // namespace rondo::dynamics::kernels
