// SPDX-License-Identifier: BSD-3-Clause
/// @file  The tables [[vary]] of a study file.
#pragma once
#include <vector>

#include "rondo/study/sweep/keys/study_reader.hpp"
#include "rondo/study/sweep/sweep_study.hpp"

namespace rondo::study {

/// The parameters in the order of the file; those of `keys` are adjacent. Adds faults to `in`.
[[nodiscard]] std::vector<Vary> read_parameters(StudyReader& in);

}  // namespace rondo::study
