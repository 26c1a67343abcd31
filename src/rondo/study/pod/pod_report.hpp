// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a decomposition to the results of a POD, and to its pod.json.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rondo/io/run_reader.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/pod/pod_output.hpp"

namespace rondo::study {

/// One entry for each run: the snapshots that were used.
std::vector<PodRun> describe_runs(const std::vector<io::RunReader>& runs,
                                  const std::vector<SnapshotColumn>& columns);

/// The counts of PodReport::counts that are kept, for which the error identity is also checked.
std::vector<pod::Index> kept_counts(const pod::Spectrum& spectrum, pod::Index kept);

/// @pre report.runs is filled; the identity was checked with kept_counts().
void add_figures(PodReport& report, const PodResult& found);

/// Reasons to doubt the modes: the error identity is violated, or they are not orthonormal. Empty:
/// none.
std::string trouble_in(const PodReport& report);

/// Norm of an error divided by that of the quantity; 0 if that is 0.
double relative_error(double squared_error, double energy) noexcept;

nlohmann::ordered_json as_json(const PodRequest& request, const PodReport& report);

}  // namespace rondo::study
