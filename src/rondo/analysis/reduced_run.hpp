// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo run --reduced`: a case on the modes of a reduced model instead of its mesh. The
/// loop, the files and the figures are those of any run (docs/reduced.md, 7).
#pragma once
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rondo/analysis/build.hpp"
#include "rondo/analysis/reduced_file.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/rom/integrator.hpp"

namespace rondo::study {

/// Names of the command line.
inline constexpr std::array<std::pair<const char*, rom::StepScheme>, 2> step_names{
    {{"midpoint", rom::StepScheme::midpoint}, {"explicit", rom::StepScheme::central}}};

struct ReducedRun {
  ReducedFile file;
  rom::StepScheme scheme = rom::StepScheme::midpoint;
  double step_factor = 1.0;           ///< taken
  double full_step = 0.0;             ///< of the full run [s]
  std::vector<std::string> warnings;  ///< for the user
  rom::StepFigures figures;           ///< filled while it runs
};

/// Reads the model, checks that it is one of this case, gives the setup its step.
/// @throws InputError: no such file, another body, what a reduced run cannot do; FileError
[[nodiscard]] ReducedRun prepare_reduced(const Case& c, const RunOptions& options, Setup& setup);

/// Run and setup must outlive it.
[[nodiscard]] std::unique_ptr<dynamics::Integrator> make_integrator(ReducedRun& run,
                                                                    const Setup& setup,
                                                                    const dynamics::State& start);

/// @throws InputError: the directory holds a reduced run, which nothing goes on with
void refuse_reduced(const std::filesystem::path& directory);

/// For run.json, before and after the run.
void describe_reduced(const ReducedRun& run, const RunOptions& options, Json& json);
/// @param time simulated [s]
void add_figures(const ReducedRun& run, double time, Json& json);

}  // namespace rondo::study
