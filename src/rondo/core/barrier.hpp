// SPDX-License-Identifier: BSD-3-Clause
/// @file  A barrier at which threads wait for each other between the steps of a run.
#pragma once
#include <atomic>

namespace rondo {

/// A waiting thread spins for some microseconds, then sleeps: if the cores are busy with other
/// work, the thread it waits for needs its core. (Barriers of OpenMP keep the core for milliseconds
/// unless the user sets OMP_WAIT_POLICY.)
class Barrier {
 public:
  /// Returns when `n_threads` threads have called it. All threads must give the same number.
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
