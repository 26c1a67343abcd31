// SPDX-License-Identifier: BSD-3-Clause
/// @file  The commands of the program: they call the library, print, and return an exit code.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "answer.hpp"
#include "rondo/study/options/options.hpp"

namespace rondo::app {

struct CaseArguments {
  std::string case_file;
  std::vector<std::string> settings;  ///< "a.b=value" of --set
};

struct RunArguments : CaseArguments {
  study::RunOptions options;  ///< default directory: name of the case, in the working folder
  bool realtime_factor = false;
  std::string axes;  ///< of a further table of forces; empty: none
};

struct ModesArguments : CaseArguments {
  study::ModesRequest request;  ///< default directory: name of the case and "-modes"
};

struct MatricesArguments : CaseArguments {
  study::MatricesRequest request;
};

/// Report of what was written.
struct FmuReport {
  std::filesystem::path file;
  std::string identifier, guid;
  int modes = 0;
  double step = 0.0;                           ///< [s]
  double tyre_mass = 0.0, tyre_inertia = 0.0;  ///< [kg], [kg m2]
  std::uintmax_t bytes = 0;
};

struct SweepArguments {
  study::SweepRequest request;  ///< default directory: name of the study
  int jobs = 0;                 ///< runs at once; 0: number of cores
  bool dry_run = false;
  std::string shard;  ///< "i/n": the part to run; empty: all of it
  bool collect = false;
  std::string axes;  ///< of a further table of forces; empty: none
};

int run(RunArguments arguments, Telling& tell);
/// @param threads 0: chosen by size
int check(const RunArguments& arguments, Telling& tell);
int pod(study::PodRequest request, Telling& tell);
int reduce(study::ReduceRequest request, Telling& tell);
int fmu(const study::FmuRequest& request, Telling& tell);
int modes(ModesArguments arguments, Telling& tell);
int matrices(MatricesArguments arguments, Telling& tell);
int sweep(SweepArguments arguments, Telling& tell);
/// Prints a JSON Schema. @param of  "case", "study", or a command with --json
int schema(const std::string& of);

}  // namespace rondo::app
