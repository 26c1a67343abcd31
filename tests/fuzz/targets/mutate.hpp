// SPDX-License-Identifier: BSD-3-Clause
/// @file  Mutations that keep an input in shape, so that they get past the first checks. Each is
/// the body of LLVMFuzzerCustomMutator: changes `data` (size bytes, room for max) and returns the
/// new size.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace rondo::fuzz {

/// Text with numbers: every other time one of its numbers or lines, else libFuzzer's own.
std::size_t mutate_text(std::uint8_t* data, std::size_t size, std::size_t max, unsigned seed);

/// Binary files with places of things in them: bytes and numbers change where they are, nothing
/// moves; now and then the end is cut off. The first `keep` bytes stay.
std::size_t mutate_in_place(std::uint8_t* data, std::size_t size, unsigned seed, std::size_t keep);

/// The same on a file that is made anew at each start, so that no copy of it gets old: the input is
/// a list of patches, each 4 bytes place (little-endian, modulo the size), 1 byte length n (modulo
/// 9), n bytes that are put there; n = 0 cuts the file off.
std::string patched(std::string_view base, std::string_view patches);
std::size_t mutate_patches(std::uint8_t* data, std::size_t size, std::size_t max, unsigned seed,
                           std::string_view base);

/// A list of records of `width` bytes, of which the last 8 are a number: one of them changes, comes
/// or goes.
std::size_t mutate_records(std::uint8_t* data, std::size_t size, std::size_t max, unsigned seed,
                           std::size_t width);

}  // namespace rondo::fuzz
