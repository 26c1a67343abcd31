// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/process_wide.hpp"

#include <cblas.h>

namespace rondo {
namespace {

struct Living {
  std::mutex mutex;
  int count = 0;
  int before = 1;  ///< threads, when there was none
};

Living& living() {
  static Living all;
  return all;
}

Living& borrowed() {
  static Living all;
  return all;
}

}  // namespace

OneBlasThread::OneBlasThread() {
  Living& all = living();
  const std::lock_guard lock(all.mutex);
  if (all.count++ > 0) return;
  all.before = openblas_get_num_threads();
  openblas_set_num_threads(1);
}

OneBlasThread::~OneBlasThread() {
  Living& all = living();
  const std::lock_guard lock(all.mutex);
  if (--all.count == 0) openblas_set_num_threads(all.before);
}

BorrowedBlas::BorrowedBlas() {
  Living& all = borrowed();
  const std::lock_guard lock(all.mutex);
  if (all.count++ > 0) return;
  all.before = openblas_get_num_threads();
  openblas_set_num_threads(1);
}

BorrowedBlas::~BorrowedBlas() {
  Living& all = borrowed();
  const std::lock_guard lock(all.mutex);
  if (--all.count == 0) openblas_set_num_threads(all.before);
}

std::mutex& fftw_planner() noexcept {
  static std::mutex planner;
  return planner;
}

}  // namespace rondo
