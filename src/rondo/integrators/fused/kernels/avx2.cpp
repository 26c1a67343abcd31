// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx2.hpp"

#include "rondo/integrators/fused/kernels/rubber/layout.hpp"
#include "rondo/integrators/fused/kernels/solid/layout.hpp"
#include "rondo/integrators/fused/kernels/table.hpp"

namespace rondo::dynamics::kernels {
constinit const Table avx2_table =
    table("avx2", avx2_wheel, avx2_ring_product, avx2_rubber, avx2_solid);
}  // namespace rondo::dynamics::kernels
