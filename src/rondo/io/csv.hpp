// SPDX-License-Identifier: BSD-3-Clause
/// @file  A CSV file written row by row. Each row reaches the operating system before row()
/// returns, so that a killed run keeps its rows. Numbers are written as the shortest text that
/// reads back to the same bits.
#pragma once
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondo/io/h5/hash.hpp"

namespace rondo::io {

/// Contents of a CSV file at some moment: the size and hash of its complete rows.
struct CsvPlace {
  std::size_t bytes = 0;
  std::string hash;

  friend bool operator==(const CsvPlace&, const CsvPlace&) = default;
};

/// @throws FileError: cannot be read, is shorter, or differs in a byte from `kept`; the message
/// names the line if one contains a number that is not finite
void demand_kept(const std::filesystem::path& file, const CsvPlace& kept);

class Csv {
 public:
  /// Creates the file and writes the header. @throws FileError
  Csv(const std::filesystem::path& file, const std::vector<std::string>& columns);
  /// Continues a file with the same columns after the part that is kept. @throws FileError: it has
  /// other columns, or as demand_kept()
  Csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
      const CsvPlace& kept);
  /// @pre as many values as columns. @throws FileError
  void row(std::span<const double> values);
  /// Rows collected by the caller are flushed at once. @throws FileError
  void rows(std::span<const double> values);
  void close();
  /// The length written so far and its hash.
  [[nodiscard]] CsvPlace place() const { return {bytes_, hash_.text()}; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  void put(const std::string& text);

  struct Closer {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::size_t n_columns_ = 0;
  std::size_t bytes_ = 0;
  Hash hash_;  ///< of the bytes written
  std::unique_ptr<std::FILE, Closer> file_;
  std::string text_;  ///< reused
};

/// The columns of a file by name. An incomplete last row, left by a program that was killed while
/// writing, is ignored. @throws FileError: cannot be read, no header, a field that is not a number
std::map<std::string, std::vector<double>, std::less<>> read_columns(
    const std::filesystem::path& file);

}  // namespace rondo::io
