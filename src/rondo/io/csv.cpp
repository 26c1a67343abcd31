// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/csv.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <iterator>
#include <system_error>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"

namespace rondo::io {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* doing) {
  const int code = errno;
  throw FileError(path.string(),
                  std::string("cannot ") + doing + ": " + std::generic_category().message(code));
}

/// Without a buffer of its own the stream passes a text on in one write.
void put(std::FILE* file, const std::string& text, const std::filesystem::path& path) {
  if (std::fwrite(text.data(), 1, text.size(), file) != text.size()) fail(path, "write");
}

}  // namespace

Csv::Csv(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : path_(file), n_columns_(columns.size()), file_(std::fopen(file.c_str(), "we")) {
  RONDO_DEMAND(!columns.empty(), file.string());
  if (!file_) fail(path_, "create");
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  put(file_.get(), fmt::format("{}\n", fmt::join(columns, ",")), path_);
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
  put(file_.get(), text_, path_);
}

void Csv::close() {
  if (file_ && std::fclose(file_.release()) != 0) fail(path_, "close");
}

}  // namespace rondo::io
