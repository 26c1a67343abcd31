// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/pod/pod_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

using pod::Index;

constexpr std::array<double, 3> counted_shares{1e-2, 1e-4, 1e-6};

std::vector<PodCount> count_modes(const pod::Spectrum& spectrum) {
  std::vector<PodCount> counts;
  for (const double share : counted_shares) counts.push_back({share, modes_for(spectrum, share)});
  return counts;
}

void add_energies(PodReport& report, const pod::Decomposition& d, const pod::Spectrum& spectrum) {
  report.energy = d.energy;
  report.sigma_1 = d.sigma.size() > 0 ? d.sigma[0] : 0.0;
  report.sigma_bound = report.sigma_1 > 0.0 ? d.sigma_bound / report.sigma_1 : 0.0;
  report.rank = d.rank;
  report.modes = d.modes.cols();
  report.rank_is_known =
      d.method != pod::Method::incremental ||
      d.sigma_bound <= pod::round_off(d.modes.rows(), d.temporal.rows(), report.sigma_1);
  report.lost = d.energy > 0.0 ? d.lost_energy / d.energy : 0.0;
  report.counts = count_modes(spectrum);
}

void add_identity(PodReport& report, const pod::Identity& identity,
                  const std::vector<SnapshotColumn>& columns) {
  report.residual = identity.residual;
  report.tail = identity.tail;
  report.difference = identity.difference;
  report.orthonormality = identity.orthonormality;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const double error = relative_error(identity.squared_error[j], identity.snapshot_energy[j]);
    if (error <= report.worst_error && j > 0) continue;
    report.worst_error = error;
    report.worst_time = columns[j].time;
    report.worst_run = report.runs[columns[j].run].directory;
  }
}

/// Sum of the values over the snapshots of each run.
std::vector<double> by_run(const std::vector<double>& values,
                           const std::vector<SnapshotColumn>& columns, std::size_t n_runs) {
  std::vector<double> sums(n_runs, 0.0);
  for (std::size_t j = 0; j < columns.size(); ++j) sums[columns[j].run] += values[j];
  return sums;
}

void add_run_errors(PodReport& report, const pod::Decomposition& d, const pod::Identity& identity,
                    const std::vector<SnapshotColumn>& columns) {
  const std::size_t n = report.runs.size();
  const std::vector<double> energy = by_run(identity.snapshot_energy, columns, n);
  const std::vector<double> error = by_run(identity.squared_error, columns, n);
  for (std::size_t r = 0; r < n; ++r) {
    report.runs[r].energy_share = d.energy > 0.0 ? energy[r] / d.energy : 0.0;
    report.runs[r].error = relative_error(error[r], energy[r]);
  }
  std::size_t k = 0;  // index in identity.fewer_error
  for (const PodCount& count : report.counts) {
    const bool kept = count.modes >= 0 && count.modes <= report.modes;
    const std::vector<double> of_count =
        kept ? by_run(identity.fewer_error[k++], columns, n) : std::vector<double>();
    for (std::size_t r = 0; r < n; ++r)
      report.runs[r].count_errors.push_back(
          kept ? std::optional(relative_error(of_count[r], energy[r])) : std::nullopt);
  }
}

}  // namespace

std::vector<PodRun> describe_runs(const std::vector<io::RunReader>& runs,
                                  const std::vector<SnapshotColumn>& columns) {
  std::vector<PodRun> described;
  for (const io::RunReader& run : runs)
    described.push_back({run.directory(), run.title(), run.status(), 0, 0.0, 0.0, 0.0, 0.0, {}});
  for (const SnapshotColumn& c : columns) {
    PodRun& run = described[c.run];
    if (run.snapshots++ == 0) run.from = c.time;
    run.to = c.time;
  }
  return described;
}

void add_figures(PodReport& report, const PodResult& found) {
  add_energies(report, found.d, found.spectrum);
  add_identity(report, found.identity, found.columns);
  add_run_errors(report, found.d, found.identity, found.columns);
}

std::vector<Index> kept_counts(const pod::Spectrum& spectrum, Index kept) {
  std::vector<Index> modes;
  for (const PodCount& count : count_modes(spectrum))
    if (count.modes >= 0 && count.modes <= kept) modes.push_back(static_cast<Index>(count.modes));
  return modes;
}

std::string trouble_in(const PodReport& r) {
  constexpr double bound = 1e-11;  // some ε of all snapshots; a wrong mode is off by its energy
  // The truncated part may be in the span of the modes: then it is in the tail only.
  const double off = std::max(r.residual - r.tail, r.tail - r.lost - r.residual);
  if (!(off <= bound))
    return fmt::format(
        "the error identity does not hold: {:.3e} of the energy left by the modes, {:.3e} by the "
        "spectrum, bound {:.0e}",
        r.residual, r.tail, bound);
  if (!(r.orthonormality <= bound))
    return fmt::format("the modes are not orthonormal: off by {:.3e}, bound {:.0e}",
                       r.orthonormality, bound);
  return {};
}

double relative_error(double squared_error, double energy) noexcept {
  return energy > 0.0 ? std::sqrt(squared_error / energy) : 0.0;
}

nlohmann::ordered_json as_json(const PodRequest& request, const PodReport& r) {
  nlohmann::ordered_json j;
  j["status"] = r.trouble.empty() ? "done" : "failed";
  if (!r.trouble.empty()) j["message"] = r.trouble;
  describe_program(j);
  j["field"] = request.field;
  j["frame"] = request.frame;
  if (request.frame == "rectified") j["shift"] = request.shift;
  j["weight"] = r.weight;
  j["unit"] = r.unit;
  j["time_unit"] = r.time_unit;
  j["method"] = r.method;
  j["rows"] = r.rows;
  j["snapshots"] = r.snapshots;
  j["energy"] = r.energy;
  j["sigma_1"] = r.sigma_1;
  j["sigma_bound_relative"] = r.sigma_bound;
  j[r.rank_is_known ? "rank" : "rank_at_least"] = r.rank;
  j["modes_kept"] = r.modes;
  for (const PodCount& c : r.counts) {
    auto& value = j["modes_for"][fmt::format("{:.0e}", c.discarded)];
    if (c.modes >= 0) value = c.modes;
  }
  j["worst_snapshot"] = {
      {"error", r.worst_error}, {"time", r.worst_time}, {"run", r.worst_run.string()}};
  j["error_identity"] = {{"residual", r.residual}, {"tail", r.tail}, {"difference", r.difference}};
  j["orthonormality"] = r.orthonormality;
  for (const PodRun& run : r.runs) {
    nlohmann::ordered_json errors;
    for (std::size_t c = 0; c < r.counts.size(); ++c)
      if (auto& error = errors[fmt::format("{:.0e}", r.counts[c].discarded)]; run.count_errors[c])
        error = *run.count_errors[c];
    j["runs"].push_back({{"directory", run.directory.string()},
                         {"title", run.title},
                         {"status", run.status},
                         {"snapshots", run.snapshots},
                         {"from", run.from},
                         {"to", run.to},
                         {"energy_share", run.energy_share},
                         {"error", run.error},
                         {"error_with_modes_for", errors}});
  }
  j["memory_estimate_bytes"] = r.memory_estimate;
  j["peak_memory_bytes"] = r.peak_memory;
  j["wall_s"] = r.wall_s;
  return j;
}

}  // namespace rondo::study
