// SPDX-License-Identifier: BSD-3-Clause
/// @file  Parallel workers, each in its own process: the HDF5 library is not thread-safe, the
/// number of BLAS threads is a setting of the process, and a worker that is killed does not affect
/// the others.
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
  std::string text;  ///< result of the work, of any length; for a failure, the reason
};

/// The outcome of work that ended with an exception.
[[nodiscard]] WorkerOutcome failed_by(const std::exception& error);

/// Runs in the child. It must close its files, especially those of HDF5, before it returns. `stop`
/// is set by SIGINT, SIGTERM and SIGHUP: the work must then return soon.
using WorkerTask = std::function<std::string(int worker, const std::atomic<bool>& stop)>;

/// Forks `workers` processes and returns the outcome of each when all have ended.
///
/// Before the call this process must not have run a parallel loop of OpenMP or have other active
/// threads, because their pools and locks do not survive a fork. Children stay in the process
/// group, so that a Ctrl-C reaches them all; the caller catches it and sets `stop`, which is passed
/// on to them. They die with the calling thread.
///
/// @param stop may be null @param watch called here about ten times a second and at the end; may be
/// empty
/// @throws FileError: a process cannot be started; exceptions of `watch`. Running children are then
/// told to stop and have ended.
[[nodiscard]] std::vector<WorkerOutcome> run_workers(int workers, const WorkerTask& task,
                                                     const std::atomic<bool>* stop,
                                                     const std::function<void()>& watch);

}  // namespace rondo::study
