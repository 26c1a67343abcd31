// SPDX-License-Identifier: BSD-3-Clause
/// The step allocates nothing: every allocation of this program is counted.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "support/models.hpp"

namespace {
std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto align = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

using namespace rondo;

TEST(Allocation, NoneInTheStep) {
  auto b = test::build(test::rolling_disk(6, 90));
  // A valley on top of the ledge: pairs of facets too.
  test::add_ground(
      b, {.profile = {{-10, -0.1}, {0, -0.1}, {0, 0}, {0.1, -0.01}, {10, 0}}, .fillet = 0.02},
      {0.3, 0.0});
  dynamics::State state = test::start_at_rest(b.model);
  dynamics::Ledger ledger;
  long in_contact = 0;
  const long before = allocations;
  for (int n = 0; n < 4000; ++n) in_contact += advance(b.model, state, ledger).nodes;
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(in_contact, 0);
  const long counted = allocations;
  const std::vector<Vec2> something(10);
  EXPECT_EQ(allocations - counted, 1);  // the counter counts
}
