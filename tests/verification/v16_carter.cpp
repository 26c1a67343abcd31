// SPDX-License-Identifier: BSD-3-Clause
/// V16: braking, free rolling and driving of a rolling disk against Carter.
#include "support/carter.hpp"

using namespace rondo;

/// 4 elements to the half width, which is found to a fifth of one. Creeps are off by the curvature
/// of the disk, a/(μR) = 0.11 of the strains that friction makes, most of which is in the creep of
/// free rolling as well.
TEST(Carter, CreepAndStickZone) {
  test::expect_carter({10, 450}, {-0.012, 0.008}, 0.025, 0.05);
}
