// SPDX-License-Identifier: BSD-3-Clause
#include "results_checks.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "fuzz.hpp"
#include "rondo/pod/decompose.hpp"
#include "rondo/study/pod/pod_input.hpp"

namespace rondo::fuzz {
namespace {

void read_fields(const io::RunReader& run) {
  for (const auto quantity :
       {io::Quantity::displacement, io::Quantity::velocity, io::Quantity::contact}) {
    if (!run.has(quantity)) continue;
    std::vector<Vec2> field(run.n_points(quantity));
    for (std::size_t k = 0; k < run.n_snapshots(); ++k) run.read(quantity, k, 0, field);
  }
  for (std::size_t k = 1; k < run.n_snapshots(); ++k)
    check(run.times().time[k] > run.times().time[k - 1], "times that do not rise");
}

study::PodRequest request_of(const std::filesystem::path& run, std::uint32_t choice) {
  static constexpr std::array fields{"displacement", "velocity", "contact"};
  study::PodRequest request;
  request.runs = {run};
  request.field = fields[choice % 3];
  request.frame = choice / 3 % 2 == 0 ? "rotating" : "rectified";
  request.shift = choice / 6 % 2 == 0 ? "fourier" : "pitch";
  request.directory = scratch_folder() / "pod";
  return request;
}

void decompose(const study::PodRequest& request) {
  const study::SnapshotChoice choice = study::snapshot_choice_of(request);
  const std::vector<io::RunReader> runs = study::open_runs(request, choice);
  study::RunSnapshots snapshots(runs, study::columns_of(request, choice, runs), choice);
  const pod::Decomposition found = pod::decompose(snapshots, {});
  for (const double sigma : found.sigma)
    check(std::isfinite(sigma) && sigma >= 0.0, "a singular value that is none");
}

}  // namespace

void check_results(const std::filesystem::path& run, std::uint32_t choice) {
  std::optional<io::RunReader> reader;
  if (!accepted([&] { read_fields(reader.emplace(run)); })) return;
  reader.reset();
  accepted([&] { decompose(request_of(run, choice)); });
  constexpr std::uint32_t seldom = 32;  // it writes its own files
  if (choice / 16 % seldom == 0)
    accepted([&] { static_cast<void>(study::run_pod(request_of(run, choice))); });
}

}  // namespace rondo::fuzz
