// SPDX-License-Identifier: BSD-3-Clause
/// @file  What libraries have once for the whole process, for calls from several threads.
#pragma once
#include <mutex>

namespace rondo {

/// OpenBLAS on one thread while it lives, so that its sums have one order: the same bits on any
/// machine with the same kernels, whatever its number of cores. Sparse factorisations (CHOLMOD)
/// call it too. The last of several that live at once, in any threads, gives the number back what
/// it was.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

/// OpenBLAS on one thread during a call into a library that others have loaded: the last of several
/// at once gives back the number that was before the first, also while a OneBlasThread lives on,
/// which must be made and end within one. OpenMP, which CHOLMOD calls too, is on one thread as
/// well: its threads do not survive a fork of the process, and a loop of it would then wait for
/// them.
class BorrowedBlas {
 public:
  BorrowedBlas();
  ~BorrowedBlas();
  BorrowedBlas(const BorrowedBlas&) = delete;
  BorrowedBlas& operator=(const BorrowedBlas&) = delete;

 private:
  int levels_;  ///< of OpenMP, before
};

/// From now on, in a process that is forked from this one, the thread that goes on works without
/// other threads of OpenMP: it still counts on those of its parent, which a child does not have.
void work_alone_in_forks();

/// FFTW makes and destroys plans for one thread at a time: to be held meanwhile. Their transforms
/// are free.
std::mutex& fftw_planner() noexcept;

}  // namespace rondo
