// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "rondo/output/snapshot_schedule.hpp"

namespace snapshot_schedule_test {

using namespace rondo::study;

namespace {

Output output(int snapshots, double from = 0.0) {
  Output o;
  o.snapshots = snapshots;
  o.snapshots_from = from;
  return o;
}

using Steps = std::vector<long long>;
constexpr double dt = 0.125;  // exact

}  // namespace

TEST(SnapshotSchedule, IsEvenlySpreadWithBothEnds) {
  EXPECT_EQ(snapshot_schedule(output(5), dt, 40).steps, (Steps{0, 10, 20, 30, 40}));
  EXPECT_EQ(snapshot_schedule(output(3, 2.5), dt, 40).steps, (Steps{20, 30, 40}));
  EXPECT_EQ(snapshot_schedule(output(1), dt, 40).steps, (Steps{40}));
  EXPECT_EQ(snapshot_schedule(output(0), dt, 40).steps, Steps{});
  EXPECT_EQ(snapshot_schedule(output(9), dt, 2).steps, (Steps{0, 1, 2})) << "one for each step";
  EXPECT_EQ(snapshot_schedule(output(5), dt, 40).interval, 1.25);
}

TEST(SnapshotSchedule, OfALongerRunIsThatOfOneWhichWasSoLongFromTheStart) {
  for (const double from : {0.0, 2.5}) {
    const SnapshotSchedule half = snapshot_schedule(output(5, from), dt, 40);
    const double interval = half.interval;
    const auto longer = static_cast<long long>(40 + 4 * interval / dt);
    const SnapshotSchedule whole = snapshot_schedule(output(9, from), dt, longer);
    EXPECT_EQ(with_end(half, output(5, from), dt, longer).steps, whole.steps);
  }
}

TEST(SnapshotSchedule, OfAnotherEndHasItsLastSnapshotThere) {
  const SnapshotSchedule whole = snapshot_schedule(output(5), dt, 40);
  EXPECT_EQ(with_end(whole, output(5), dt, 43).steps, (Steps{0, 10, 20, 30, 40, 43}));
  EXPECT_EQ(with_end(whole, output(5), dt, 57).steps, (Steps{0, 10, 20, 30, 40, 50, 57}));
  EXPECT_EQ(with_end(whole, output(5), dt, 25).steps, (Steps{0, 10, 20, 25}));
  EXPECT_EQ(with_end(snapshot_schedule(output(1), dt, 40), output(1), dt, 60).steps,
            (Steps{40, 60}));
  EXPECT_EQ(with_end(snapshot_schedule(output(0), dt, 40), output(0), dt, 60).steps, Steps{});
  // Twice gone on with: still the interval of the start.
  const SnapshotSchedule odd = with_end(whole, output(5), dt, 57);
  EXPECT_EQ(with_end(odd, output(5), dt, 75).steps, (Steps{0, 10, 20, 30, 40, 50, 57, 60, 70, 75}));
  // Each step a snapshot, and so it goes on.
  EXPECT_EQ(with_end(snapshot_schedule(output(9), dt, 2), output(9), dt, 4).steps,
            (Steps{0, 1, 2, 3, 4}));
}

}  // namespace snapshot_schedule_test
