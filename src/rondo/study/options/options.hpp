// SPDX-License-Identifier: BSD-3-Clause
/// @file  The options of the commands: one table, from which come the command line with its help,
/// the keyword arguments of the Python package with their checks, and python/rondo/options.py.
///
/// A row says where its value goes: what a request holds before it is filled is the default.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rondo/analysis/modes/modes.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/reduce/reduce.hpp"
#include "rondo/study/sweep/sweep.hpp"

namespace rondo::study {

/// A bool is a flag, which turns it from its default to the other value.
using OptionTarget =
    std::variant<bool*, int*, double*, std::string*, std::filesystem::path*, std::optional<double>*,
                 std::optional<long long>*, std::vector<double>*>;

/// Both ends are allowed.
struct OptionRange {
  int low = 0, high = 0;
};

/// Another option of the same command that is needed, or excluded.
struct OtherOption {
  std::string_view words, python;     ///< its names
  std::string_view message, allowed;  ///< what Python is told where this is not so
};

struct Option {
  std::string_view words;   ///< on the command line: "--threads,--jobs"
  std::string_view python;  ///< name of the keyword argument in Python; empty: Python has none
  OptionTarget target;
  std::string_view help;            ///< a sentence or a noun phrase, without a point at its end
  std::string_view unit = {};       ///< "rad/s"; empty: none
  std::string_view choices = {};    ///< "a | b": the words that there are; the command checks them
  std::string_view in_python = {};  ///< help in Python, where it is not that of the command line
  std::optional<OptionRange> range = {};
  std::optional<OtherOption> needs = {}, excludes = {};
};

using Options = std::vector<Option>;

/// What `rondo fmu` is asked for.
struct FmuRequest {
  std::filesystem::path model, output;
  std::filesystem::path case_file;    ///< empty: that of the first run behind the model
  std::vector<std::string> settings;  ///< "a.b=value" of --set
  double step_factor = 20.0;
};

// The requests must outlive what is returned.
Options run_options(RunOptions& request);
Options modes_options(ModesRequest& request);
Options pod_options(PodRequest& request);
Options reduce_options(ReduceRequest& request);
Options sweep_options(SweepRequest& request);
Options fmu_options(FmuRequest& request);
/// 0: chosen by size.
Option threads_option(int& threads);

/// The help with unit and choices: "Time of the first snapshot that is taken [s]".
std::string help_text(const Option& option, std::string_view help);
/// The default as text; empty: what holds is said by the help.
std::string default_text(const Option& option);
/// Whether the request differs from what it is without the option.
bool is_given(const Option& option);

/// python/rondo/options.py: of each command, each argument with its type and its help.
std::string python_options();

}  // namespace rondo::study
