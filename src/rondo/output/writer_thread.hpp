// SPDX-License-Identifier: BSD-3-Clause
/// @file  A thread that works off numbered slots in the order in which they were handed over, while
/// the thread that owns it goes on (docs/decisions/014-writer-thread.md). What a slot holds is the
/// owner's business: between take() and hand_over() it is the owner's alone, from then until the
/// work on it has ended the thread's alone.
#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace rondo::study {

class WriterThread {
 public:
  using Work = std::function<void(std::size_t slot)>;

  /// @param work called on the thread, for one slot at a time. What it throws ends the thread, and
  /// is thrown on at the owner's next call. @pre n_slots > 0. @throws FileError: no thread to be
  /// had.
  WriterThread(std::size_t n_slots, Work work);
  /// Works off what was handed over, joins; an error that nobody asked for is dropped.
  ~WriterThread();
  WriterThread(const WriterThread&) = delete;
  WriterThread& operator=(const WriterThread&) = delete;

  /// A free slot, 0 to n_slots - 1; waits until there is one. @throws what the work has thrown
  [[nodiscard]] std::size_t take();
  /// @pre the slot was taken and not handed over since.
  void hand_over(std::size_t slot);
  /// Cheap. @throws what the work has thrown
  void check() const;
  /// Works off what was handed over, joins. No slot can be handed over afterwards. @throws what the
  /// work has thrown
  void finish();

  /// Time spent in the work so far [s].
  [[nodiscard]] double busy_s() const;
  /// How often take() found no free slot.
  [[nodiscard]] long long times_full() const noexcept { return times_full_; }

 private:
  void work_off() noexcept;
  std::exception_ptr work_on(std::size_t slot) noexcept;
  void join() noexcept;

  Work work_;
  mutable std::mutex mutex_;  ///< of all below but failed_, times_full_ and thread_
  std::condition_variable filled_, freed_;
  std::vector<std::size_t> free_;  ///< the one freed last is taken first: it is still in the caches
  std::vector<std::size_t> ready_;  ///< ring of n_slots places
  std::size_t first_ready_ = 0, n_ready_ = 0;
  double busy_s_ = 0.0;
  bool closing_ = false;
  std::exception_ptr error_;
  std::atomic<bool> failed_{false};  ///< error_ is set, and stays as it is
  long long times_full_ = 0;         ///< of the owner
  std::thread thread_;
};

}  // namespace rondo::study
