// SPDX-License-Identifier: BSD-3-Clause
/// @file  Static loading: a wheel in three dimensions, standing, is pressed onto flat ground
/// increment by increment (docs/tyre.md, section 6). Path and files are those of a crush in the
/// plane.
#pragma once
#include <memory>

#include "rondo/analysis/base/analysis.hpp"

namespace rondo::study {

/// @pre c is a crush of a wheel in three dimensions. @throws InputError
[[nodiscard]] std::unique_ptr<Analysis> make_wheel_crush(const Case& c, const RunOptions& options);

}  // namespace rondo::study
