// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where threads wait for each other between the steps of a run.
#pragma once
#include <atomic>

namespace rondo {

/// Looks for some microseconds, then sleeps: on a machine whose cores are busy with other work the
/// thread that is waited for needs the core of the one that waits. (Barriers of OpenMP keep it for
/// milliseconds, if the user does not set OMP_WAIT_POLICY.)
class Barrier {
 public:
  /// Comes back when `n_threads` threads have called it. The same number in every thread.
  void wait(unsigned n_threads) noexcept {
    const unsigned phase = phase_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == n_threads) {
      arrived_.store(0, std::memory_order_relaxed);
      phase_.store(phase + 1, std::memory_order_release);
      phase_.notify_all();
      return;
    }
    constexpr int looks = 2000;
    for (int i = 0; i < looks; ++i) {
      if (phase_.load(std::memory_order_acquire) != phase) return;
      pause();
    }
    phase_.wait(phase, std::memory_order_acquire);
  }

 private:
  static void pause() noexcept {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }

  std::atomic<unsigned> arrived_{0};
  std::atomic<unsigned> phase_{0};
};

}  // namespace rondo
