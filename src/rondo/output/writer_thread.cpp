// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/writer_thread.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"

namespace rondo::study {

WriterThread::WriterThread(std::size_t n_slots, Work work)
    : work_(std::move(work)), ready_(n_slots) {
  RONDO_DEMAND(n_slots > 0 && work_, n_slots);
  free_.reserve(n_slots);
  for (std::size_t slot = n_slots; slot > 0; --slot) free_.push_back(slot - 1);
  try {
    thread_ = std::thread([this] { work_off(); });
  } catch (const std::system_error& error) {
    throw FileError("the thread that writes the results", std::string("cannot be started: ") +
                                                              error.code().message() +
                                                              "; allow more processes (ulimit -u)");
  }
}

WriterThread::~WriterThread() {
  join();
}

std::size_t WriterThread::take() {
  std::unique_lock lock(mutex_);
  if (free_.empty()) {
    ++times_full_;
    freed_.wait(lock, [this] { return !free_.empty(); });  // also after an error
  }
  if (error_) std::rethrow_exception(error_);
  const std::size_t slot = free_.back();
  free_.pop_back();
  return slot;
}

void WriterThread::hand_over(std::size_t slot) {
  {
    const std::lock_guard lock(mutex_);
    RONDO_DEMAND(n_ready_ < ready_.size() && !closing_, n_ready_, closing_);
    RONDO_DEMAND(slot < ready_.size(), slot, ready_.size());
    RONDO_ASSERT(std::ranges::find(free_, slot) == free_.end(), slot);  // it was taken
    ready_[(first_ready_ + n_ready_) % ready_.size()] = slot;
    ++n_ready_;
  }
  filled_.notify_one();
}

void WriterThread::check() const {
  if (failed_.load(std::memory_order_acquire)) std::rethrow_exception(error_);
}

void WriterThread::finish() {
  join();
  check();
}

void WriterThread::join() noexcept {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  filled_.notify_one();
  if (thread_.joinable()) thread_.join();
}

double WriterThread::busy_s() const {
  const std::lock_guard lock(mutex_);
  return busy_s_;
}

// On the writing thread -----------------------------------------------------------------------

std::exception_ptr WriterThread::work_on(std::size_t slot) noexcept {
  try {
    work_(slot);
    return nullptr;
  } catch (...) {
    return std::current_exception();
  }
}

void WriterThread::work_off() noexcept {
  using Clock = std::chrono::steady_clock;
  std::unique_lock lock(mutex_);
  while (!error_) {
    filled_.wait(lock, [this] { return n_ready_ > 0 || closing_; });
    if (n_ready_ == 0) return;
    const std::size_t slot = ready_[first_ready_];
    first_ready_ = (first_ready_ + 1) % ready_.size();
    --n_ready_;
    lock.unlock();
    const auto begin = Clock::now();
    std::exception_ptr error = work_on(slot);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    lock.lock();
    busy_s_ += seconds;
    free_.push_back(slot);
    error_ = std::move(error);
    failed_.store(error_ != nullptr, std::memory_order_release);
    freed_.notify_one();
  }
}

}  // namespace rondo::study
