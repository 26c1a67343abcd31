// SPDX-License-Identifier: BSD-3-Clause
/// @file  The header of an OpenCRG file: named blocks of lines up to the separator, a line that
/// begins with $$ (ASAM OpenCRG 1.2.0, sections 6.2 and 6.3).
#pragma once
#include <cstddef>
#include <filesystem>
#include <istream>
#include <string>
#include <vector>

namespace rondo::road {

/// A line of a block without comments, blanks and line end; never empty.
struct CrgLine {
  int number = 0;  ///< from 1
  std::string text;
};

struct CrgBlock {
  std::string name;  ///< upper case, without $
  int line = 0;      ///< of the name
  std::vector<CrgLine> lines;
};

struct CrgHeader {
  std::string file;
  std::vector<CrgBlock> blocks;
  std::size_t data_begin = 0;  ///< byte behind the separator; 0: there is none
  int last_line = 0;           ///< number of the last line of the header

  /// nullptr: the file has no such block.
  [[nodiscard]] const CrgBlock* block(const std::string& name) const noexcept;
};

/// Reads up to the separator, or to the end of the file. @throws InputError: a line that is too
/// long, a block that stands twice, text outside of blocks
[[nodiscard]] CrgHeader read_crg_header(std::istream& in, const std::filesystem::path& file);

}  // namespace rondo::road
