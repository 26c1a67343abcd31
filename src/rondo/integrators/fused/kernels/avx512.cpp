// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx512.hpp"

#include "rondo/integrators/fused/kernels/rubber/layout.hpp"
#include "rondo/integrators/fused/kernels/solid/layout.hpp"
#include "rondo/integrators/fused/kernels/table.hpp"

namespace rondo::dynamics::kernels {
constinit const Table avx512_table =
    table("avx512", avx512_wheel, avx512_ring_product, avx512_rubber, avx512_solid);
}  // namespace rondo::dynamics::kernels
