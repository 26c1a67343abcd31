// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/simd/pack_avx2.hpp"

#include "rondo/integrators/fused/kernels/solid/faces.hpp"

namespace rondo::dynamics::kernels {
void avx2_solid_faces(const SolidFaces& faces) noexcept {
  solid_faces(faces);
}
}  // namespace rondo::dynamics::kernels
