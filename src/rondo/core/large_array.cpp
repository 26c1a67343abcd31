// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/large_array.hpp"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <new>

namespace rondo {

LargeMemory::LargeMemory(std::size_t bytes) {
  constexpr std::size_t cache_line = 64, huge_page = 2U << 20U;
  const std::size_t alignment = bytes >= 2 * huge_page ? huge_page : cache_line;
  const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
  if (whole == 0) return;
  void* memory = std::aligned_alloc(alignment, whole);
  if (!memory) throw std::bad_alloc();
  if (alignment == huge_page) madvise(memory, whole, MADV_HUGEPAGE);  // a hint: may be ignored
  std::memset(memory, 0, whole);
  data_.reset(memory);
}

void LargeMemory::Free::operator()(void* memory) const noexcept {
  std::free(memory);
}

}  // namespace rondo
