// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the library does not tell about a file: whether it is whole, how many nodes it has.
#pragma once
#include <cstdint>
#include <string>

namespace rondo::reader {

/// An open file, mapped into memory.
struct SourceText {
  explicit SourceText(const std::string& path);  ///< throws std::string, why it cannot be read
  ~SourceText();
  SourceText(const SourceText&) = delete;
  SourceText& operator=(const SourceText&) = delete;

  /// Sections that have no end, in words; empty: none. The library takes a number that is cut in
  /// two for a shorter one.
  [[nodiscard]] std::string missing_end() const;

  /// MSH 2.2: the library drops nodes that no element uses without a word. 0: not known.
  [[nodiscard]] std::uint64_t n_nodes() const;

  int file = -1;
  const char* text = nullptr;
  std::uint64_t size = 0;  ///< [B]
};

}  // namespace rondo::reader
