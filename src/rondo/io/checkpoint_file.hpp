// SPDX-License-Identifier: BSD-3-Clause
/// @file  A file that is either whole or refused: HDF5 behind a first block of 512 bytes of text,
/// which holds the hash of all that follows (XXH3, 128 bits). h5py and h5dump read it as any other.
#pragma once
#include <filesystem>
#include <functional>

#include "rondo/io/h5/h5.hpp"

namespace rondo::io {

inline constexpr std::size_t hash_block_bytes = 512;

/// What `fill` puts into it takes the place of `file` at once, and is on the disk then: at any
/// moment there is the old one or the new one. @throws FileError, and what `fill` throws; the old
/// one stays
void write_checkpoint_file(const std::filesystem::path& file,
                           const std::function<void(h5::File&)>& fill);

/// @throws FileError: cannot be read, is none, or differs from what was written
h5::File open_checkpoint_file(const std::filesystem::path& file);

}  // namespace rondo::io
