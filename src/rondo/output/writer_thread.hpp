// SPDX-License-Identifier: BSD-3-Clause
/// @file  A thread that processes numbered slots in the order in which they were handed over, while
/// its owner continues (docs/decisions/014-writer-thread.md). The owner decides what a slot
/// contains. Only the owner may access a slot between take() and hand_over(), and only the thread
/// from then until its work on the slot has ended.
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

  /// @param work called on the thread, for one slot at a time. An exception ends the thread and is
  /// rethrown at the owner's next call. @pre n_slots > 0. @throws FileError: no thread can be
  /// created.
  WriterThread(std::size_t n_slots, Work work);
  /// Processes what was handed over and joins; an error that was not yet reported is dropped.
  ~WriterThread();
  WriterThread(const WriterThread&) = delete;
  WriterThread& operator=(const WriterThread&) = delete;

  /// A free slot, 0 to n_slots - 1; waits for one. @throws the exception of the work
  [[nodiscard]] std::size_t take();
  /// @pre the slot was taken and has not been handed over since.
  void hand_over(std::size_t slot);
  /// Cheap. @throws the exception of the work
  void check() const;
  /// Processes what was handed over and joins. No slot can be handed over afterwards. @throws the
  /// exception of the work
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
  mutable std::mutex mutex_;  ///< protects all members below except failed_, times_full_, thread_
  std::condition_variable filled_, freed_;
  std::vector<std::size_t> free_;   ///< a stack: the slot freed last is still in the caches
  std::vector<std::size_t> ready_;  ///< ring buffer of n_slots entries
  std::size_t first_ready_ = 0, n_ready_ = 0;
  double busy_s_ = 0.0;
  bool closing_ = false;
  std::exception_ptr error_;
  std::atomic<bool> failed_{false};  ///< error_ is set and does not change any more
  long long times_full_ = 0;         ///< accessed by the owner only
  std::thread thread_;
};

}  // namespace rondo::study
