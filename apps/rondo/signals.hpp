// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signals that ask for an end: SIGINT, SIGTERM, SIGHUP. What is ignored from the start
/// (nohup, the shell's background jobs) stays ignored.
#pragma once
#include <atomic>
#include <string>

namespace rondo::app {

/// From now on they end the program at once, with exit code 130 and a word on stderr: while nothing
/// is written that would have to be closed. Files that are not yet whole are removed.
void end_at_stop_signals();

/// What they print on stdout then; empty: nothing. Not to be called from several threads.
void say_at_stop_signals(std::string text);

/// Set once one of them has come, from catch_stop_signals() on.
const std::atomic<bool>& stop_requested() noexcept;

/// From now on they ask for a clean end after the step in hand.
void catch_stop_signals();

}  // namespace rondo::app
