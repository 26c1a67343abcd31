// SPDX-License-Identifier: BSD-3-Clause
/// @file  Going on with a run from its checkpoint (--resume).
#pragma once
#include <optional>

#include "rondo/output/checkpoint.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {

/// Version, build and kernels. @throws InputError with all that differs
void demand_same_program(const RunIdentity& then, const RunIdentity& now);

/// Refuses to go on with another run: the case may only differ in time.end, which must lie
/// beyond the steps made unless it is the end of before, in what tables in time say of later times,
/// in output.checkpoint_interval and, with the same mesh, in mesh.file.
/// @throws InputError with all that differs
void demand_same_run(const Checkpoint& checkpoint, const RunIdentity& now, const Case& c,
                     const Setup& setup);

/// @throws InputError: the directory holds the results of a run that keeps no checkpoints
void refuse_without_checkpoints(const std::filesystem::path& directory);

/// What --resume finds: the checkpoint of this run, its schedule up to this case's end; none where
/// the run has not yet come to its first one. @throws InputError, FileError
std::optional<Checkpoint> find_checkpoint(const RunIdentity& now, const Case& c, const Setup& setup,
                                          const std::filesystem::path& directory);

}  // namespace rondo::study
