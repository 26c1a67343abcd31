// SPDX-License-Identifier: BSD-3-Clause
/// A study file: read, its members listed, some of them read as cases of a small disk. Each member
/// has a value for each parameter, and no two parameters are one key.
#include <set>

#include "case_input.hpp"
#include "mutate.hpp"
#include "rondo/study/sweep/sweep_plan.hpp"

using namespace rondo;

namespace {

constexpr std::size_t most_listed = 20'000, most_read = 20;

const std::string base = R"(schema = 1
title = "small"
[disk]
outer_radius = 0.3
inner_radius = 0.15
[disk.mesh]
radial = 2
circumferential = 12
[material]
youngs_modulus = 2e7
poissons_ratio = 0.3
density = 1100
[motion]
angular_velocity = 33
speed = 10
height = 0.31
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.01
)";

/// Of the full grid, times the sample; as a double, for it may be beyond integers.
double n_members(const study::SweepStudy& study) {
  double n = study.sample ? study.sample->count : 1.0;
  for (const study::Vary& vary : study.parameters)
    n *= vary.uniform ? 1.0 : static_cast<double>(vary.values.size());
  return n;
}

void check_members(const study::SweepStudy& study) {
  const double expected = n_members(study);
  if (expected > static_cast<double>(most_listed)) return;
  const std::vector<study::Member> members = study::members_of(study);
  fuzz::check(static_cast<double>(members.size()) == expected, "not the full grid");
  for (std::size_t m = 0; m < members.size(); ++m) {
    fuzz::check(members[m].values.size() == study.parameters.size(), "a parameter has no value");
    for (const std::string& value : members[m].values)
      fuzz::check(!value.empty(), "a value is empty");
    if (m >= most_read) continue;
    static_cast<void>(fuzz::accepted([&] {
      static_cast<void>(study::read_case_text("base.toml", base, settings_of(study, members[m])));
    }));
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  return fuzz::mutate_text(data, size, max, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  study::SweepStudy study;
  if (!fuzz::accepted([&] {
        study = study::read_study_text("study.toml", std::string(fuzz::view(data, size)));
      }))
    return 0;
  std::set<std::string> keys;
  for (const study::Vary& vary : study.parameters) {
    fuzz::check(keys.insert(vary.key).second, "a key is varied twice");
    fuzz::check(vary.uniform.has_value() || !vary.values.empty(), "a parameter without values");
  }
  check_members(study);
  return 0;
}
