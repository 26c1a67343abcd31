// SPDX-License-Identifier: BSD-3-Clause
/// @file  Arrays for the fields of a run: aligned to cache lines, on huge pages if they are large
/// (fewer TLB misses), initially zero.
#pragma once
#include <cstddef>
#include <memory>
#include <type_traits>

namespace rondo {

/// The memory of a large array.
class LargeMemory {
 public:
  LargeMemory() = default;
  /// Allocates zeroed memory. @throws std::bad_alloc
  explicit LargeMemory(std::size_t bytes);

  [[nodiscard]] void* data() const noexcept { return data_.get(); }

 private:
  struct Free {
    void operator()(void* memory) const noexcept;
  };
  std::unique_ptr<void, Free> data_;
};

template <class T>
class LargeArrayOf {
  static_assert(std::is_arithmetic_v<T>);

 public:
  LargeArrayOf() = default;
  /// Allocates n numbers, all 0. @throws std::bad_alloc
  explicit LargeArrayOf(std::size_t n) : memory_(n * sizeof(T)), size_(n) {}

  [[nodiscard]] T* data() noexcept { return static_cast<T*>(memory_.data()); }
  [[nodiscard]] const T* data() const noexcept { return static_cast<const T*>(memory_.data()); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  LargeMemory memory_;
  std::size_t size_ = 0;
};

using LargeArray = LargeArrayOf<double>;

}  // namespace rondo
