// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/csv.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <system_error>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/files/regular_file.hpp"
#include "rondo/io/files.hpp"

namespace rondo::io {
namespace {

std::string header_of(const std::vector<std::string>& columns) {
  RONDO_DEMAND(!columns.empty(), columns.size());
  return fmt::format("{}\n", fmt::join(columns, ","));
}

/// A field as quoted in a message: shortened, and without control characters.
std::string shown(std::string_view field) {
  constexpr std::size_t longest = 40;
  std::string text(field.substr(0, longest));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  return field.size() > longest ? text + "..." : text;
}

double number(std::string_view field, const std::filesystem::path& path, std::size_t line) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size())
    throw FileError(path.string(),
                    fmt::format("line {}: \"{}\" is not a number", line, shown(field)));
  return value;
}

/// Calls take(k, value) for each field k of a row of n.
template <class Take>
void read_row(std::string_view row, std::size_t n, std::size_t line,
              const std::filesystem::path& path, Take&& take) {
  for (std::size_t k = 0; k < n; ++k) {
    const auto comma = row.find(',');
    if ((comma == std::string_view::npos) != (k + 1 == n))
      throw FileError(path.string(),
                      fmt::format("line {}: not {} fields as in the header", line, n));
    take(k, number(row.substr(0, comma), path, line));
    if (comma != std::string_view::npos) row.remove_prefix(comma + 1);
  }
}

/// Reads the first `bytes` and adds them to `hash`. @throws FileError: the file is shorter
std::string beginning_of(const std::filesystem::path& file, std::size_t bytes, Hash& hash) {
  demand_regular_file(file);
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw FileError(file.string(), "cannot be measured: " + error.message());
  if (size < bytes)
    throw FileError(file.string(),
                    fmt::format("holds {} bytes where it held {}: damaged", size, bytes));
  std::ifstream in(file, std::ios::binary);
  std::string text(bytes, '\0');
  if (!in || !in.read(text.data(), static_cast<std::streamsize>(bytes))) fail_on(file, "read");
  hash.add(std::span<const char>(text));
  return text;
}

/// Number of the first line with a number that is not finite; 0: there is none.
/// @throws FileError: a line is not a row
std::size_t first_not_finite(std::string_view text, const std::filesystem::path& file) {
  const std::string_view header = text.substr(0, text.find('\n'));
  const auto n = static_cast<std::size_t>(1 + std::count(header.begin(), header.end(), ','));
  std::size_t found = 0;
  for (std::size_t line = 1; !text.empty() && found == 0; ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const auto look = [&](std::size_t, double value) {
      if (!std::isfinite(value)) found = line;
    };
    if (line > 1) read_row(text.substr(0, end), n, line, file, look);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return found;
}

/// Hash of the part that is kept. @throws FileError as demand_kept()
Hash hash_of_kept(const std::filesystem::path& file, const CsvPlace& kept) {
  Hash hash;
  const std::string text = beginning_of(file, kept.bytes, hash);
  if (hash.text() == kept.hash) return hash;
  const std::size_t line = first_not_finite(text, file);
  const std::string where =
      line > 0 ? fmt::format("line {} holds a number that is not finite; ", line) : "";
  throw FileError(file.string(),
                  fmt::format("{}its first {} bytes are not those that were written: damaged",
                              where, kept.bytes));
}

}  // namespace

void demand_kept(const std::filesystem::path& file, const CsvPlace& kept) {
  static_cast<void>(hash_of_kept(file, kept));
}

Csv::Csv(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : path_(file), n_columns_(columns.size()) {
  std::error_code error;
  if (std::filesystem::is_fifo(file, error)) demand_regular_file(file);  // it waits for a reader
  file_.reset(std::fopen(file.c_str(), "we"));
  if (!file_) fail_on(path_, "create");
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  put(header_of(columns));
}

Csv::Csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
         const CsvPlace& kept)
    : path_(file),
      n_columns_(columns.size()),
      bytes_(kept.bytes),
      hash_(hash_of_kept(file, kept)),
      file_(std::fopen(file.c_str(), "r+e")) {
  if (!file_) fail_on(path_, "open");
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  const std::string header = header_of(columns);
  std::string found(header.size(), '\0');
  if (std::fread(found.data(), 1, found.size(), file_.get()) != found.size() || found != header)
    throw FileError(path_.string(), "does not begin with the columns of this run");
  if (::ftruncate(::fileno(file_.get()), static_cast<off_t>(bytes_)) != 0)
    fail_on(path_, "shorten");
  if (std::fseek(file_.get(), 0, SEEK_END) != 0) fail_on(path_, "write");
}

/// Without a buffer of its own, the stream passes a text on in one write. If the disk has no space
/// for all of it, the file ends with the last complete row.
void Csv::put(const std::string& text) {
  const std::size_t written = std::fwrite(text.data(), 1, text.size(), file_.get());
  const int code = errno;
  const bool whole = written == text.size();
  const std::string_view there = std::string_view(text).substr(0, written);
  const std::size_t kept = whole ? written : there.rfind('\n') + 1;  // no row: npos + 1 = 0
  bytes_ += kept;
  hash_.add(std::span<const char>(text).first(kept));
  if (whole) return;
  static_cast<void>(::ftruncate(::fileno(file_.get()), static_cast<off_t>(bytes_)));
  errno = code;
  fail_on(path_, "write");
}

void Csv::row(std::span<const double> values) {
  RONDO_DEMAND(values.size() == n_columns_, path_.string(), values.size(), n_columns_);
  rows(values);
}

void Csv::rows(std::span<const double> values) {
  RONDO_DEMAND(values.size() % n_columns_ == 0, path_.string(), values.size(), n_columns_);
  RONDO_DEMAND(file_ != nullptr, path_.string());
  if (values.empty()) return;
  text_.clear();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = std::isnan(values[i]) ? std::abs(values[i]) : values[i];
    fmt::format_to(std::back_inserter(text_), "{}", value);
    text_ += (i + 1) % n_columns_ == 0 ? '\n' : ',';
  }
  put(text_);
}

void Csv::close() {
  if (file_ && std::fclose(file_.release()) != 0) fail_on(path_, "close");
}

namespace {

/// Names must be unique, because two columns of one name would become one.
std::vector<std::string> names_in(const std::string& header, const std::filesystem::path& path) {
  std::vector<std::string> names;
  std::istringstream fields(header + ",");  // so that the last field also ends
  for (std::string name; std::getline(fields, name, ',');) {
    if (name.empty() || std::find(names.begin(), names.end(), name) != names.end())
      throw FileError(path.string(), fmt::format("line 1: column {} has {}", names.size() + 1,
                                                 name.empty() ? "no name" : "the name of another"));
    names.push_back(name);
  }
  return names;
}

}  // namespace

std::map<std::string, std::vector<double>, std::less<>> read_columns(
    const std::filesystem::path& file) {
  demand_regular_file(file);
  std::ifstream in(file, std::ios::binary);
  if (!in) fail_on(file, "read");
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line) && !in.eof(); ++number) {
    if (number > 1) {
      read_row(line, columns.size(), number, file,
               [&](std::size_t k, double value) { columns[k].push_back(value); });
      continue;
    }
    names = names_in(line, file);
    columns.resize(names.size());
  }
  if (in.bad()) fail_on(file, "read");
  if (names.empty()) throw FileError(file.string(), "holds no header of columns");
  std::map<std::string, std::vector<double>, std::less<>> by_name;
  for (std::size_t k = 0; k < names.size(); ++k) by_name[names[k]] = std::move(columns[k]);
  return by_name;
}

}  // namespace rondo::io
