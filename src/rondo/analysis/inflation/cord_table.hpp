// SPDX-License-Identifier: BSD-3-Clause
/// @file  cords.csv: the cords of an equilibrium, along their curves.
#pragma once
#include <filesystem>

#include "rondo/analysis/build/tyre/inflated_wheel.hpp"

namespace rondo::study {

/// Two points of each edge of a curve, in its direction. No file where there are no cords.
/// @throws FileError
void write_cords(const std::filesystem::path& directory, const InflatedWheel& wheel,
                 const statics::Inflation& now);

}  // namespace rondo::study
