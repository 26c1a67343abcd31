// SPDX-License-Identifier: BSD-3-Clause
/// @file  Reader of ASAM OpenCRG 1.2 files: text and binary, single and double precision. What each
/// line of a file does, and what is refused, is in docs/roads.md. Facts of the format: ASAM OpenCRG
/// 1.2.0 user manual, sections 6.2 to 6.4, and the reference implementation
/// github.com/asam-ev/OpenCRG.
#pragma once
#include <filesystem>

#include "rondo/road/road.hpp"

namespace rondo::road {

/// Reads a road; a file that refers to another one ($ROAD_CRG_FILE) gives modifiers and options,
/// the other one the heights. Memory is asked for only if the size of the file agrees with its
/// header. Modifiers are applied. Lengths are in m, slopes in m/m.
/// @throws InputError: the header is wrong, incomplete, or asks for what is not done (file, line,
/// block and key); FileError: a file that cannot be read, or whose data are damaged or cut off
[[nodiscard]] Road read_crg(const std::filesystem::path& file);

}  // namespace rondo::road
