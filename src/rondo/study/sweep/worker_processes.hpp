// SPDX-License-Identifier: BSD-3-Clause
/// @file  Workers at once, each in a process of its own: the HDF5 library is not safe for threads,
/// the number of BLAS's threads is a setting of the process, and a worker that is killed takes no
/// other with it.
#pragma once
#include <atomic>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "rondo/core/error.hpp"

namespace rondo::study {

struct WorkerOutcome {
  int code = exit_done;
  std::string text;  ///< what the work returned, of any length; of a failure, why
};

/// Of work that an exception ended.
[[nodiscard]] WorkerOutcome failed_by(const std::exception& error);

/// Runs in the child. Files it opens, HDF5's above all, are to be closed when it returns. `stop` is
/// set by SIGINT, SIGTERM and SIGHUP: the work is to return soon.
using WorkerTask = std::function<std::string(int worker, const std::atomic<bool>& stop)>;

/// Forks `workers` processes and returns one outcome each once all have ended.
///
/// Before the call this process must not have run a parallel loop of OpenMP nor have other threads
/// at work: their pools and locks do not survive a fork. Children stay in the process group, so
/// that a Ctrl-C reaches them all: the caller catches it and sets `stop`, upon which they are told.
/// They die with the thread that called.
///
/// @param stop may be null @param watch called here about ten times a second and at the end; may be
/// empty
/// @throws FileError: a process cannot be started; what `watch` throws. Those that run are told to
/// stop and have ended by then.
[[nodiscard]] std::vector<WorkerOutcome> run_workers(int workers, const WorkerTask& task,
                                                     const std::atomic<bool>* stop,
                                                     const std::function<void()>& watch);

}  // namespace rondo::study
