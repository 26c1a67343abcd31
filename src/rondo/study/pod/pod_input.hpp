// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a POD was asked for, checked: the command line's words, the runs, the window.
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

/// @throws InputError: a word that is not known, a weight that does not fit the field.
SnapshotChoice choice_of(const PodRequest& request);
pod::Method method_of(const PodRequest& request);
/// Bytes. @throws InputError: not an amount of memory
std::size_t memory_of(const PodRequest& request);

/// Of the word for a frame: true of "co-rotating", false of "rectified", which is the spatial
/// (unrotated) one. "rotating" and "turning" of earlier versions are co-rotating, with a warning.
/// @throws InputError: another word
bool is_co_rotating(const std::string& frame, const std::function<void(const std::string&)>& warn);

/// Words of the command line.
const char* name_of(pod::Method method) noexcept;
const char* name_of(Weight weight) noexcept;
const char* unit_of(io::Quantity quantity, const io::RunReader& run) noexcept;
/// Opens the runs and says which are unfinished. @throws InputError: no snapshots, no such field,
/// no sectors, different meshes; FileError
std::vector<io::RunReader> open_runs(const PodRequest& request, const SnapshotChoice& choice);

/// Whether a snapshot is in the window: beside runs in time, those of a steady state, whose times
/// are those of a sector's pass, all are.
bool is_in_window(const std::vector<io::RunReader>& runs, std::size_t run, double time,
                  const std::optional<double>& from, const std::optional<double>& to);

/// The snapshots of all runs within the window, in the order of the runs. @throws InputError: none
std::vector<SnapshotColumn> columns_of(const PodRequest& request, const SnapshotChoice& choice,
                                       const std::vector<io::RunReader>& runs);

/// The request with each sweep replaced by those of its runs that are done. @throws InputError:
/// they have no snapshots; FileError
PodRequest with_members(const PodRequest& asked);

/// Where the results go, made if it is not there. @throws InputError: several runs and no
/// directory; FileError: cannot be made or written into
std::filesystem::path make_directory(const PodRequest& request);

}  // namespace rondo::study
