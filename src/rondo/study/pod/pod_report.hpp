// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a decomposition to the figures of a POD, and to its pod.json.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rondo/io/run_reader.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/pod/pod_output.hpp"

namespace rondo::study {

/// One entry a run: what of it was taken.
std::vector<PodRun> describe_runs(const std::vector<io::RunReader>& runs,
                                  const std::vector<SnapshotColumn>& columns);

/// Those of PodReport::counts that are kept: what the error identity is to look at besides.
std::vector<pod::Index> kept_counts(const pod::Spectrum& spectrum, pod::Index kept);

/// @pre report.runs are there; the identity was looked at with kept_counts().
void add_figures(PodReport& report, const PodResult& found);

/// What the figures say against the modes: the error identity does not hold, or they are not
/// orthonormal. Empty: nothing.
std::string trouble_in(const PodReport& report);

/// Norm of an error over that of what it is of; 0 where that is 0.
double relative_error(double squared_error, double energy) noexcept;

nlohmann::ordered_json as_json(const PodRequest& request, const PodReport& report);

}  // namespace rondo::study
