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

namespace rondo::io {

class Csv {
 public:
  /// Creates the file and writes the header. @throws FileError
  Csv(const std::filesystem::path& file, const std::vector<std::string>& columns);
  /// Goes on with a file of the same columns, of which the first `bytes` are kept. @throws
  /// FileError: it is shorter, or has other columns
  Csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
      std::size_t bytes);
  /// @pre as many values as columns. @throws FileError
  void row(std::span<const double> values);
  /// Rows put together by the caller are flushed at once. @throws FileError
  void rows(std::span<const double> values);
  void close();
  /// Of the file, all rows complete.
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  void put(const std::string& text);

  struct Closer {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::size_t n_columns_ = 0;
  std::size_t bytes_ = 0;
  std::unique_ptr<std::FILE, Closer> file_;
  std::string text_;  ///< reused
};

/// The columns of such a file by name. A last row without its end, of a program killed while it
/// wrote, is left out. @throws FileError: cannot be read, no header, a field that is not a number
std::map<std::string, std::vector<double>, std::less<>> read_columns(
    const std::filesystem::path& file);

}  // namespace rondo::io
