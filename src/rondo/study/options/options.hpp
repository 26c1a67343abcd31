// SPDX-License-Identifier: BSD-3-Clause
/// @file  The options of the commands as one table. From it come the command line with its help,
/// the keyword arguments of the Python package with their checks, and python/rondo/options.py.
///
/// A row says where its value is stored; the value in a request before it is filled is the default.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rondo/analysis/matrices/matrices.hpp"
#include "rondo/analysis/modes/modes.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/reduce/reduce.hpp"
#include "rondo/study/sweep/sweep.hpp"

namespace rondo::study {

/// A bool is a flag, which changes it from its default to the other value.
using OptionTarget =
    std::variant<bool*, int*, double*, std::string*, std::filesystem::path*, std::optional<double>*,
                 std::optional<long long>*, std::vector<double>*>;

/// Both ends are included.
struct OptionRange {
  int low = 0, high = 0;
};

/// Another option of the same command that is required or excluded.
struct OtherOption {
  std::string_view words, python;     ///< its names
  std::string_view message, allowed;  ///< text for Python if this is violated
};

struct Option {
  std::string_view words;   ///< on the command line: "--threads,--jobs"
  std::string_view python;  ///< name of the keyword argument in Python; empty: Python has none
  OptionTarget target;
  std::string_view help;            ///< a sentence or a noun phrase, without a full stop
  std::string_view unit = {};       ///< "rad/s"; empty: none
  std::string_view choices = {};    ///< "a | b": the words allowed; the command checks them
  std::string_view in_python = {};  ///< help in Python, if it differs
  std::optional<OptionRange> range = {};
  std::optional<OtherOption> needs = {}, excludes = {};
  std::string_view alone = {};  ///< value of the option without one; empty: it needs one
};

using Options = std::vector<Option>;

/// The options of `rondo fmu`.
struct FmuRequest {
  std::filesystem::path case_file, output;
  std::vector<std::string> settings;  ///< "a.b=value" of --set
  std::optional<long long> modes;     ///< none: chosen
  std::optional<double> step;         ///< largest internal step [s]; none: chosen
};

// The requests must outlive the result.
Options run_options(RunOptions& request);
Options modes_options(ModesRequest& request);
Options pod_options(PodRequest& request);
Options reduce_options(ReduceRequest& request);
Options sweep_options(SweepRequest& request);
Options fmu_options(FmuRequest& request);
Options matrices_options(MatricesRequest& request);
/// 0: chosen by size.
Option threads_option(int& threads);

/// The help with unit and choices: "Time of the first snapshot used [s]".
std::string help_text(const Option& option, std::string_view help);
/// The default as text; empty: the help explains it.
std::string default_text(const Option& option);
/// Whether the request differs from its default.
bool is_given(const Option& option);

/// python/rondo/options.py: for each command, each argument with its type and its help.
std::string python_options();

}  // namespace rondo::study
