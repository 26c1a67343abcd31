// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_baseline.hpp"

#include "rondo/integrators/fused/kernels/solid/elements.hpp"

namespace rondo::dynamics::kernels {
void baseline_solid_rubber(const SolidRubber& rubber) noexcept {
  solid_rubber(rubber);
}
void baseline_solid_rubber_state(SolidRubberElement& element) noexcept {
  solid_rubber_state(element);
}
}  // namespace rondo::dynamics::kernels
