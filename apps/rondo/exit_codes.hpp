// SPDX-License-Identifier: BSD-3-Clause
/// @file  Exit codes of the program.
#pragma once

namespace rondo::app {

enum ExitCode : int {
  exit_done = 0,
  exit_input = 2,      ///< wrong input or usage
  exit_numerical = 3,  ///< not finite, ledger or contact residual out of bound
  exit_files = 4,      ///< cannot write, disk full, damaged
  exit_interrupted = 130,
};

}  // namespace rondo::app
