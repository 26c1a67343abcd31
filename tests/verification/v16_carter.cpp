// SPDX-License-Identifier: BSD-3-Clause
/// V16: braking, free rolling and driving of a rolling disk against Carter. Layers are equal: thin
/// ones at the ground have waves of their own, which the nodes that come down stir up, and which
/// make sliding chatter.
#include "support/carter.hpp"

namespace v16_carter {

using namespace rondo;

/// 4 elements to the half width, which is found to a fifth of one. Creeps are off by the curvature
/// of the disk, a/(μR) = 0.11 of the strains that friction makes, most of which is in the creep of
/// free rolling as well.
TEST(Carter, CreepAndStickZone) {
  test::expect_carter({.radial = 24, .grading = 1.0}, {-0.012, 0.008}, 0.02, 0.035);
}

/// All of the contact slides, with all of the friction: what chatter takes is below a thousandth.
TEST(Carter, FullSlidingIsFullFriction) {
  for (const double creep : {-0.03, 0.028}) {
    const test::CarterMeans m = test::roll({.radial = 16, .creep = creep, .grading = 1.0});
    EXPECT_GT(std::abs(m.share()), 0.999) << creep;
    EXPECT_LT(m.largest, 1.0 + 1e-12);
    EXPECT_GT(m.step, 2.5 * 2.887e-6) << "that of ten layers graded by 2";
    RecordProperty(fmt::format("full_{}", creep), fmt::format("Q/(muP) {:.5f}", m.share()));
  }
}

}  // namespace v16_carter
