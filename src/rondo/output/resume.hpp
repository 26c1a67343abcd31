// SPDX-License-Identifier: BSD-3-Clause
/// @file  Resuming a run from its checkpoint (--resume).
#pragma once
#include <optional>

#include "rondo/output/checkpoint.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {

/// Compares version, build and kernels. @throws InputError with all differences
void demand_same_program(const RunIdentity& then, const RunIdentity& now);

/// Refuses to resume another run. The case may differ only in time.end, which must lie beyond the
/// steps made unless it is the previous end, in values of time tables at later times, in
/// output.checkpoint_interval and, with the same mesh, in mesh.file.
/// @throws InputError with all differences
void demand_same_run(const Checkpoint& checkpoint, const RunIdentity& now, const Case& c,
                     const Setup& setup);

/// @throws InputError: the directory has the results of a run that keeps no checkpoints
void refuse_without_checkpoints(const std::filesystem::path& directory);

/// The checkpoint from which --resume continues, with its schedule extended to this case's end;
/// none if the run has not yet written its first one. @throws InputError, FileError
std::optional<Checkpoint> find_checkpoint(const RunIdentity& now, const Case& c, const Setup& setup,
                                          const std::filesystem::path& directory);

}  // namespace rondo::study
