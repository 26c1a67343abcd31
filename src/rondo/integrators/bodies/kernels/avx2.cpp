// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx2.hpp"

#include "rondo/integrators/bodies/kernels/passes.hpp"

namespace rondo::dynamics::kernels {
constinit const BodyTable avx2_bodies = body_table("avx2");
}  // namespace rondo::dynamics::kernels
