// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/road/crg/crg_data.hpp"
#include "rondo/road/crg/crg_text.hpp"

namespace rondo::road {
namespace {

constexpr std::size_t record_room = 4096;

/// Records of text, and faults in them by line.
class TextRecords {
 public:
  TextRecords(std::istream& in, const CrgDataPlan& plan)
      : in_(in), plan_(plan), line_(plan.header_lines) {}

  /// The next record, without its end; false: the file ends.
  bool next(std::string_view& record) {
    if (!in_.getline(buffer_.data(), record_room)) {
      if (in_.eof()) return false;
      ++line_;
      refuse("the line is longer than a record of 80 characters; OpenCRG goes on in the next line");
    }
    ++line_;
    unended_ = in_.eof();
    record = std::string_view(buffer_.data(),
                              static_cast<std::size_t>(in_.gcount()) - (unended_ ? 0 : 1));
    if (record.ends_with('\r')) record.remove_suffix(1);
    record = record.substr(0, record.find_last_not_of(" \t") + 1);
    return true;
  }

  /// The first record of the next row, behind empty lines.
  bool next_row(std::string_view& record) {
    while (next(record))
      if (!record.empty()) return true;
    return false;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw FileError(plan_.file, fmt::format("line {}, in the data: {}", line_, what));
  }

  /// Puts the numbers of a record where they belong.
  void take(std::string_view record, std::span<double> numbers) const {
    const std::size_t width = plan_.format.width();
    if (record.size() > numbers.size() * width)
      refuse(
          fmt::format("the line has more than {} numbers of {} characters", numbers.size(), width));
    if (unended_ && record.size() < numbers.size() * width)
      refuse("the file ends within a row: it is cut off; copy it once more");
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = number(record, k, numbers.size());
  }

 private:
  [[nodiscard]] double number(std::string_view record, std::size_t k, std::size_t n) const {
    const std::size_t width = plan_.format.width();
    if (record.size() <= k * width)
      refuse(fmt::format("the line has {} numbers where {} belong to the row", k, n));
    const std::string_view field = without_blanks(record.substr(k * width, width));
    if (field.starts_with('*') || upper_case(field) == "NAN")
      return std::numeric_limits<double>::quiet_NaN();
    const std::optional<double> value = crg_number(field);
    if (!value || std::abs(*value) > largest_crg_number)
      refuse(
          fmt::format("characters {} to {}, \"{}\", are not a number below 1e5; numbers have {} "
                      "characters each, and missing ones begin with *",
                      k * width + 1, (k + 1) * width, shown_part(field), width));
    return *value;
  }

  std::istream& in_;
  const CrgDataPlan& plan_;
  std::array<char, record_room> buffer_{};
  int line_;
  bool unended_ = false;  ///< the file ends without a line end
};

}  // namespace

void read_crg_text_rows(std::istream& in, const CrgDataPlan& plan, const TakeCrgRow& take) {
  TextRecords records(in, plan);
  std::vector<double> row(plan.n_columns);
  const std::size_t per_record = plan.format.per_record();
  double rows = 0.0;
  for (std::string_view record; records.next_row(record); ++rows) {
    if (plan.rows && rows == *plan.rows)
      records.refuse(
          fmt::format("data follow the last of {} rows; REFERENCE_LINE_END_U, "
                      "REFERENCE_LINE_INCREMENT and the data do not agree",
                      *plan.rows));
    for (std::size_t k = 0; k < row.size(); k += per_record) {
      if (k > 0 && !records.next(record))
        records.refuse("the file ends within a row: it is cut off; copy it once more");
      records.take(record, std::span(row).subspan(k, std::min(per_record, row.size() - k)));
    }
    take(row);
  }
  if (plan.rows && rows < *plan.rows)
    records.refuse(
        fmt::format("the file ends after {} of {} rows: it is cut off, or "
                    "REFERENCE_LINE_END_U and REFERENCE_LINE_INCREMENT do not agree with it",
                    rows, *plan.rows));
}

}  // namespace rondo::road
