// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the libFuzzer targets share (docs/reliability.md, Fuzzing). A target takes bytes to
/// one reader of the program. Wrong input may be refused by an InputError or a FileError that says
/// something. A finding is anything else: another exception, a broken contract, what a sanitizer
/// reports, a check() that does not hold, a time or an amount of memory out of proportion.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "rondo/core/error.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::fuzz {

/// Ends the program: a finding.
void check(bool holds, std::string_view what);

bool is_finite(Vec2 v) noexcept;

/// What a refusal says is not empty.
void check_said(const std::exception& error);

/// True where the work was done, false where it was refused.
template <class Work>
bool accepted(const Work& work) {
  try {
    work();
    return true;
  } catch (const InputError& error) {
    check(!error.faults().empty(), "an InputError without a fault");
    check_said(error);
  } catch (const FileError& error) {
    check_said(error);
  }
  return false;
}

/// A folder of this process in the temporary one, removed at its end (a finding leaves it).
const std::filesystem::path& scratch_folder();

/// Replaces the file.
void put(const std::filesystem::path& file, std::string_view text);

std::string text_of(const std::filesystem::path& file);

/// The files an input is made of: "=== NAME" lines begin them. Text before the first is dropped.
struct Part {
  std::string_view name, text;
};
/// Takes the next part off `text`; false: there is none.
bool next_part(std::string_view& text, Part& part);

inline std::string_view view(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A number that depends on all bytes, to choose by.
std::uint32_t hash(std::string_view bytes) noexcept;

}  // namespace rondo::fuzz
