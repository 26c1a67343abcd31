// SPDX-License-Identifier: BSD-3-Clause
/// @file  A CSV file written row by row; each row reaches the operating system before row()
/// returns, so that a killed run keeps its rows. Numbers are the shortest text that reads back the
/// same bits.
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

/// What a CSV file held at some moment: its first bytes, all rows complete, and their hash.
struct CsvPlace {
  std::size_t bytes = 0;
  std::string hash;

  friend bool operator==(const CsvPlace&, const CsvPlace&) = default;
};

/// @throws FileError: cannot be read, is shorter, or differs in a byte of these; the message names
/// the line where one holds what is no finite number
void demand_kept(const std::filesystem::path& file, const CsvPlace& kept);

class Csv {
 public:
  /// Creates the file and writes the header. @throws FileError
  Csv(const std::filesystem::path& file, const std::vector<std::string>& columns);
  /// Goes on with a file of the same columns after what is kept of it. @throws FileError: it has
  /// other columns, or as demand_kept()
  Csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
      const CsvPlace& kept);
  /// @pre as many values as columns. @throws FileError
  void row(std::span<const double> values);
  /// Rows put together by the caller are flushed at once. @throws FileError
  void rows(std::span<const double> values);
  void close();
  /// How far the file is written, with the hash of it.
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
  Hash hash_;  ///< of these bytes
  std::unique_ptr<std::FILE, Closer> file_;
  std::string text_;  ///< reused
};

/// The columns of such a file by name. A last row without its end, of a program killed while it
/// wrote, is left out. @throws FileError: cannot be read, no header, a field that is not a number
std::map<std::string, std::vector<double>, std::less<>> read_columns(
    const std::filesystem::path& file);

}  // namespace rondo::io
