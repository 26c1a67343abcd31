// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loaded before the C library (LD_PRELOAD): the time of day jumps by days, back and forth,
/// at each call. Only steady clocks are unchanged.
#include <dlfcn.h>
#include <sys/time.h>
#include <sys/types.h>

#include <atomic>
#include <ctime>

namespace {

/// The next offset of the clock in days: 0, 3, -3, 6, -6, ... 30, -30, and again.
std::time_t jump() {
  static std::atomic<int> calls{0};
  const int n = calls.fetch_add(1) % 21;
  return (n % 2 == 0 ? -1 : 1) * std::time_t{3 * 86400} * ((n + 1) / 2);
}

bool of_the_day(clockid_t clock) {
  return clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE || clock == CLOCK_TAI;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  static const auto original = next<int (*)(clockid_t, timespec*)>("clock_gettime");
  const int result = original(clock, now);
  if (result == 0 && of_the_day(clock)) now->tv_sec += jump();
  return result;
}

int gettimeofday(timeval* now, void* zone) noexcept {
  static const auto original = next<int (*)(timeval*, void*)>("gettimeofday");
  const int result = original(now, zone);
  if (result == 0) now->tv_sec += jump();
  return result;
}

std::time_t time(std::time_t* out) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (out != nullptr) *out = now.tv_sec;
  return now.tv_sec;
}
}
