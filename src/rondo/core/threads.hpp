// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loops over blocks of fixed size. A block's work and the order in which blocks are summed
/// do not depend on the number of threads, so neither do the bits of the result.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "rondo/core/sum.hpp"

namespace rondo {

inline constexpr std::size_t block_size = 512;

inline std::size_t n_blocks(std::size_t n) noexcept {
  return (n + block_size - 1) / block_size;
}

/// body(begin, end, block) for each block of [0, n), on `threads` threads.
template <class Body>
void for_blocks(std::size_t n, int threads, Body&& body) {
  const auto blocks = static_cast<std::ptrdiff_t>(n_blocks(n));
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::ptrdiff_t block = 0; block < blocks; ++block) {
    const auto begin = static_cast<std::size_t>(block) * block_size;
    body(begin, std::min(begin + block_size, n), static_cast<std::size_t>(block));
  }
}

/// Sums of K terms over [0, n): one partial sum a block, then added in the order of blocks.
/// Sized once; summing allocates nothing.
template <std::size_t K>
class BlockSums {
 public:
  using Terms = std::array<double, K>;
  explicit BlockSums(std::size_t n) : n_(n), partial_(n_blocks(n)) {}

  /// term(i) returns the K terms of item i.
  template <class Term>
  Terms sum(int threads, Term&& term) {
    for_blocks(n_, threads, [&](std::size_t begin, std::size_t end, std::size_t block) {
      Terms local{};
      for (std::size_t i = begin; i < end; ++i) {
        const Terms t = term(i);
        for (std::size_t k = 0; k < K; ++k) local[k] += t[k];
      }
      partial_[block] = local;
    });
    std::array<CompensatedSum, K> total{};
    for (const Terms& p : partial_)
      for (std::size_t k = 0; k < K; ++k) total[k].add(p[k]);
    Terms out{};
    for (std::size_t k = 0; k < K; ++k) out[k] = total[k].value();
    return out;
  }

 private:
  std::size_t n_;
  std::vector<Terms> partial_;
};

}  // namespace rondo
