// SPDX-License-Identifier: BSD-3-Clause
/// @file  The kinds of analysis that a case may request, one row each: the value of analysis.kind
/// and its rules for other keys. analysis/registry.cpp has the analyses in the same order.
#pragma once
#include <cstddef>
#include <iterator>
#include <string_view>

namespace rondo::study {

struct Case;
class CaseValues;

enum class AnalysisKind { dynamic, crush, steady_rolling, inflation };

void check_crush(CaseValues& in, Case& c);
void check_steady_rolling(CaseValues& in, Case& c);
void check_inflation_alone(CaseValues& in, Case& c);

struct KindOfCase {
  std::string_view name;
  void (*check)(CaseValues& in, Case& c);  ///< collects faults in `in`; null: no rules of its own
  std::string_view why_left_out;           ///< why keys of others have no meaning; "": all have
  bool in_time = false;                    ///< whether the body moves step by step
  std::string_view height_key = "motion.height";  ///< the key that gives the height of the center
};

inline constexpr KindOfCase analysis_kinds[] = {
    {"dynamic", nullptr, "", true},
    {"crush", check_crush, "a crush is quasi-static, its ground flat", false, "analysis.depth"},
    {"steady-rolling", check_steady_rolling, "steady rolling has no start, no end and no impacts"},
    {"inflation", check_inflation_alone, "an inflation is an equilibrium off the ground", false,
     "motion.height"},
};

constexpr const KindOfCase& rules_of(AnalysisKind kind) noexcept {
  return analysis_kinds[static_cast<std::size_t>(kind)];
}

}  // namespace rondo::study
