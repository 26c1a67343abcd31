// SPDX-License-Identifier: BSD-3-Clause
/// @file  Ours against expected, row by row.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rondo::study {

enum class Comparison {
  within,    ///< |ours - expected| <= tolerance
  at_most,   ///< ours <= expected
  at_least,  ///< ours >= expected
};

struct PaperRow {
  int figure = 0;        ///< of the paper
  std::string name;      ///< short, unique: "damped-closed-form"
  std::string quantity;  ///< in words
  std::string unit;      ///< "1" where there is none
  double ours = 0.0;
  double expected = 0.0;
  Comparison comparison = Comparison::within;
  double tolerance = 0.0;  ///< of `within`, in the unit
  std::string source;      ///< where the expected value is from, and the tolerance
};

/// False for a value that is not a number.
[[nodiscard]] bool passes(const PaperRow& row) noexcept;

/// "within", "at most", "at least"
[[nodiscard]] const char* name_of(Comparison comparison) noexcept;

[[nodiscard]] nlohmann::ordered_json as_json(const PaperRow& row);

}  // namespace rondo::study
