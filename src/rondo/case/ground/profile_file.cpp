// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/ground/profile_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>

#include "rondo/case/numbers/foreign_writing.hpp"

namespace rondo::study {
namespace {

constexpr std::size_t most_faults = 5;
constexpr std::size_t longest_field = 40;  ///< characters of a field quoted in a message
constexpr std::string_view blank = " \t\r\v\f";
constexpr std::string_view allowed =
    "x and y in m, comma or white space between x and y, one point a line from left to right";

struct Token {
  std::string_view text;
  std::size_t begin = 0;  ///< position in its line
};

/// The fields of a line, separated by commas or white space. Between two commas there is an empty
/// field.
std::vector<Token> tokens_of(std::string_view line) {
  std::vector<Token> tokens;
  bool after_comma = false;
  for (std::size_t at = line.find_first_not_of(blank); at < line.size();) {
    const std::size_t end = std::min(line.find_first_of(", \t\r\v\f", at), line.size());
    tokens.push_back({line.substr(at, end - at), at});
    at = std::min(line.find_first_not_of(blank, end), line.size());
    after_comma = at < line.size() && line[at] == ',';
    if (after_comma) at = std::min(line.find_first_not_of(blank, at + 1), line.size());
  }
  if (after_comma) tokens.push_back({{}, line.size()});
  return tokens;
}

/// Also true if the number is out of range; its value is then infinite.
bool is_number(std::string_view text, double& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) value = INFINITY;
  return error != std::errc::invalid_argument && end == text.data() + text.size();
}

/// Whether it begins like a number; the name of a column does not.
bool begins_as_number(std::string_view text) {
  return begins_with_foreign_minus(text) ||
         (!text.empty() && std::string_view("0123456789+-.").find(text[0]) != text.npos);
}

/// Whether these are names of columns: words with letters, not numbers such as "0;0".
bool is_header(const std::vector<Token>& tokens) {
  const auto has_letter = [](const Token& t) {
    return std::ranges::any_of(t.text, [](unsigned char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c >= 0x80;  // or part of UTF-8
    });
  };
  double value = 0.0;
  return std::ranges::any_of(tokens, has_letter) &&
         std::ranges::none_of(tokens, [&](const Token& t) {
           return begins_as_number(t.text) || is_number(t.text, value);
         });
}

constexpr const char* is_road = "is an OpenCRG road file: heights over a surface, no profile";
constexpr const char* instead_of_road =
    "ground.road = \"NAME.crg\" in place of ground.profile, or two columns, x "
    "and y in m: one section along the road as a CSV file (docs/roads.md)";

/// Keywords that begin the lines in the header of an OpenCRG file.
bool is_opencrg(std::string_view text) {
  constexpr std::size_t head = 65536;
  text = text.substr(0, head);
  return std::ranges::any_of(
      std::array{"$CT", "$ROAD_CRG", "$KD_DEFINITION"}, [&](const char* key) {
        return text.starts_with(key) || text.find(std::string("\n") + key) != text.npos;
      });
}

/// The reason why a line does not have two numbers.
std::string cause_in_line(std::string_view line) {
  if (line.find(';') != line.npos) return "; a semicolon divides no numbers here";
  const std::string comma = cause_in_items(line);
  return comma.empty() ? cause_in(line) : comma;
}

/// The state of reading one file.
struct Reading {
  const std::string& name;
  ProfileFile& into;
  int line = 0;
  std::string_view text{};  ///< of the line

  void fault(const Token& at, std::string message) const {
    std::string found(at.text.substr(0, longest_field));
    if (found.size() < at.text.size()) found += "...";
    into.faults.push_back({name, line, static_cast<int>(at.begin) + 1, "ground.profile",
                           std::move(found), std::move(message), std::string(allowed)});
  }

  void add_point(const std::vector<Token>& tokens) {
    if (tokens.size() != 2)
      return fault(tokens.size() > 2 ? tokens[2] : tokens[0],
                   fmt::format("the line must have 2 numbers, not {}{}", tokens.size(),
                               cause_in_line(text)));
    std::array<double, 2> p{};
    for (std::size_t k = 0; k < 2; ++k) {
      if (!is_number(tokens[k].text, p[k]))
        return fault(tokens[k], "is not a number" + cause_in(tokens[k].text));
      if (!std::isfinite(p[k])) return fault(tokens[k], "must be a finite number");
    }
    into.points.push_back({p[0], p[1]});
    into.lines.push_back(line);
  }
};

}  // namespace

void refuse_road(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  std::error_code error;
  if (ending == ".crg" && std::filesystem::is_regular_file(file, error))
    throw InputError(Fault{file.string(), 0, 0, "ground.profile", "", is_road, instead_of_road});
}

ProfileFile parse_profile(const std::string& name, std::string_view text) {
  ProfileFile found;
  Reading in{name, found};
  bool is_first = true;
  if (is_opencrg(text)) {
    found.faults.push_back({name, 0, 0, "ground.profile", "", is_road, instead_of_road});
    return found;
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark of UTF-8
  while (!text.empty() && found.faults.size() < most_faults) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++in.line;
    in.text = line.substr(0, line.find('#'));
    const std::vector<Token> tokens = tokens_of(in.text);
    if (tokens.empty()) continue;
    if (!(is_first && is_header(tokens))) in.add_point(tokens);
    is_first = false;
    if (found.points.size() <= most_profile_points) continue;
    in.fault({}, fmt::format("there are more than {} points", most_profile_points));
    break;
  }
  if (found.faults.empty() && found.points.size() < 2)
    found.faults.push_back(
        {name, 0, 0, "ground.profile", "", "must have at least two points", std::string(allowed)});
  if (!found.faults.empty()) found.points.clear(), found.lines.clear();
  return found;
}

}  // namespace rondo::study
