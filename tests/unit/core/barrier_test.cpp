// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/barrier.hpp"

#include <gtest/gtest.h>

#include <array>
#include <thread>
#include <vector>

namespace barrier_test {

using namespace rondo;

/// What each wrote before the barrier all read after it, over and over, with more threads than
/// cores and with one that is late.
TEST(Barrier, AllSeeWhatAllDidBefore) {
  for (const unsigned n : {1U, 2U, 7U}) {
    Barrier barrier;
    std::array<std::array<int, 7>, 2> written{};
    std::vector<int> wrong(n, 0);
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < n; ++t)
      threads.emplace_back([&, t] {
        for (int round = 0; round < 300; ++round) {
          if (t == 0 && round % 100 == 7) std::this_thread::sleep_for(std::chrono::milliseconds(3));
          auto& now = written[static_cast<std::size_t>(round % 2)];
          now[t] = round;
          barrier.wait(n);
          for (unsigned other = 0; other < n; ++other) wrong[t] += now[other] == round ? 0 : 1;
        }
      });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(n, 0)) << n;
  }
}

}  // namespace barrier_test
