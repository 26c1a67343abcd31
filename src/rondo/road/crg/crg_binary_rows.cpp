// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/road/crg/crg_data.hpp"

namespace rondo::road {
namespace {

constexpr std::size_t record_bytes = 80;

double big_endian_number(const unsigned char* bytes, bool twofold) noexcept {
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < (twofold ? 8U : 4U); ++k) bits = bits << 8U | bytes[k];
  return twofold ? std::bit_cast<double>(bits)
                 : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

/// How the bytes of line ends stand in the data: a conversion of them leaves traces.
struct LineEndTraces {
  std::size_t pairs = 0;         ///< CR LF
  std::size_t single_feeds = 0;  ///< LF without CR before it
};

LineEndTraces line_ends_in(std::istream& in, std::size_t data_begin) {
  in.clear();
  in.seekg(static_cast<std::streamoff>(data_begin));
  LineEndTraces traces;
  std::vector<char> chunk(1U << 16U);
  char before = 0;
  while (in.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || in.gcount() > 0)
    for (std::streamsize k = 0; k < in.gcount(); ++k) {
      const char c = chunk[static_cast<std::size_t>(k)];
      if (c == '\n') ++(before == '\r' ? traces.pairs : traces.single_feeds);
      before = c;
    }
  return traces;
}

/// A sentence if the size differs as after a conversion of line ends, else empty.
std::string suspicion(std::istream& in, const CrgDataPlan& plan, double missing_bytes) {
  const LineEndTraces traces = line_ends_in(in, plan.data_begin);
  if (missing_bytes > 0.0 && missing_bytes <= 0.01 * static_cast<double>(plan.file_size) &&
      traces.pairs == 0)
    return "; no CR LF is among the data: a conversion of line ends (CR LF to LF) has probably "
           "eaten "
           "bytes. Fetch the file again in binary mode";
  if (missing_bytes < 0.0 && traces.single_feeds == 0 && traces.pairs > 0)
    return "; each LF among the data has a CR before it: a conversion of line ends (LF to CR LF) "
           "has "
           "probably added bytes. Fetch the file again in binary mode";
  return "";
}

[[noreturn]] void refuse_size(std::istream& in, const CrgDataPlan& plan, double expected) {
  const std::size_t n_bytes = plan.file_size - plan.data_begin;
  const double missing = expected - static_cast<double>(n_bytes);
  throw FileError(
      plan.file,
      fmt::format(
          "the data begin at byte {} and have {} bytes, {:.12g} too {}: {:.12g} rows of {} numbers "
          "({}) in records of {} bytes have {:.12g}; REFERENCE_LINE_END_U, "
          "REFERENCE_LINE_INCREMENT and the data do not agree, or the file is damaged{}",
          plan.data_begin, n_bytes, std::abs(missing), missing > 0.0 ? "few" : "many", *plan.rows,
          plan.n_columns, plan.format.name, record_bytes, expected, suspicion(in, plan, missing)));
}

/// The number of rows that the header promises, once the size of the file agrees with it.
std::size_t promised_rows(std::istream& in, const CrgDataPlan& plan) {
  const auto n_bytes = static_cast<double>(plan.file_size - plan.data_begin);
  const double net =
      *plan.rows * static_cast<double>(plan.n_columns) * static_cast<double>(plan.format.width());
  const double whole = std::ceil(net / record_bytes) * record_bytes;
  // Some files end with the last number, others with a line end behind the last record.
  const bool agrees = n_bytes == net || (n_bytes >= whole && n_bytes <= whole + 2.0);
  if (!agrees) refuse_size(in, plan, whole);
  return static_cast<std::size_t>(*plan.rows);
}

/// By the size of the file alone; the last record is filled with NaN.
std::size_t rows_that_fit(std::istream& in, const CrgDataPlan& plan) {
  const std::size_t n_bytes = plan.file_size - plan.data_begin;
  if (n_bytes % record_bytes != 0)
    throw FileError(
        plan.file,
        fmt::format(
            "the data begin at byte {} and have {} bytes, no multiple of the {} of "
            "a record: the file is damaged{}",
            plan.data_begin, n_bytes, record_bytes,
            suspicion(in, plan, static_cast<double>(record_bytes - n_bytes % record_bytes))));
  return n_bytes / plan.format.width() / plan.n_columns;
}

[[noreturn]] void refuse_number(const CrgDataPlan& plan, std::size_t byte, double number) {
  throw FileError(
      plan.file,
      fmt::format("byte {}, in the data: {} is no number below 1e5: the file is damaged, "
                  "or its format is not {}",
                  byte, number, plan.format.name));
}

bool is_padding(std::span<const double> row) noexcept {
  return std::ranges::all_of(row, [](double x) { return std::isnan(x); });
}

}  // namespace

void read_crg_binary_rows(std::istream& in, const CrgDataPlan& plan, const TakeCrgRow& take) {
  const std::size_t n_rows = plan.rows ? promised_rows(in, plan) : rows_that_fit(in, plan);
  const std::size_t width = plan.format.width(), row_bytes = width * plan.n_columns;
  std::vector<unsigned char> bytes(row_bytes);
  std::vector<double> row(plan.n_columns);
  in.clear();
  in.seekg(static_cast<std::streamoff>(plan.data_begin));
  for (std::size_t i = 0; i < n_rows; ++i) {
    if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(row_bytes)))
      throw FileError(plan.file, fmt::format("row {} cannot be read", i + 1));
    for (std::size_t k = 0; k < row.size(); ++k) {
      row[k] = big_endian_number(bytes.data() + k * width, plan.format.twofold);
      if (std::abs(row[k]) > largest_crg_number)
        refuse_number(plan, plan.data_begin + i * row_bytes + k * width, row[k]);
    }
    if (!plan.rows && is_padding(row)) return;
    take(row);
  }
}

}  // namespace rondo::road
