// SPDX-License-Identifier: BSD-3-Clause
/// @file  Faults of the user and of the machine are typed exceptions, caught in apps/ only.
/// Outcomes of numerical methods are never exceptions but reports that the caller reads.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace rondo {

/// Exit codes of the program and of its work in other processes.
enum ExitCode : int {
  exit_done = 0,
  exit_input = 2,      ///< wrong input or usage
  exit_numerical = 3,  ///< not finite, ledger or contact residual out of bound; a bug, a signal
  exit_files = 4,      ///< cannot write, disk full, damaged; memory ran out
  exit_interrupted = 130,
};

/// One fault in the user's input.
struct Fault {
  std::string file;     ///< case file, or "--set"; empty: not tied to a file
  int line = 0;         ///< from 1; 0: unknown
  int column = 0;       ///< from 1; 0: unknown
  std::string key;      ///< dotted key, e.g. "disk.inner_radius"; may be empty
  std::string found;    ///< the value found, as written; may be empty
  std::string message;  ///< what is wrong
  std::string allowed;  ///< what is allowed, or what to do; may be empty

  /// "case.toml:12:3: disk.inner_radius = 0.4: must be ... (allowed: ...)"
  [[nodiscard]] std::string text() const;
};

/// Wrong input or usage (exit code 2): all faults found, never only the first.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults);
  explicit InputError(Fault fault);
  [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// A fault of the command line: the option, its value, what is wrong, what is allowed.
InputError request_error(const std::string& option, const std::string& found,
                         const std::string& message, const std::string& allowed);

/// A file that cannot be written or read, or is damaged (exit code 4).
class FileError : public std::runtime_error {
 public:
  FileError(const std::string& path, const std::string& what)
      : std::runtime_error(path + ": " + what) {}
  /// The given error with a further text: what remains, or what the user can do.
  FileError(const FileError& error, const std::string& more)
      : std::runtime_error(std::string(error.what()) + "; " + more) {}
};

}  // namespace rondo
