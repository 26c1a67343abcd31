// SPDX-License-Identifier: BSD-3-Clause
/// @file  A full run against its prediction, both from their results directories.
#pragma once
#include "rondo/analysis/reduced_file.hpp"
#include "rondo/study/paper/validation.hpp"

namespace rondo::study {

/// The window of a run, its last quarter where none is asked for. @throws InputError: no snapshot
/// of the run is in it
struct ValidationWindow {
  double from = 0.0, to = 0.0;  ///< both included [s]
};
[[nodiscard]] ValidationWindow window_of(const ValidationRequest& request,
                                         const std::filesystem::path& run);

/// Fills figures and profiles. @pre both runs are done. @throws InputError: their meshes differ;
/// FileError
void compare(const ReducedFile& model, const ValidationWindow& window, Validated& run);

}  // namespace rondo::study
