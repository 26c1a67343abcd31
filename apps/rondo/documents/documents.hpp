// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the commands with --json put under "result", and the schemas of that
/// (docs/machine.md). A schema is that of the very rows that the document is made from.
#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "rondo/analysis/matrices/matrices.hpp"
#include "rondo/analysis/modes/modes.hpp"
#include "rondo/analysis/registry.hpp"
#include "rondo/case/schema/members.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/reduce/reduce.hpp"
#include "rondo/study/sweep/sweep.hpp"

namespace rondo::app {

using study::Json;
using study::JsonMember;

struct FmuReport;

Json check_document(const study::Case& c, const study::CheckReport& report);
Json check_schema();

/// With run.json as it is in the directory; null where it cannot be read.
Json run_document(const study::RunReport& report, const std::filesystem::path& directory);
Json run_schema();

Json pod_document(const study::PodRequest& request, const study::PodReport& report);
Json pod_schema();

Json reduce_document(const study::ReduceRequest& request, const study::ReduceReport& report);
Json reduce_schema();

Json fmu_document(const FmuReport& report);
Json fmu_schema();

Json modes_document(const study::ModesReport& report);
Json modes_schema();

Json matrices_document(const study::MatricesReport& report);
Json matrices_schema();

/// @param unfinished numbers of the shards that are not, of --collect
Json sweep_document(const study::SweepReport& report, const std::filesystem::path& directory,
                    const std::vector<std::size_t>& unfinished = {});
/// Document of --dry-run, which runs nothing. @param workers runs at once
Json plan_document(const study::DrySweep& dry, int workers);
Json sweep_schema();

}  // namespace rondo::app
