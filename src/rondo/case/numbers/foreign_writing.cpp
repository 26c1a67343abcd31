// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/numbers/foreign_writing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rondo::study {
namespace {

struct Lookalike {
  std::string_view bytes;  ///< UTF-8
  std::string_view name, ascii;
};

constexpr std::string_view minus = "-", space = "a space";

constexpr std::array lookalikes{
    Lookalike{"\u2212", "the minus sign U+2212", minus},
    Lookalike{"\u2010", "the hyphen U+2010", minus},
    Lookalike{"\u2011", "the hyphen U+2011", minus},
    Lookalike{"\u2012", "the dash U+2012", minus},
    Lookalike{"\u2013", "the dash U+2013", minus},
    Lookalike{"\u2014", "the dash U+2014", minus},
    Lookalike{"\uFF0D", "the wide minus U+FF0D", minus},
    Lookalike{"\u201C", "the curly quotation mark U+201C", "\""},
    Lookalike{"\u201D", "the curly quotation mark U+201D", "\""},
    Lookalike{"\u201E", "the curly quotation mark U+201E", "\""},
    Lookalike{"\u00AB", "the quotation mark U+00AB", "\""},
    Lookalike{"\u00BB", "the quotation mark U+00BB", "\""},
    Lookalike{"\u2018", "the curly quotation mark U+2018", "'"},
    Lookalike{"\u2019", "the curly quotation mark U+2019", "'"},
    Lookalike{"\u00A0", "the space U+00A0", space},
    Lookalike{"\u2009", "the space U+2009", space},
    Lookalike{"\u202F", "the space U+202F", space},
    Lookalike{"\u3000", "the space U+3000", space},
    Lookalike{"\uFF0C", "the wide comma U+FF0C", ","},
    Lookalike{"\uFF0E", "the wide point U+FF0E", "."},
};

std::string lookalike_in(std::string_view text) {
  std::size_t first = text.npos;
  std::string found;
  for (const Lookalike& l : lookalikes) {
    const std::size_t at = text.find(l.bytes);
    if (at >= first) continue;
    first = at;
    found = fmt::format("it has {} where {} is to stand", l.name, l.ascii);
  }
  return found;
}

std::size_t after_digits(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of("0123456789", at), text.size());
}

/// Finds a number with a decimal comma, or with D instead of E.
std::string foreign_number(std::string_view text) {
  std::string right(text);
  std::size_t at = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  std::size_t end = after_digits(text, at);
  bool digits = end > at, comma = false, exponent = false;
  if (end < text.size() && (text[end] == ',' || text[end] == '.')) {
    comma = text[end] == ',';
    right[end] = '.';
    at = end + 1;
    end = after_digits(text, at);
    if (comma && (!digits || end == at)) return {};
    digits = digits || end > at;
  }
  if (digits && end < text.size() && std::string_view("dDeE").find(text[end]) != text.npos) {
    exponent = text[end] == 'd' || text[end] == 'D';
    right[end] = 'e';
    at = end + 1;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    end = after_digits(text, at);
    if (end == at) return {};
  }
  if (!digits || end < text.size() || !(comma || exponent)) return {};
  return fmt::format("it has {}: write {}",
                     comma ? "a decimal comma" : "an exponent with D, as Fortran writes it", right);
}

/// The line without its strings and its comment.
std::string bare(std::string_view line) {
  std::string text;
  char quote = '\0';  // delimiter of the current string
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (quote == '\0' && c == '#') break;
    if (quote == '\0' && (c == '"' || c == '\''))
      quote = c;
    else if (quote == '\0')
      text += c;
    else if (c == quote)
      quote = '\0';
    else if (c == '\\' && quote == '"')
      ++k;
  }
  return text;
}

}  // namespace

bool begins_with_foreign_minus(std::string_view text) {
  return std::ranges::any_of(lookalikes, [&](const Lookalike& l) {
    return l.ascii == minus && text.starts_with(l.bytes);
  });
}

std::string foreign_writing(std::string_view value) {
  const std::string found = lookalike_in(value);
  if (!found.empty()) return found;
  const std::size_t begin = value.find_first_not_of(" \t\"");
  if (begin == value.npos) return {};
  return foreign_number(value.substr(begin, value.find_last_not_of(" \t\",;") - begin + 1));
}

std::string cause_in(std::string_view value) {
  const std::string cause = foreign_writing(value);
  return cause.empty() ? cause : "; " + cause;
}

std::string cause_in_items(std::string_view written) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t k = 1; k + 1 < written.size(); ++k)
    if (written[k] == ',' && is_digit(written[k - 1]) && is_digit(written[k + 1]))
      return "; a comma divides items, a point is in a number: 0.3, not 0,3";
  return {};
}

/// In an array, a comma between digits may simply separate items.
std::string foreign_writing_in_line(std::string_view line) {
  const std::string text = bare(line);
  std::string found = lookalike_in(text);
  const bool array = text.find('[') != text.npos;
  const std::string_view divides = array ? " \t\r=[]{}," : " \t\r={}";
  for (std::size_t at = 0; found.empty() && at < text.size();) {
    const std::size_t begin = std::min(text.find_first_not_of(divides, at), text.size());
    at = std::min(text.find_first_of(divides, begin), text.size());
    found = foreign_number(std::string_view(text).substr(begin, at - begin));
  }
  return found;
}

}  // namespace rondo::study
