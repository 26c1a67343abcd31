// SPDX-License-Identifier: BSD-3-Clause
#include "signals.hpp"

#include <unistd.h>

#include <csignal>
#include <string>
#include <utility>

#include "rondo/core/error.hpp"
#include "rondo/core/files/removed_at_signal.hpp"

namespace rondo::app {
namespace {

std::atomic<bool> requested{false};
std::atomic<const std::string*> last_words{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void request_stop(int) {
  requested.store(true);
}

/// Calls only functions that are allowed in a signal handler.
extern "C" void end_at_once(int) {
  constexpr char text[] = "rondo: warning: interrupted\n";
  static_cast<void>(!write(STDERR_FILENO, text, sizeof text - 1));
  if (const std::string* words = last_words.load())
    static_cast<void>(!write(STDOUT_FILENO, words->data(), words->size()));
  remove_at_signal();
  _exit(exit_interrupted);
}

void handle_stop_signals(void (*handler)(int)) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(number, handler) == SIG_IGN) std::signal(number, SIG_IGN);
}

}  // namespace

void end_at_stop_signals() {
  handle_stop_signals(end_at_once);
}

void say_at_stop_signals(std::string text) {
  static std::string words;
  last_words.store(nullptr);
  words = std::move(text);
  if (!words.empty()) last_words.store(&words);
}

const std::atomic<bool>& stop_requested() noexcept {
  return requested;
}

void catch_stop_signals() {
  handle_stop_signals(request_stop);
}

}  // namespace rondo::app
