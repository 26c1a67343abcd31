// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of the paper's study: ours against closed forms, an independent code and what
/// the theory demands (docs/paper.md).
#pragma once
#include <filesystem>
#include <vector>

#include "rondo/study/paper/paper_plan.hpp"
#include "rondo/study/paper/paper_table.hpp"

namespace rondo::study {

/// From the results of all runs and PODs of the plan in `directory`. Numbers of an independent code
/// belong to the full meshes; the quick study has the rows that hold on any mesh.
/// @throws FileError: results that cannot be read
[[nodiscard]] std::vector<PaperRow> check_paper(const std::filesystem::path& directory,
                                                const PaperPlan& plan, bool quick);

/// The rows of figures 3 to 6 alone: from the files, with nothing solved again. @throws FileError
[[nodiscard]] std::vector<PaperRow> check_rolling(const std::filesystem::path& directory,
                                                  const PaperPlan& plan, bool quick);

}  // namespace rondo::study
