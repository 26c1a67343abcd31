// SPDX-License-Identifier: BSD-3-Clause
/// @file  A case from its start to its end, into memory: of any analysis.
#pragma once
#include <atomic>
#include <string>
#include <vector>

#include "rondo/analysis/base/analysis.hpp"
#include "rondo/analysis/simulation/memory_recorder.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {

struct Solution {
  RunReport report;
  Json json;  ///< contents of run.json
  mesh::Mesh mesh;
  std::vector<double> mass;          ///< (n) lumped [kg/m], in three dimensions [kg]
  std::vector<int> free_body;        ///< (n) as of /mesh/free_body; empty: no free bodies
  std::vector<ColumnLabel> columns;  ///< labels of the rows
  std::vector<double> rows;          ///< (rows, columns)
  RecordedSnapshots snapshots;
};

/// @param options `directory`, `overwrite` and `resume` mean nothing
/// @throws InputError: the case cannot run, or its snapshots do not fit into memory
[[nodiscard]] Solution solve_case(const Case& c, const RunOptions& options);

}  // namespace rondo::study
