// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo sweep`: a parametric study.
#pragma once
#include <string>
#include <vector>

namespace rondo::app {

struct SweepArguments {
  std::string study;
  std::string directory;
  std::vector<std::string> settings;
  int jobs = 0;  ///< runs at once; 0: as many as there are cores
  bool dry_run = false, resume = false, overwrite = false, quiet = false;
};

/// Returns the program's exit code.
int sweep(const SweepArguments& arguments);

}  // namespace rondo::app
