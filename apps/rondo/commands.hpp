// SPDX-License-Identifier: BSD-3-Clause
/// @file  The program's commands: call the library, print, return an exit code.
#pragma once
#include <string>
#include <vector>

namespace rondo::app {

struct CommonArguments {
  std::string case_file;
  std::vector<std::string> settings;  ///< "a.b=value" of --set
  int threads = 0;                    ///< 0: chosen by size
};

struct RunArguments : CommonArguments {
  std::string directory;  ///< empty: the case's name beside it
  bool overwrite = false;
  bool resume = false;
  bool quiet = false;
  std::string reduced;  ///< model's file; empty: the mesh
  std::string reduced_step = "midpoint";
  bool realtime_factor = false;
  double step_factor = 20.0;  ///< with it
};

int run(const RunArguments& arguments);
int check(const CommonArguments& arguments);

}  // namespace rondo::app
