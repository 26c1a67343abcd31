// SPDX-License-Identifier: BSD-3-Clause
/// @file  Tables of docs/ that are made from the program's own tables, each between its mark and
/// the next end_mark. With RONDO_WRITE_MANUAL in the environment the tests write them.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace rondo::test {

struct ManualTable {
  std::string mark;  ///< "keys: disk" for the line "<!-- keys: disk -->"
  std::string text;  ///< lines of Markdown, each with a line feed
};

/// A row of a table; characters that would end a cell are escaped.
inline std::string manual_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) {
    row += ' ';
    for (const char c : cell) row += c == '|' ? std::string("\\|") : std::string(1, c);
    row += " |";
  }
  return row + "\n";
}

/// Expects that the file has these tables or, with RONDO_WRITE_MANUAL, writes them.
inline void expect_in_manual(const std::filesystem::path& file,
                             const std::vector<ManualTable>& tables) {
  constexpr std::string_view end_mark = "<!-- end -->\n";
  std::ifstream stream(file, std::ios::binary);
  const std::string manual{std::istreambuf_iterator<char>(stream), {}};
  std::string current = manual;
  for (const ManualTable& table : tables) {
    const std::string mark = "<!-- " + table.mark + " -->\n";
    const auto at = current.find(mark);
    ASSERT_NE(at, std::string::npos) << file << " has no place for a table: " << mark;
    const auto begin = at + mark.size(), end = current.find(end_mark, begin);
    ASSERT_NE(end, std::string::npos) << file << ": no " << end_mark << "after " << mark;
    current.replace(begin, end - begin, table.text);
  }
  if (std::getenv("RONDO_WRITE_MANUAL") != nullptr)
    std::ofstream(file, std::ios::binary) << current;
  else
    EXPECT_EQ(manual, current) << file
                               << " is not what the program's tables say; this test writes "
                                  "it with RONDO_WRITE_MANUAL=1 in the environment";
}

/// Expects that the file is this text or, with RONDO_WRITE_MANUAL, writes it.
inline void expect_file(const std::filesystem::path& file, const std::string& text) {
  if (std::getenv("RONDO_WRITE_MANUAL") != nullptr) std::ofstream(file, std::ios::binary) << text;
  std::ifstream stream(file, std::ios::binary);
  const std::string found{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_TRUE(found == text) << file << " is not what the program's tables say; this test writes "
                             << "it with RONDO_WRITE_MANUAL=1 in the environment";
}

}  // namespace rondo::test
