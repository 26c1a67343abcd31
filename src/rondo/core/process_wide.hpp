// SPDX-License-Identifier: BSD-3-Clause
/// @file  State that libraries have once per process, made safe for calls from several threads.
#pragma once
#include <mutex>

namespace rondo {

/// Keeps OpenBLAS on one thread during its lifetime, so that sums have one order and the same bits
/// on any machine with the same kernels, whatever its number of cores. Sparse factorisations
/// (CHOLMOD) call it too. Of several objects that live at once, in any threads, the last one
/// restores the previous number of threads.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

/// Keeps OpenBLAS on one thread during a call into a library that other code has loaded too. The
/// last of several objects at once restores the number that was set before the first, even if a
/// OneBlasThread still lives: that is made within one such object and ends within this or another.
/// OpenMP, which CHOLMOD also calls, is on one thread as well: its threads do not survive a fork of
/// the process, and a parallel loop would then wait for them forever.
class BorrowedBlas {
 public:
  BorrowedBlas();
  ~BorrowedBlas();
  BorrowedBlas(const BorrowedBlas&) = delete;
  BorrowedBlas& operator=(const BorrowedBlas&) = delete;

 private:
  int levels_;  ///< of OpenMP, to be restored
};

/// From this call on, a process forked from this one works without other threads of OpenMP: it
/// would still count on the threads of its parent, which the child does not have.
void work_alone_in_forks();

/// FFTW makes and destroys plans in one thread at a time: lock this meanwhile. Executing a plan
/// needs no lock.
std::mutex& fftw_planner() noexcept;

}  // namespace rondo
