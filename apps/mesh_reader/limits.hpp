// SPDX-License-Identifier: BSD-3-Clause
/// @file  What this process may take: a damaged file must end in an error, not in swapping.
#pragma once
#include <cstdint>

namespace rondo::reader {

/// Memory and time in proportion to the file, no core dump, no file of more than 1 MB written; dies
/// with the program that started it, and leaves interrupts to that one. To be called with the
/// libraries loaded: what they take comes on top. @return bytes of memory allowed for the mesh
std::uint64_t limit_process(std::uint64_t file_bytes);

}  // namespace rondo::reader
