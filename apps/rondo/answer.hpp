// SPDX-License-Identifier: BSD-3-Clause
/// @file  Output of a command besides its log: results for people on stdout, or with --json one
/// document (docs/machine.md), also if it fails.
#pragma once
#include <exception>
#include <string>
#include <string_view>

#include "rondo/case/schema/json_schema.hpp"

namespace rondo::app {

using study::Json;

/// How a command reports its work, and its result.
struct Telling {
  bool quiet = false;  ///< no progress, only warnings and results
  bool json = false;   ///< results go into `result` and are not printed
  Json result;         ///< null: there is none
  std::string end;     ///< reason of an early end that is no error in the log
};

/// Whether "--json" is among the arguments, which may otherwise be invalid.
bool is_json_asked_for(int argc, char** argv);

/// From this call on, warnings and errors are also kept for the document, and a signal that ends
/// the program at once prints one. @param command  "run"
void begin_answer(const std::string& command);

/// Reports the error on stderr and keeps it for the document. Returns the exit code.
int tell_failure(const std::exception& error);

/// Gives a warning with the reason why the command ends early.
void warn_of_end(Telling& tell, const std::string& text);

/// Prints the document. @throws std::system_error: stdout cannot be written
void print_answer(const Telling& tell, int code);

/// The JSON Schema of a command's document. @param result  schema of its result
Json answer_schema(std::string_view command, Json result);

}  // namespace rondo::app
