// SPDX-License-Identifier: BSD-3-Clause
/// @file  Resource limits of this process: a damaged file must cause an error, not swapping.
#pragma once
#include <cstdint>

namespace rondo::reader {

/// Sets limits: memory and time proportional to the file, no core dump, no written file above 1 MB.
/// The process dies with the program that started it, which alone handles interrupts. Call it after
/// libraries are loaded: their memory is added. @return bytes of memory allowed for the mesh
std::uint64_t limit_process(std::uint64_t file_bytes);

}  // namespace rondo::reader
