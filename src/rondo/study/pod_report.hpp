// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a decomposition to the figures of a POD, and to its pod.json.
#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "rondo/io/run_reader.hpp"
#include "rondo/study/pod.hpp"
#include "rondo/study/pod_output.hpp"

namespace rondo::study {

/// One entry a run: what of it was taken.
std::vector<PodRun> describe_runs(const std::vector<io::RunReader>& runs,
                                  const std::vector<Column>& columns);

/// @pre report.runs are there.
void add_figures(PodReport& report, const PodResult& found);

/// Norm of an error over that of what it is of; 0 where that is 0.
double relative_error(double squared_error, double energy) noexcept;

nlohmann::ordered_json as_json(const PodRequest& request, const PodReport& report);

}  // namespace rondo::study
