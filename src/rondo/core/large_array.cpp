// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/large_array.hpp"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <new>

namespace rondo {

LargeArray::LargeArray(std::size_t n) : size_(n) {
  constexpr std::size_t cache_line = 64, huge_page = 2U << 20U;
  const std::size_t alignment = n * sizeof(double) >= 2 * huge_page ? huge_page : cache_line;
  const std::size_t bytes = (n * sizeof(double) + alignment - 1) / alignment * alignment;
  if (bytes == 0) return;
  void* memory = std::aligned_alloc(alignment, bytes);
  if (!memory) throw std::bad_alloc();
  if (alignment == huge_page) madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: it may be ignored
  std::memset(memory, 0, bytes);
  data_.reset(static_cast<double*>(memory));
}

void LargeArray::Free::operator()(double* memory) const noexcept {
  std::free(memory);
}

}  // namespace rondo
