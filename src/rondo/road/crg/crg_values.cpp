// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/crg/crg_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/core/text/edit_distance.hpp"

namespace rondo::road {
namespace {

/// The known key that is most like the one found.
std::string nearest_key(std::string_view found, std::span<const std::string_view> known) {
  const auto nearest = std::ranges::min_element(
      known, {}, [&](std::string_view key) { return edit_distance(key, found); });
  return std::string(*nearest);
}

CrgValue value_of(const CrgValues& values, const CrgLine& line,
                  std::span<const std::string_view> known) {
  const std::size_t equals = line.text.find('=');
  HeaderPlace place{values.file, line.number, fmt::format("${}", values.block)};
  if (equals == std::string::npos)
    refuse_header(place, "", fmt::format("\"{}\" is not KEY = value", shown_part(line.text)),
                  "KEY = value, or * before a comment");
  CrgValue value{upper_case(without_blanks(std::string_view(line.text).substr(0, equals))),
                 std::string(without_blanks(std::string_view(line.text).substr(equals + 1))), 0.0,
                 line.number};
  place.key = fmt::format("${} {}", values.block, shown_part(value.key));
  if (std::ranges::find(known, value.key) == known.end())
    refuse_header(
        place, value.text, "this key is not known, so that its effect is not either",
        fmt::format("{}, or no line with it", nearest_key(value.key.substr(0, 40), known)));
  const std::optional<double> number = crg_number(value.text);
  if (!number)
    refuse_header(place, value.text, "this is not a finite number", "a number like -1.50");
  value.value = *number;
  return value;
}

}  // namespace

const CrgValue* CrgValues::find(std::string_view key) const noexcept {
  const auto found = std::ranges::find(values, key, &CrgValue::key);
  return found == values.end() ? nullptr : &*found;
}

std::optional<double> CrgValues::real(std::string_view key) const noexcept {
  const CrgValue* const found = find(key);
  return found == nullptr ? std::nullopt : std::optional(found->value);
}

double CrgValues::real_or(std::string_view key, double otherwise) const noexcept {
  return real(key).value_or(otherwise);
}

std::optional<int> CrgValues::choice(std::string_view key, int most) const {
  const std::optional<double> value = real(key);
  if (!value) return std::nullopt;
  for (int i = 0; i <= most; ++i)
    if (*value == i) return i;
  refuse(key, "this is not one of the choices", fmt::format("a whole number from 0 to {}", most));
}

HeaderPlace CrgValues::place(std::string_view key) const {
  const CrgValue* const found = find(key);
  return {file, found == nullptr ? 0 : found->line, fmt::format("${} {}", block, key)};
}

void CrgValues::refuse(std::string_view key, const std::string& message,
                       const std::string& allowed) const {
  const CrgValue* const found = find(key);
  refuse_header(place(key), found == nullptr ? "" : found->text, message, allowed);
}

CrgValues read_crg_values(const CrgHeader& header, const std::string& block,
                          std::span<const std::string_view> known) {
  CrgValues values{header.file, block, {}};
  const CrgBlock* const found = header.block(block);
  if (found == nullptr) return values;
  for (const CrgLine& line : found->lines) {
    CrgValue value = value_of(values, line, known);
    const CrgValue* const earlier = values.find(value.key);
    if (earlier == nullptr)
      values.values.push_back(std::move(value));
    else if (earlier->value != value.value)
      refuse_header({values.file, line.number, fmt::format("${} {}", block, value.key)}, value.text,
                    fmt::format("line {} gives the key another value", earlier->line),
                    "each key once");
  }
  return values;
}

}  // namespace rondo::road
