// SPDX-License-Identifier: BSD-3-Clause
/// @file  The tables [[vary]] of a study file.
#pragma once
#include <vector>

#include "rondo/study/sweep/keys/study_reader.hpp"
#include "rondo/study/sweep/sweep_study.hpp"

namespace rondo::study {

/// In the order of the file; those of `keys` one after the other. What is wrong is a fault of `in`.
[[nodiscard]] std::vector<Vary> read_parameters(StudyReader& in);

}  // namespace rondo::study
