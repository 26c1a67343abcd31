// SPDX-License-Identifier: BSD-3-Clause
/// @file  The program's commands: call the library, print, return an exit code.
#pragma once
#include <string>
#include <vector>

#include "rondo/analysis/modes/modes.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/reduce/reduce.hpp"
#include "rondo/study/sweep/sweep.hpp"

namespace rondo::app {

struct CaseArguments {
  std::string case_file;
  std::vector<std::string> settings;  ///< "a.b=value" of --set
};

struct RunArguments : CaseArguments {
  study::RunOptions options;  ///< no directory: the case's name, in the working folder
  bool realtime_factor = false;
};

struct ModesArguments : CaseArguments {
  study::ModesRequest request;  ///< no directory: the case's name and "-modes"
};

struct SweepArguments {
  study::SweepRequest request;  ///< no directory: the study's name
  int jobs = 0;                 ///< runs at once; 0: as many as there are cores
  bool dry_run = false;
};

// `quiet`: no progress, only warnings and the figures.
int run(RunArguments arguments, bool quiet);
/// @param threads 0: chosen by size
int check(const CaseArguments& arguments, int threads);
int pod(study::PodRequest request, bool quiet);
int reduce(study::ReduceRequest request, bool quiet);
int modes(ModesArguments arguments, bool quiet);
int sweep(SweepArguments arguments, bool quiet);

}  // namespace rondo::app
