// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx512.hpp"

#include "rondo/integrators/fused/kernels/solid/table.hpp"

namespace rondo::dynamics::kernels {
constinit const SolidTable avx512_solid = solid_table(
    avx512_solid_wheel, avx512_solid_faces, avx512_solid_rubber, avx512_solid_rubber_state);
}  // namespace rondo::dynamics::kernels
