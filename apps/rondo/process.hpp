// SPDX-License-Identifier: BSD-3-Clause
/// @file  Start and end of this process, whatever its environment.
#pragma once

namespace rondo::app {

/// Opens a replacement for standard streams that were closed at the start. Otherwise a results file
/// could get their descriptor, and messages would go into it. Output to a closed stdout remains an
/// error, because the replacement is read-only.
void open_standard_streams();

/// Under a memory limit, OpenBLAS's threads may wait for their buffers for ever, and so would
/// exit(), which joins them (OpenBLAS 0.3.21). Call it when all files are closed.
[[noreturn]] void leave(int code);

}  // namespace rondo::app
