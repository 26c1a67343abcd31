// SPDX-License-Identifier: BSD-3-Clause
#include "tiny_run.hpp"

#include "fuzz.hpp"
#include "rondo/analysis/run.hpp"

namespace rondo::fuzz {
namespace {

constexpr const char* case_text = R"(schema = 1
title = "tiny"
[disk]
outer_radius = 0.5
inner_radius = 0.25
mesh = {radial = 2, circumferential = 6}
[material]
youngs_modulus = 2e7
poissons_ratio = 0.3
density = 1000.0
[motion]
angular_velocity = 20.0
speed = 10.0
height = 0.499
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.005
[output]
snapshots = 3
stress = false
history_interval = 0.001
)";

}  // namespace

study::Case tiny_case() {
  return study::read_case_text("tiny.toml", case_text);
}

void make_tiny_run(const std::filesystem::path& directory) {
  study::RunOptions options;
  options.directory = directory;
  options.threads = 1;
  options.overwrite = true;
  const study::RunReport report = study::run_case(tiny_case(), options);
  check(report.status == study::RunStatus::done, "the run to begin with has failed");
}

}  // namespace rondo::fuzz
