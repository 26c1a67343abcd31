// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/crg/crg_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "rondo/road/crg/crg_text.hpp"

namespace rondo::road {
namespace {

constexpr const char* definition_block = "$KD_DEFINITION";
constexpr std::array<const char*, 4> format_names{"LRFI", "LDFI", "KRBI", "KDBI"};

/// Upper case, with one blank where there are several.
std::string plain_words(std::string_view text) {
  std::string words;
  for (const char c : upper_case(without_blanks(text))) {
    const bool blank = c == ' ' || c == '\t';
    if (!blank)
      words += c;
    else if (words.back() != ' ')
      words += ' ';
  }
  return words;
}

CrgFormat format_of(const CrgHeader& header, const CrgLine& line) {
  const std::string name = upper_case(without_blanks(std::string_view(line.text).substr(2)));
  if (std::ranges::find(format_names, name) == format_names.end())
    refuse_header({header.file, line.number, std::string(definition_block) + " #:"}, name,
                  "this format is not one of OpenCRG", "LRFI, LDFI, KRBI or KDBI");
  return {name, name[2] == 'F', name[1] == 'D'};
}

struct ReferenceName {
  std::string_view name, unit;
  CrgColumn column;
};
constexpr std::array<ReferenceName, 4> reference_names{{
    {"REFERENCE LINE PHI", "RAD", CrgColumn::heading},
    {"REFERENCE LINE BANKING", "M/M", CrgColumn::banking},
    {"REFERENCE LINE SLOPE", "M/M", CrgColumn::slope},
    {"REFERENCE LINE U", "M", CrgColumn::position},
}};

/// The v or the number of "LONG SECTION AT V = -1.5" or "LONG SECTION 3".
void read_section(std::string_view words, const HeaderPlace& place, CrgChannel& channel) {
  constexpr std::string_view at_v = "AT V";
  words = without_blanks(words);
  std::optional<double> value;
  channel.column = CrgColumn::section_number;
  if (words.starts_with(at_v)) {
    channel.column = CrgColumn::section_at;
    words = without_blanks(words.substr(at_v.size()));
    if (words.starts_with('=')) value = crg_number(words.substr(1));
  } else {
    value = crg_number(words);
    if (value && (*value < 1.0 || *value != std::floor(*value) || *value > 1e9)) value.reset();
  }
  if (!value)
    refuse_header(place, channel.text, "this names no long section",
                  "D:long section at v = -1.500,m or D:long section 1,m");
  channel.value = *value;
}

void demand_unit(std::string_view unit, std::string_view expected, const HeaderPlace& place,
                 const CrgChannel& channel) {
  if (unit != expected)
    refuse_header(place, channel.text, "the unit of this channel is missing, or another one",
                  expected == "RAD" ? "rad"
                  : expected == "M" ? "m"
                                    : "m/m");
}

CrgChannel channel_of(const CrgHeader& header, const CrgLine& line) {
  constexpr std::string_view section = "LONG SECTION";
  CrgChannel channel{CrgColumn::ignored, 0.0, line.number, line.text};
  const HeaderPlace place{header.file, line.number, std::string(definition_block) + " D:"};
  const std::string words = plain_words(std::string_view(line.text).substr(2));
  const std::size_t comma = std::min(words.find(','), words.size());
  const std::string_view name = without_blanks(std::string_view(words).substr(0, comma));
  const std::string_view unit =
      comma < words.size() ? without_blanks(std::string_view(words).substr(comma + 1)) : "";
  if (name.starts_with(section)) {
    read_section(name.substr(section.size()), place, channel);
    demand_unit(unit, "M", place, channel);
    return channel;
  }
  const auto found = std::ranges::find(reference_names, name, &ReferenceName::name);
  if (found == reference_names.end()) return channel;
  demand_unit(unit, found->unit, place, channel);
  channel.column = found->column;
  return channel;
}

void demand_once(const CrgHeader& header, const CrgDefinition& definition) {
  for (const ReferenceName& reference : reference_names) {
    const auto is_it = [&](const CrgChannel& c) { return c.column == reference.column; };
    const auto first = std::ranges::find_if(definition.channels, is_it);
    if (first == definition.channels.end()) continue;
    const auto second = std::find_if(first + 1, definition.channels.end(), is_it);
    if (second != definition.channels.end())
      refuse_header({header.file, second->line, std::string(definition_block) + " D:"},
                    second->text, fmt::format("line {} defines this channel too", first->line),
                    "each channel once");
  }
}

}  // namespace

CrgDefinition read_crg_definition(const CrgHeader& header) {
  const CrgBlock* const block = header.block("KD_DEFINITION");
  if (block == nullptr)
    refuse_header({header.file, header.last_line, definition_block}, "",
                  "the file has no such block, which defines the columns of the data",
                  "$KD_Definition with lines D:long section ...,m");
  CrgDefinition definition;
  bool has_format = false;
  for (const CrgLine& line : block->lines) {
    if (line.text.starts_with("#:")) {
      if (has_format)
        refuse_header({header.file, line.number, std::string(definition_block) + " #:"}, line.text,
                      "the format stands twice", "one line #:LRFI, LDFI, KRBI or KDBI");
      definition.format = format_of(header, line);
      has_format = true;
    } else if (line.text.starts_with("D:") || line.text.starts_with("d:")) {
      definition.channels.push_back(channel_of(header, line));
    } else if (!line.text.starts_with("U:") && !line.text.starts_with("u:")) {
      refuse_header({header.file, line.number, definition_block}, "",
                    fmt::format("\"{}\" defines nothing", shown_part(line.text)),
                    "lines that begin with #: or D: or U:, or * before a comment");
    }
  }
  demand_once(header, definition);
  return definition;
}

}  // namespace rondo::road
