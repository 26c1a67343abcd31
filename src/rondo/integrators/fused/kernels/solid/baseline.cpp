// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_baseline.hpp"

#include "rondo/integrators/fused/kernels/solid/table.hpp"

namespace rondo::dynamics::kernels {
constinit const SolidTable baseline_solid = solid_table(
    baseline_solid_wheel, baseline_solid_faces, baseline_solid_rubber, baseline_solid_rubber_state);
}  // namespace rondo::dynamics::kernels
