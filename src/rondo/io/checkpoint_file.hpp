// SPDX-License-Identifier: BSD-3-Clause
/// @file  A file that is either complete or refused: HDF5 after a first block of 512 bytes of text,
/// which contains the hash of everything that follows (XXH3, 128 bits). h5py and h5dump read it.
#pragma once
#include <filesystem>
#include <functional>

#include "rondo/io/h5/h5.hpp"

namespace rondo::io {

inline constexpr std::size_t hash_block_bytes = 512;

/// Replaces `file` atomically by one with the contents that `fill` writes, and makes sure it is on
/// the disk: at any moment the old or the new one exists. @throws FileError, and what `fill`
/// throws; the old file then remains
void write_checkpoint_file(const std::filesystem::path& file,
                           const std::function<void(h5::File&)>& fill);

/// @throws FileError: cannot be read, is no such file, or differs from what was written
h5::File open_checkpoint_file(const std::filesystem::path& file);

}  // namespace rondo::io
