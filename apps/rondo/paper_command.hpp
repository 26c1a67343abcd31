// SPDX-License-Identifier: BSD-3-Clause
/// @file  rondo paper: runs the study, prints the table on stdout, returns an exit code.
#pragma once
#include <string>

namespace rondo::app {

struct PaperArguments {
  std::string directory;  ///< empty: "paper", or "paper-quick"
  bool quick = false;
  bool overwrite = false;
  bool quiet = false;
  int jobs = 0;  ///< at once; 0: as many as there are cores
};

int paper(const PaperArguments& arguments);

}  // namespace rondo::app
