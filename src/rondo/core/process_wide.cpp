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

void take_one(Living& all) {
  const std::lock_guard lock(all.mutex);
  if (all.count++ > 0) return;
  all.before = openblas_get_num_threads();
  openblas_set_num_threads(1);
}

void give_back(Living& all) {
  const std::lock_guard lock(all.mutex);
  if (--all.count == 0) openblas_set_num_threads(all.before);
}

}  // namespace

OneBlasThread::OneBlasThread() {
  take_one(living());
}

OneBlasThread::~OneBlasThread() {
  give_back(living());
}

BorrowedBlas::BorrowedBlas() {
  take_one(borrowed());
}

BorrowedBlas::~BorrowedBlas() {
  give_back(borrowed());
}

std::mutex& fftw_planner() noexcept {
  static std::mutex planner;
  return planner;
}

}  // namespace rondo
