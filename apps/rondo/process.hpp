// SPDX-License-Identifier: BSD-3-Clause
/// @file  How this process begins and ends, whatever it was started with.
#pragma once

namespace rondo::app {

/// A standard stream that was closed from the start gets one that takes or gives nothing: its
/// descriptor must not become that of a file of results, into which messages would then go. What
/// is asked for on a closed stdout is still an error, as that one is for reading only.
void open_standard_streams();

/// Under a limit of memory OpenBLAS's threads may wait for their buffers for ever, and so would
/// exit(), which joins them (OpenBLAS 0.3.21). All files are closed by then.
[[noreturn]] void leave(int code);

}  // namespace rondo::app
