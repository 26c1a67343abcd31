// SPDX-License-Identifier: BSD-3-Clause
/// @file  The figures of a validation as a table: for the terminal, as validation.csv, and what
/// else is kept of it (docs/reduced.md, 10).
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "rondo/study/paper/validation.hpp"

namespace rondo::study {

inline constexpr const char* validation_table_name = "validation.csv";
inline constexpr const char* validation_record_name = "validation.json";
inline constexpr const char* validation_format = "rondo validation 1";

/// A column of validation.csv.
struct ValidationColumn {
  std::string_view name, unit, meaning;
  double (*value)(const ValidationFigures&);
};

[[nodiscard]] const std::vector<ValidationColumn>& validation_columns();

/// A header and a row for each run; figures of predictions that failed are "nan".
[[nodiscard]] std::string validation_csv(const ValidationReport& report);

/// A line for each figure, a column for each run.
[[nodiscard]] std::string validation_text(const ValidationReport& report);

/// validation.csv, profiles.csv in the directory of each prediction, and validation.json, last.
/// @throws FileError
void write_validation(const ValidationRequest& request, const ValidationReport& report);

}  // namespace rondo::study
