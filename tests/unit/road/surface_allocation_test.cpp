// SPDX-License-Identifier: BSD-3-Clause
/// Both surfaces of a road are evaluated in each time step, without memory of their own.
#include <gtest/gtest.h>

#include "rondo/road/surface.hpp"
#include "support/allocations.hpp"
#include "support/crg_files.hpp"

namespace surface_allocation_test {

using namespace rondo;
using namespace rondo::road;

TEST(RoadAllocation, EvaluationAllocatesNothing) {
  const Road road =
      test::road_by([](double u, double v) { return u * v; }, 3.0, 0.2, 12, {-1.0, -0.3, 0.0, 0.1});
  const Surface surface(road, {.u = Border::repeat});
  const long before = test::allocations();
  double sum = 0.0;
  for (int k = 0; k < 100; ++k)
    sum += surface.at(0.1 * k, 0.02 * k).height + surface.bilinear(0.1 * k, 0.0);
  EXPECT_EQ(test::allocations() - before, 0);
  EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace surface_allocation_test
