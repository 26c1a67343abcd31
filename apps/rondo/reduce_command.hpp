// SPDX-License-Identifier: BSD-3-Clause
/// @file  rondo reduce: calls the library, prints the figures on stdout, returns an exit code.
#pragma once
#include "rondo/study/paper/validation.hpp"
#include "rondo/study/reduce/reduce.hpp"

namespace rondo::app {

struct ReduceArguments {
  study::ReduceRequest request;         ///< without runs: validates the model that is there
  study::ValidationRequest validation;  ///< without runs: validates nothing
  bool quiet = false;                   ///< no progress, only warnings and the figures
};

int reduce(ReduceArguments arguments);

}  // namespace rondo::app
