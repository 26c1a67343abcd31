// SPDX-License-Identifier: BSD-3-Clause
/// @file  rondo reduce: calls the library, prints the figures on stdout, returns an exit code.
#pragma once
#include "rondo/study/reduce/reduce.hpp"

namespace rondo::app {

/// @param quiet no progress, only warnings and the figures
int reduce(study::ReduceRequest request, bool quiet);

}  // namespace rondo::app
