// SPDX-License-Identifier: BSD-3-Clause
#include "signals.hpp"

#include <csignal>

namespace rondo::app {
namespace {

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void request_stop(int) {
  requested.store(true);
}

}  // namespace

const std::atomic<bool>& stop_requested() noexcept {
  return requested;
}

void catch_stop_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(number, request_stop) == SIG_IGN) std::signal(number, SIG_IGN);
}

}  // namespace rondo::app
