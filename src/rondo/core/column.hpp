// SPDX-License-Identifier: BSD-3-Clause
/// @file  Tables of results: one row holds the name of a column,
/// its unit, its meaning and the source of its numbers. Header,
/// values, units for readers and the manual follow from these rows.
#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rondo {

template <class Record>
struct Column {
  std::string_view name, unit, meaning;  ///< unit "1": none; meaning in Markdown, for the manual
  double (*value)(const Record&);
};

/// A column without its values.
struct ColumnLabel {
  std::string name, unit, meaning;
};

template <class Record>
std::vector<ColumnLabel> labels_of(std::span<const Column<Record>> columns) {
  std::vector<ColumnLabel> labels;
  for (const Column<Record>& c : columns)
    labels.push_back({std::string(c.name), std::string(c.unit), std::string(c.meaning)});
  return labels;
}

/// Appends the values of a record, in the order of the columns.
template <class Record>
void append_values(std::span<const Column<Record>> columns, const Record& record,
                   std::vector<double>& values) {
  for (const Column<Record>& c : columns) values.push_back(c.value(record));
}

/// Header of a CSV file.
inline std::vector<std::string> names_of(std::span<const ColumnLabel> labels) {
  std::vector<std::string> names;
  for (const ColumnLabel& label : labels) names.push_back(label.name);
  return names;
}

/// The unit in three dimensions of a quantity whose unit for a plane body is `plane`: masses,
/// forces and energies of a plane body are per metre of width. Units without a width remain.
constexpr std::string_view unit_of(std::string_view plane, bool is_solid) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 11> units{{
      {"kg/m", "kg"},
      {"kg m", "kg m2"},
      {"N/m", "N"},
      {"N·m/m", "N·m"},
      {"N*s/m", "N*s"},
      {"N/m2", "N/m"},
      {"N s/m2", "N s/m"},
      {"J/m", "J"},
      {"W/m", "W"},
      {"N", "N m"},      // a torque
      {"N*s", "N*m*s"},  // the impulse of a torque
  }};
  if (is_solid)
    for (const auto& [of_plane, of_solid] : units)
      if (of_plane == plane) return of_solid;
  return plane;
}

}  // namespace rondo
