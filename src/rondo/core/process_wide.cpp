// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/process_wide.hpp"

#include <cblas.h>
#include <omp.h>
#include <pthread.h>

namespace rondo {
namespace {

struct Living {
  std::mutex mutex;
  int count = 0;
  int before = 1;  ///< number of threads before the first object
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

BorrowedBlas::BorrowedBlas() : levels_(omp_get_max_active_levels()) {
  take_one(borrowed());
  omp_set_max_active_levels(0);
}

BorrowedBlas::~BorrowedBlas() {
  omp_set_max_active_levels(levels_);
  give_back(borrowed());
}

void work_alone_in_forks() {
  static const int registered =
      pthread_atfork(nullptr, nullptr, [] { omp_set_max_active_levels(0); });
  static_cast<void>(registered);
}

std::mutex& fftw_planner() noexcept {
  static std::mutex planner;
  return planner;
}

}  // namespace rondo
