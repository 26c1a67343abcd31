// SPDX-License-Identifier: BSD-3-Clause
/// @file  A case and a reduced model put together: what a reduced run needs, checked.
#pragma once
#include <string>
#include <vector>

#include "rondo/analysis/reduced/reduced_file.hpp"
#include "rondo/case/setup.hpp"
#include "rondo/output/run_options.hpp"
#include "rondo/rom/integrator.hpp"

namespace rondo::study {

struct ReducedRun {
  ReducedFile file;
  rom::StepScheme scheme = rom::StepScheme::midpoint;
  bool lifts = true;                  ///< snapshots are fields
  double step_factor = 1.0;           ///< taken
  double full_step = 0.0;             ///< step of the full run [s]
  std::vector<std::string> warnings;  ///< for the user
  bool constant_spin = true;          ///< by its case
  rom::StepFigures figures;           ///< filled while it runs
};

/// Reads the model, checks that it is one of this case, gives the setup its step.
/// @param options its model and what belongs to it. @throws InputError, FileError
ReducedRun prepare_reduced(const Case& c, const RunOptions& options, Setup& setup);

/// Elsewhere the law of contact sees gaps besides, and w_n is not the mean velocity that does the
/// work.
bool sees_velocities_alone(const ReducedRun& run);

/// Contact points, of the mean spacing, that a turn of the disk [rad] passes.
double points_passed(const Setup& setup, double turned, const ReducedRun& run);

/// A contact point must not be passed in one step, in words. @param spin [rad/s]. Empty: it is not.
std::string passed_points(const Case& c, const Setup& setup, double spin, const ReducedRun& run);

/// Adds the warning, unless it is empty.
void add_said(std::string warning, std::vector<std::string>& warnings);

}  // namespace rondo::study
