// SPDX-License-Identifier: BSD-3-Clause
/// @file  The datasets of results.h5 that have the energy taken by friction (docs/wear.md).
#pragma once
#include <vector>

#include "rondo/io/results.hpp"

namespace rondo::study {

/// Plans them; none where the model has no friction_work.
void plan_friction_work(const dynamics::Model& model, io::ResultsLayout& layout);

/// Their values for a snapshot, appended to those of series before them.
void append_friction_work(const dynamics::Model& model, std::vector<double>& series);

}  // namespace rondo::study
