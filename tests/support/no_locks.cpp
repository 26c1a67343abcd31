// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loaded before the C library (LD_PRELOAD): directories cannot be locked, as on a network
/// file system without a lock server.
#include <cerrno>

extern "C" int flock(int /*file*/, int /*operation*/) noexcept {
  errno = ENOLCK;
  return -1;
}
