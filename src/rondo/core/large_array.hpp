// SPDX-License-Identifier: BSD-3-Clause
/// @file  Arrays for the fields of a run: aligned to cache lines, on huge pages where they are
/// large (fewer misses of the table of pages), zero at first.
#pragma once
#include <cstddef>
#include <memory>
#include <span>

namespace rondo {

class LargeArray {
 public:
  LargeArray() = default;
  /// n doubles, all 0. @throws std::bad_alloc
  explicit LargeArray(std::size_t n);

  [[nodiscard]] double* data() noexcept { return data_.get(); }
  [[nodiscard]] const double* data() const noexcept { return data_.get(); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  struct Free {
    void operator()(double* memory) const noexcept;
  };
  std::unique_ptr<double[], Free> data_;
  std::size_t size_ = 0;
};

}  // namespace rondo
