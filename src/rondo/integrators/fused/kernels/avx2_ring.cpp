// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx2.hpp"

#include "rondo/integrators/fused/kernels/ring.hpp"

namespace rondo::dynamics::kernels {
void avx2_ring_product(const RingTerms& terms) noexcept {
  ring_product(terms);
}
}  // namespace rondo::dynamics::kernels
