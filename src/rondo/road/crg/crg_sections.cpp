// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/crg/crg_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace rondo::road {
namespace {

/// The reference implementation refuses closer ones too.
constexpr double closest_sections = 1e-6;  // [m]
/// Positions in text have four digits or more.
constexpr double position_tolerance = 1e-4;  // [m]
constexpr const char* right_key = "LONG_SECTION_V_RIGHT";
constexpr const char* left_key = "LONG_SECTION_V_LEFT";
constexpr const char* increment_key = "LONG_SECTION_V_INCREMENT";

bool is_section(const CrgChannel& channel) noexcept {
  return channel.column == CrgColumn::section_at || channel.column == CrgColumn::section_number;
}

/// Columns of the sections, by ascending v or number.
std::vector<std::size_t> sorted_sections(const CrgDefinition& definition) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < definition.channels.size(); ++k)
    if (is_section(definition.channels[k])) found.push_back(k);
  std::ranges::stable_sort(found, {}, [&](std::size_t k) { return definition.channels[k].value; });
  return found;
}

HeaderPlace place_of(const CrgValues& road, const CrgChannel& channel) {
  return {road.file, channel.line, "$KD_DEFINITION D:"};
}

void demand_one_form(const CrgDefinition& definition, const std::vector<std::size_t>& sections,
                     const CrgValues& road) {
  if (sections.size() < 2)
    refuse_header({road.file, 0, "$KD_DEFINITION D:"}, "",
                  fmt::format("the file defines {} long sections", sections.size()),
                  "two or more, or $ROAD_CRG_FILE with the file that has them");
  const CrgColumn form = definition.channels[sections.front()].column;
  for (const std::size_t k : sections)
    if (definition.channels[k].column != form)
      refuse_header(place_of(road, definition.channels[k]), definition.channels[k].text,
                    "other long sections are named in the other form",
                    "all by \"at v = POSITION\", or all by numbers");
}

/// Compares a border of the header with that of the sections.
void demand_border(const CrgValues& road, const char* key, double v) {
  const std::optional<double> given = road.real(key);
  if (given && std::abs(*given - v) > position_tolerance)
    road.refuse(key, fmt::format("the outermost long section is at v = {} m", v),
                "the same position in both places");
}

std::vector<double> positions_by_number(const CrgDefinition& definition,
                                        const std::vector<std::size_t>& sections,
                                        const CrgValues& road) {
  const auto n = static_cast<double>(sections.size());
  for (std::size_t j = 0; j < sections.size(); ++j)
    if (definition.channels[sections[j]].value != static_cast<double>(j + 1))
      refuse_header(place_of(road, definition.channels[sections[j]]),
                    definition.channels[sections[j]].text,
                    fmt::format("the number {} of the {} long sections is missing, or stands twice",
                                j + 1, sections.size()),
                    "each number from 1 to that of the sections, once");
  const auto right = road.real(right_key), left = road.real(left_key);
  const auto given = road.real(increment_key);
  if (!given && !(right && left))
    road.refuse(increment_key, "the long sections have numbers, and nothing says where they are",
                "a value in $ROAD_CRG, or positions in the lines D:");
  const double step = given ? *given : (*left - *right) / (n - 1.0);
  if (!(step >= closest_sections))
    road.refuse(given ? increment_key : left_key, "the sections do not lie from right to left",
                "an increment of 1e-6 m or more, and a left border above the right one");
  const double first = right ? *right : left ? *left - (n - 1.0) * step : -0.5 * (n - 1.0) * step;
  std::vector<double> v(sections.size());
  for (std::size_t j = 0; j < v.size(); ++j) v[j] = first + static_cast<double>(j) * step;
  if (!given) v.back() = *left;
  return v;
}

}  // namespace

CrgSections crg_sections(const CrgDefinition& definition, const CrgValues& road) {
  CrgSections sections{{}, sorted_sections(definition)};
  demand_one_form(definition, sections.channel, road);
  const auto& channels = definition.channels;
  if (channels[sections.channel.front()].column == CrgColumn::section_number)
    sections.v = positions_by_number(definition, sections.channel, road);
  else
    for (const std::size_t k : sections.channel) sections.v.push_back(channels[k].value);
  for (std::size_t j = 0; j + 1 < sections.v.size(); ++j)
    if (!(sections.v[j + 1] - sections.v[j] >= closest_sections))
      refuse_header(place_of(road, channels[sections.channel[j + 1]]),
                    channels[sections.channel[j + 1]].text,
                    "another long section is at the same place, or closer than 1e-6 m",
                    "sections at different places");
  demand_border(road, right_key, sections.v.front());
  demand_border(road, left_key, sections.v.back());
  return sections;
}

}  // namespace rondo::road
