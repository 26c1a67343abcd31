// SPDX-License-Identifier: BSD-3-Clause
/// @file  Numbers that a process shares with the processes that it forks later.
#pragma once
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <new>

namespace rondo::study {

/// All numbers are 0 at first. @throws std::bad_alloc
template <class Number>
class SharedNumbers {
 public:
  static_assert(std::atomic<Number>::is_always_lock_free, "no lock works across processes here");

  explicit SharedNumbers(std::size_t n)
      : bytes_(std::max<std::size_t>(n, 1) * sizeof(std::atomic<Number>)) {
    void* memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    numbers_ = static_cast<std::atomic<Number>*>(memory);
    std::uninitialized_value_construct_n(numbers_, n);
  }
  ~SharedNumbers() { munmap(numbers_, bytes_); }
  SharedNumbers(const SharedNumbers&) = delete;
  SharedNumbers& operator=(const SharedNumbers&) = delete;

  std::atomic<Number>& operator[](std::size_t k) noexcept { return numbers_[k]; }

 private:
  std::size_t bytes_;
  std::atomic<Number>* numbers_ = nullptr;
};

}  // namespace rondo::study
