// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_baseline.hpp"

#include "rondo/integrators/bodies/kernels/passes.hpp"

namespace rondo::dynamics::kernels {
constinit const BodyTable baseline_bodies = body_table("baseline");
}  // namespace rondo::dynamics::kernels
