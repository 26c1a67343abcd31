// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signals that request an end: SIGINT, SIGTERM, SIGHUP. Signals ignored from the start
/// (nohup, the shell's background jobs) remain ignored.
#pragma once
#include <atomic>
#include <string>

namespace rondo::app {

/// From this call on they end the program at once, with exit code 130 and a message on stderr. Used
/// while no open file needs closing; incomplete files are removed.
void end_at_stop_signals();

/// The text that they print on stdout then; empty: nothing. Not to be called from several threads.
void say_at_stop_signals(std::string text);

/// True once one of them has arrived after catch_stop_signals().
const std::atomic<bool>& stop_requested() noexcept;

/// From this call on they request a clean end after the current step.
void catch_stop_signals();

}  // namespace rondo::app
