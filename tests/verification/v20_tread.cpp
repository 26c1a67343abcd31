// SPDX-License-Identifier: BSD-3-Clause
/// V20: the treaded disk's forces in rolling, and the pitch frequency in them, by both operators.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "rondo/core/complex.hpp"
#include "support/models.hpp"
#include "support/stepping.hpp"

namespace v20_tread {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr double pitches = 60.0, spin = 33.333333;

/// Amplitude of the part of `values` with a frequency, over the time of whole pitches.
double amplitude(const std::vector<double>& values, double dt, double frequency) {
  Complex sum;
  for (std::size_t j = 0; j < values.size(); ++j)
    sum += values[j] * rotation(-2.0 * std::numbers::pi * frequency * dt * static_cast<double>(j));
  return 2.0 * norm(sum) / static_cast<double>(values.size());
}

class Tread : public testing::TestWithParam<StiffnessOperator> {};

}  // namespace

TEST_P(Tread, ForcesAndPitchFrequency) {
  test::DiskCase c = test::rolling_disk(9, 0);
  c.disk.tread = mesh::Tread{60, 0.02, 3, 1, 2};
  auto b = test::build(c);
  test::add_ground(b, test::ledge(), {0.3, 0.0});
  test::Stepping run(b, GetParam());
  const double pitch = pitches * spin / (2.0 * std::numbers::pi);  // 318.3 Hz
  const double from = 0.1, to = from + 40.0 / pitch;               // whole pitches
  std::vector<double> force_x, force_y;
  run.advance_to(to, [&](const StepReport& step) {
    if (step.frame.time <= from) return;
    force_x.push_back(step.contact.impulse.x / b.model.dt);
    force_y.push_back(step.contact.impulse.y / b.model.dt);
  });
  // 0.5 %: the reference's own scatter with the step, and where its mean ends.
  const double mean_x = 0.5 * amplitude(force_x, b.model.dt, 0.0);
  const double mean_y = 0.5 * amplitude(force_y, b.model.dt, 0.0);
  EXPECT_NEAR(mean_y, 1.7209e5, 0.005 * 1.7209e5);
  EXPECT_NEAR(mean_x, 1.961e4, 0.005 * 1.961e4);  // backwards; amplitude() takes the size
  EXPECT_LT(force_x[force_x.size() / 2], 0.0);
  // The line at the pitch frequency stands out of all others below its double but those near it.
  const double peak = amplitude(force_y, b.model.dt, pitch);
  RecordProperty("peak_over_mean", std::to_string(peak / mean_y));
  for (double share = 0.1; share < 1.95; share += 0.05) {
    if (std::abs(share - 1.0) < 0.075) continue;
    EXPECT_LT(amplitude(force_y, b.model.dt, share * pitch), 0.5 * peak) << share;
  }
  // So do its multiples, each against what lies between them.
  for (const double multiple : {2.0, 3.0})
    EXPECT_GT(amplitude(force_y, b.model.dt, multiple * pitch),
              3.0 * amplitude(force_y, b.model.dt, (multiple - 0.5) * pitch))
        << multiple;
}

INSTANTIATE_TEST_SUITE_P(Both, Tread, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });

}  // namespace v20_tread
