// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a command says besides its log: figures for people on stdout, or with --json one
/// document (docs/machine.md), also where it fails.
#pragma once
#include <exception>
#include <string>
#include <string_view>

#include "rondo/case/schema/json_schema.hpp"

namespace rondo::app {

using study::Json;

/// How a command is to tell what it does, and what it has found.
struct Telling {
  bool quiet = false;  ///< no progress, only warnings and figures
  bool json = false;   ///< figures go into `result` and are not printed
  Json result;         ///< null: there is none
  std::string end;     ///< why it ended before, where that is no error in the log
};

/// "--json" stands among the arguments, which may be wrong otherwise.
bool is_json_asked_for(int argc, char** argv);

/// From now on warnings and errors are kept for the document as well, and a signal that ends the
/// program at once prints one. @param command  "run"
void begin_answer(const std::string& command);

/// Says on stderr what went wrong, and keeps it for the document. Returns the exit code.
int tell_failure(const std::exception& error);

/// A warning that says why the command ends before its end.
void warn_of_end(Telling& tell, const std::string& text);

/// Prints the document. @throws std::system_error: stdout cannot be written
void print_answer(const Telling& tell, int code);

/// A document of the command as a JSON Schema. @param result  schema of what it has found
Json answer_schema(std::string_view command, Json result);

}  // namespace rondo::app
