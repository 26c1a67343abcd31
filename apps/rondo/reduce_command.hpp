// SPDX-License-Identifier: BSD-3-Clause
/// @file  rondo reduce: calls the library, prints the figures on stdout, returns an exit code.
#pragma once
#include "rondo/study/reduce.hpp"

namespace rondo::app {

struct ReduceArguments {
  study::ReduceRequest request;
  bool quiet = false;  ///< no progress, only warnings and the figures
};

int reduce(ReduceArguments arguments);

}  // namespace rondo::app
