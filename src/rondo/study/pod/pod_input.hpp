// SPDX-License-Identifier: BSD-3-Clause
/// @file  Checks the request of a POD: the words of the command line, the runs, the window.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/pod/decompose.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/pod/pod_snapshots.hpp"

namespace rondo::study {

/// @throws InputError: an unknown word, a weight that does not suit the field.
SnapshotChoice snapshot_choice_of(const PodRequest& request);
pod::Method method_of(const PodRequest& request);
/// Amount in bytes. @throws InputError: not an amount of memory
std::size_t memory_of(const PodRequest& request);

/// The meaning of the word for a frame: true for "co-rotating", false for "rectified", which is the
/// spatial (unrotated) frame. "rotating" and "turning" of earlier versions mean co-rotating and
/// give a warning. @throws InputError: another word
bool is_co_rotating(const std::string& frame, const std::function<void(const std::string&)>& warn);

/// The word of the command line.
const char* name_of(pod::Method method) noexcept;
const char* name_of(Weight weight) noexcept;
const char* unit_of(io::Quantity quantity, const io::RunReader& run) noexcept;
/// Opens the runs and warns of unfinished ones. @throws InputError: no snapshots, no such field, no
/// sectors, different meshes; FileError
std::vector<io::RunReader> open_runs(const PodRequest& request, const SnapshotChoice& choice);

/// Whether a snapshot is in the window. Together with runs in time, all snapshots of a steady state
/// or of a crush are, because their times are those of the pass of a sector, or shares of the load.
bool is_in_window(const std::vector<io::RunReader>& runs, std::size_t run, double time,
                  const std::optional<double>& from, const std::optional<double>& to);

/// The snapshots of all runs in the window, in the order of the runs. @throws InputError: none
std::vector<SnapshotColumn> columns_of(const PodRequest& request, const SnapshotChoice& choice,
                                       const std::vector<io::RunReader>& runs);

/// The request with each sweep replaced by its finished runs. @throws InputError: they have no
/// snapshots; FileError
PodRequest with_members(const PodRequest& asked);

/// The directory of the results, created if missing. @throws InputError: several runs and no
/// directory; FileError: it cannot be created or written to
std::filesystem::path make_directory(const PodRequest& request);

}  // namespace rondo::study
