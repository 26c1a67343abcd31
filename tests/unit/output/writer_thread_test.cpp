// SPDX-License-Identifier: BSD-3-Clause
/// The thread that works off what is handed over: order, a full queue, errors, joining.
#include <gtest/gtest.h>
#include <pthread.h>

#include <array>
#include <atomic>
#include <future>
#include <latch>
#include <new>
#include <numeric>
#include <optional>
#include <semaphore>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/output/writer_thread.hpp"
#include "unit/study/processes.hpp"

namespace writer_thread_test {

using namespace rondo;
using namespace rondo::study;

namespace {

using namespace std::chrono_literals;

/// Fills a slot and hands it over.
void push(WriterThread& writer, std::vector<int>& slots, int value) {
  const std::size_t slot = writer.take();
  slots[slot] = value;
  writer.hand_over(slot);
}

/// What the writer throws while the values 0, 1, ... are pushed, as text; empty if nothing.
template <class Error>
std::string error_in_pushes(WriterThread& writer, std::vector<int>& slots, int n) {
  try {
    for (int i = 0; i < n; ++i) push(writer, slots, i);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST(WriterThread, WorksOffManyInTheirOrderEachOnce) {
  for (const std::size_t n_slots : {1U, 2U, 7U}) {
    constexpr int n = 20000;
    std::vector<int> slots(n_slots), seen;
    WriterThread writer(n_slots, [&](std::size_t slot) { seen.push_back(slots[slot]); });
    for (int i = 0; i < n; ++i) push(writer, slots, i);
    writer.finish();
    std::vector<int> expected(n);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(seen, expected) << n_slots << " slots";
    EXPECT_GT(writer.busy_s(), 0.0);
  }
}

TEST(WriterThread, OwnerAndThreadNeverHoldTheSameSlot) {
  constexpr std::size_t n_slots = 3;
  std::array<std::atomic<bool>, n_slots> held{};
  bool twice = false;
  WriterThread writer(n_slots, [&](std::size_t slot) { held[slot] = false; });
  for (int i = 0; i < 20000; ++i) {
    const std::size_t slot = writer.take();
    ASSERT_LT(slot, n_slots);
    twice = twice || held[slot].exchange(true);
    writer.hand_over(slot);
  }
  writer.finish();
  EXPECT_FALSE(twice);
}

TEST(WriterThread, FullQueueHoldsTheOwnerUntilASlotIsFree) {
  std::counting_semaphore<2> gate(0);
  WriterThread writer(2, [&](std::size_t) { gate.acquire(); });
  const std::size_t first = writer.take(), second = writer.take();
  EXPECT_NE(first, second);
  writer.hand_over(second);
  writer.hand_over(first);
  EXPECT_EQ(writer.times_full(), 0);
  std::future<std::size_t> third = std::async(std::launch::async, [&] { return writer.take(); });
  EXPECT_EQ(third.wait_for(50ms), std::future_status::timeout);
  gate.release();
  EXPECT_EQ(third.get(), second);  // the first that was worked off
  EXPECT_EQ(writer.times_full(), 1);
  gate.release();
}

TEST(WriterThread, ErrorReachesTheOwnerAndNothingMoreIsWorkedOff) {
  std::vector<int> slots(4), seen;
  WriterThread writer(4, [&](std::size_t slot) {
    if (slots[slot] == 10) throw FileError("out/history.csv", "disk full");
    seen.push_back(slots[slot]);
  });
  EXPECT_EQ(error_in_pushes<FileError>(writer, slots, 1'000'000), "out/history.csv: disk full");
  EXPECT_THROW(writer.check(), FileError);
  EXPECT_THROW(static_cast<void>(writer.take()), FileError);
  EXPECT_THROW(writer.finish(), FileError);
  EXPECT_EQ(seen, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(WriterThread, ErrorIsThereWithoutAPush) {
  WriterThread writer(2, [](std::size_t) { throw FileError("a", "b"); });
  EXPECT_NO_THROW(writer.check());
  writer.hand_over(writer.take());
  EXPECT_TRUE(holds_soon([&] {
    try {
      writer.check();
      return false;
    } catch (const FileError&) {
      return true;
    }
  }));
}

TEST(WriterThread, ErrorFreesAnOwnerWhoWaits) {
  std::latch gate(1);
  WriterThread writer(1, [&](std::size_t) {
    gate.wait();
    throw FileError("a", "b");
  });
  writer.hand_over(writer.take());
  std::future<std::size_t> next = std::async(std::launch::async, [&] { return writer.take(); });
  EXPECT_EQ(next.wait_for(50ms), std::future_status::timeout);
  gate.count_down();
  EXPECT_THROW(next.get(), FileError);
}

TEST(WriterThread, ErrorInTheLastSlotIsThrownByFinish) {
  std::vector<int> slots(8);
  WriterThread writer(8, [&](std::size_t slot) {
    if (slots[slot] == 4) throw FileError("a", "b");
  });
  for (int i = 0; i < 4; ++i) push(writer, slots, i);
  EXPECT_TRUE(error_in_pushes<FileError>(writer, slots, 0).empty());
  const std::size_t slot = writer.take();
  slots[slot] = 4;
  writer.hand_over(slot);
  EXPECT_THROW(writer.finish(), FileError);
}

TEST(WriterThread, ErrorsOfAnyTypeComeThroughAsTheyAre) {
  std::vector<int> slots(2);
  WriterThread memory(2, [](std::size_t) { throw std::bad_alloc(); });
  EXPECT_FALSE(error_in_pushes<std::bad_alloc>(memory, slots, 1'000'000).empty());
  WriterThread number(2, [](std::size_t) { throw 7; });
  number.hand_over(number.take());
  try {
    number.finish();
    FAIL();
  } catch (int thrown) {
    EXPECT_EQ(thrown, 7);
  }
}

TEST(WriterThread, DestructorWorksOffWhatIsLeft) {
  std::atomic<int> n = 0;
  {
    std::latch gate(1);
    WriterThread writer(5, [&](std::size_t) {
      gate.wait();
      ++n;
    });
    for (int i = 0; i < 5; ++i) writer.hand_over(writer.take());
    gate.count_down();
  }
  EXPECT_EQ(n, 5);
}

TEST(WriterThread, DestructorJoinsWhileAnErrorIsPending) {
  for (int i = 0; i < 200; ++i) {
    std::atomic<int> n = 0;
    {
      WriterThread writer(3, [&](std::size_t) {
        ++n;
        throw FileError("a", "b");
      });
      for (int k = 0; k < 3 && n == 0; ++k) {
        try {
          writer.hand_over(writer.take());
        } catch (const FileError&) {
          break;
        }
      }
    }
    EXPECT_EQ(n, 1);
  }
}

TEST(WriterThread, EndsWithoutAnyWork) {
  std::optional<WriterThread> writer;
  writer.emplace(1, [](std::size_t) {});
  writer.reset();
  writer.emplace(1, [](std::size_t) {});
  writer->finish();
  writer->finish();
  EXPECT_EQ(writer->busy_s(), 0.0);
}

/// A child process asks for stacks that no machine has.
TEST(WriterThread, NoThreadToBeHadIsSaid) {
  EXPECT_EQ(in_process([] {
              pthread_attr_t large;
              pthread_attr_init(&large);
              pthread_attr_setstacksize(&large, std::size_t{1} << 50);
              if (pthread_setattr_default_np(&large) != 0) return 1;
              try {
                const WriterThread writer(1, [](std::size_t) {});
                return 2;
              } catch (const FileError& error) {
                const std::string what = error.what();
                return what.find("cannot be started") != std::string::npos ? 0 : 3;
              }
            }),
            0);
}

}  // namespace writer_thread_test
