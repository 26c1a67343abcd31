// SPDX-License-Identifier: BSD-3-Clause
/// Counts what is asked for by new and, linked with --wrap=malloc, by malloc.
#include <atomic>
#include <cstdlib>
#include <new>

#include "support/allocations.hpp"

namespace {
std::atomic<long> counted{0};
}

long rondo::test::allocations() noexcept {
  return counted;
}

extern "C" {
[[gnu::weak]] void* __real_malloc(std::size_t size);  // there with --wrap alone
void* __wrap_malloc(std::size_t size);

void* __wrap_malloc(std::size_t size) {
  ++counted;
  return __real_malloc(size);
}
}

// Not inlined: where the compiler inlines one of a pair only, it takes them for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (!__real_malloc) ++counted;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++counted;
  const auto align = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
