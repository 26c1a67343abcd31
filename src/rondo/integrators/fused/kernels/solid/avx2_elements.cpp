// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx2.hpp"

#include "rondo/integrators/fused/kernels/solid/elements.hpp"

namespace rondo::dynamics::kernels {
void avx2_solid_rubber(const SolidRubber& rubber) noexcept {
  solid_rubber(rubber);
}
void avx2_solid_rubber_state(SolidRubberElement& element) noexcept {
  solid_rubber_state(element);
}
}  // namespace rondo::dynamics::kernels
