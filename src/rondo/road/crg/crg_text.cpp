// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/crg/crg_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "rondo/core/error.hpp"

namespace rondo::road {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";
constexpr std::size_t longest_number = 64;

bool is_exponent_letter(char c) noexcept {
  return c == 'e' || c == 'E' || c == 'd' || c == 'D';
}

/// As std::from_chars takes it: without a leading +, with e, and the sign behind it.
std::string in_c_form(std::string_view text) {
  std::string number(text.substr(text.starts_with('+') ? 1 : 0));
  const auto letter = std::ranges::find_if(number, is_exponent_letter);
  if (letter == number.end()) return number;
  *letter = 'e';
  if (letter != number.begin() && (*(letter - 1) == '+' || *(letter - 1) == '-'))
    std::swap(*(letter - 1), *letter);
  return number;
}

}  // namespace

std::string_view without_blanks(std::string_view text) noexcept {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return upper;
}

std::string shown_part(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string part(text.substr(0, longest));
  for (char& c : part)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7E) c = '?';
  return text.size() > longest ? part + "..." : part;
}

std::optional<double> crg_number(std::string_view text) {
  text = without_blanks(text);
  if (text.empty() || text.size() > longest_number) return std::nullopt;
  const std::string number = in_c_form(text);
  double value = 0.0;
  const char* const last = number.data() + number.size();
  const auto [end, error] = std::from_chars(number.data(), last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

void refuse_header(const HeaderPlace& place, std::string_view found, const std::string& message,
                   const std::string& allowed) {
  throw InputError(Fault{place.file, place.line, place.line > 0 ? 1 : 0, place.key,
                         shown_part(found), message, allowed});
}

}  // namespace rondo::road
