// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signals that ask for a clean end: SIGINT, SIGTERM, SIGHUP.
#pragma once
#include <atomic>

namespace rondo::app {

/// Set once one of them has come, from catch_stop_signals() on.
const std::atomic<bool>& stop_requested() noexcept;

/// Before this call a signal ends the program at once: nothing is there to be saved. One that is
/// ignored (nohup) stays ignored.
void catch_stop_signals();

}  // namespace rondo::app
