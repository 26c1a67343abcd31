// SPDX-License-Identifier: BSD-3-Clause
/// @file  rondo modes: calls the library, prints the frequencies on stdout, returns an exit code.
#pragma once
#include <string>
#include <vector>

#include "rondo/analysis/modes/modes.hpp"

namespace rondo::app {

struct ModesArguments {
  std::string case_file;
  std::vector<std::string> settings;  ///< "a.b=value" of --set
  std::string directory;              ///< empty: the case's name and "-modes" beside it
  study::ModesRequest request;
  bool quiet = false;
};

int modes(ModesArguments arguments);

}  // namespace rondo::app
