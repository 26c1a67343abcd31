// SPDX-License-Identifier: BSD-3-Clause
/// @file  Parts of the C library that the sources of this folder, and only they, share.
#pragma once
#include <hdf5.h>

#include <string>
#include <type_traits>
#include <vector>

#include "rondo/io/h5/h5.hpp"

namespace rondo::io::h5 {

static_assert(std::is_same_v<hid_t, std::int64_t>);

/// Throws with the reason given by the library. @throws FileError
[[noreturn]] void fail_in(const std::string& path, const std::string& doing);

/// Errors are thrown, never printed. HDF5 may keep that setting per thread. Data that could not be
/// written is not written again at program exit: HDF5 would crash on a file that cannot grow.
void be_quiet();

hid_t native(Type type);
std::vector<hsize_t> extents(const Shape& shape);
Handle make_space(const Shape& shape, const Shape& most);

/// Oldest file layout (no consistency flags that remain set after a kill), no file locks.
Handle file_access();

}  // namespace rondo::io::h5
