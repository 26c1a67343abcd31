// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx512.hpp"

#include "rondo/integrators/fused/kernels/ring.hpp"

namespace rondo::dynamics::kernels {
void avx512_ring_product(const RingTerms& terms) noexcept {
  ring_product(terms);
}
}  // namespace rondo::dynamics::kernels
