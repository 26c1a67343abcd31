// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx512.hpp"

#include "rondo/integrators/bodies/kernels/passes.hpp"

namespace rondo::dynamics::kernels {
constinit const BodyTable avx512_bodies = body_table("avx512");
}  // namespace rondo::dynamics::kernels
