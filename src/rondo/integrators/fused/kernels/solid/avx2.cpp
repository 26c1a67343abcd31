// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx2.hpp"

#include "rondo/integrators/fused/kernels/solid/table.hpp"

namespace rondo::dynamics::kernels {
constinit const SolidTable avx2_solid =
    solid_table(avx2_solid_wheel, avx2_solid_faces, avx2_solid_rubber, avx2_solid_rubber_state);
}  // namespace rondo::dynamics::kernels
