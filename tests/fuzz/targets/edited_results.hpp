// SPDX-License-Identifier: BSD-3-Clause
/// @file  A results.h5 that HDF5 finds in order, but whose datasets are not what a run writes:
/// missing, of other shapes, types and values.
#pragma once
#include <filesystem>
#include <string_view>

namespace rondo::fuzz {

/// Size of one edit: dataset, what is done, place (2 bytes), value (8 bytes); docs in the source.
inline constexpr std::size_t edit_size = 12;

/// Writes the file `from` with the edits made as `to`. `from` is read once, at the first call.
void write_edited(const std::filesystem::path& from, const std::filesystem::path& to,
                  std::string_view edits);

}  // namespace rondo::fuzz
