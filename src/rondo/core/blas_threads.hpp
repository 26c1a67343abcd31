// SPDX-License-Identifier: BSD-3-Clause
/// @file  OpenBLAS on one thread, so that its sums have one order: the same bits on any machine
/// with the same kernels, whatever its number of cores. Sparse factorisations (CHOLMOD) call it
/// too.
#pragma once

namespace rondo {

/// While it lives. Not for two threads at once: the number is OpenBLAS's own, for the process.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  int before_;
};

}  // namespace rondo
