// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/crg/crg_columns.hpp"

#include <fmt/format.h>

#include <cmath>

#include "rondo/core/error.hpp"

namespace rondo::road {
namespace {

/// Slopes and banking are at most 1, as for the tools of OpenCRG.
constexpr double steepest_line = 1.0;

[[noreturn]] void refuse_row(const std::string& file, std::size_t i, const std::string& what) {
  throw FileError(file, fmt::format("row {} of the data: {}", i + 1, what));
}

void demand_sound_row(std::span<const double> row, const CrgSections& sections,
                      const std::string& file, std::size_t i) {
  std::size_t begin = 0, end = row.size();
  while (begin < end && std::isnan(row[begin])) ++begin;
  if (begin == end)
    refuse_row(file, i,
               "all heights are missing; OpenCRG wants at least one valid height in each row");
  while (std::isnan(row[end - 1])) --end;
  for (std::size_t j = begin; j < end; ++j)
    if (std::isnan(row[j]))
      refuse_row(
          file, i,
          fmt::format("the height at v = {:.6g} m is missing between valid ones; OpenCRG allows "
                      "missing heights at the edges only: fill it",
                      sections.v[j]));
}

/// The first slope belongs to no stretch.
void demand_sound_line(std::span<const double> values, std::size_t first, const char* name,
                       const std::string& file) {
  for (std::size_t i = first; i < values.size(); ++i)
    if (!(std::abs(values[i]) <= steepest_line))
      refuse_row(file, i,
                 fmt::format("the {} of the reference line is {}, which is missing or above 1",
                             name, values[i]));
}

}  // namespace

void add_crg_row(const CrgDefinition& definition, const CrgSections& sections,
                 std::span<const double> row, CrgColumns& columns) {
  for (const std::size_t k : sections.channel) columns.heights.push_back(row[k]);
  for (std::size_t k = 0; k < row.size(); ++k) {
    const CrgColumn column = definition.channels[k].column;
    if (column == CrgColumn::heading) columns.heading.push_back(row[k]);
    if (column == CrgColumn::banking) columns.banking.push_back(row[k]);
    if (column == CrgColumn::slope) columns.slope.push_back(row[k]);
    if (column == CrgColumn::position) columns.position.push_back(row[k]);
  }
}

void demand_sound_columns(const CrgColumns& columns, const CrgSections& sections,
                          const std::string& file) {
  const std::size_t n_v = sections.v.size();
  for (std::size_t i = 0; i * n_v < columns.heights.size(); ++i)
    demand_sound_row(std::span(columns.heights).subspan(i * n_v, n_v), sections, file, i);
  demand_sound_line(columns.slope, 1, "slope", file);
  demand_sound_line(columns.banking, 0, "banking", file);
}

}  // namespace rondo::road
