// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loops over blocks of fixed size: a block's work does not depend on the number of threads,
/// so neither do the bits of the result.
#pragma once
#include <algorithm>
#include <cstddef>

namespace rondo {

inline constexpr std::size_t block_size = 512;

inline std::size_t n_blocks(std::size_t n) noexcept {
  return (n + block_size - 1) / block_size;
}

/// The current thread and the number of threads: of n items it processes [first(n), last(n)).
struct Share {
  std::size_t thread = 0, n_threads = 1;

  [[nodiscard]] std::size_t first(std::size_t n) const noexcept { return n * thread / n_threads; }
  [[nodiscard]] std::size_t last(std::size_t n) const noexcept {
    return n * (thread + 1) / n_threads;
  }
};

/// Calls body(begin, end, block) for each block of [0, n), on `threads` threads.
template <class Body>
void for_blocks(std::size_t n, int threads, Body&& body) {
  const auto blocks = static_cast<std::ptrdiff_t>(n_blocks(n));
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::ptrdiff_t block = 0; block < blocks; ++block) {
    const auto begin = static_cast<std::size_t>(block) * block_size;
    body(begin, std::min(begin + block_size, n), static_cast<std::size_t>(block));
  }
}

}  // namespace rondo
