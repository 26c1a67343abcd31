// SPDX-License-Identifier: BSD-3-Clause
/// @file  The file that is read, as bytes in memory.
#pragma once
#include <cstdint>
#include <string>

namespace rondo::reader {

/// An open file, mapped into memory.
struct SourceText {
  explicit SourceText(const std::string& path);  ///< throws std::string: why it cannot be read
  ~SourceText();
  SourceText(const SourceText&) = delete;
  SourceText& operator=(const SourceText&) = delete;

  int file = -1;
  const char* text = nullptr;
  std::uint64_t size = 0;  ///< [B]
};

}  // namespace rondo::reader
