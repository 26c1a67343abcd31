// SPDX-License-Identifier: BSD-3-Clause
/// @file  The tables of rondo modes, and its modes.json (docs/modes.md).
#pragma once
#include <string>
#include <vector>

#include "rondo/analysis/modes/modes.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {

/// modes.csv.
std::string modes_table(const std::vector<ModeLine>& modes);
/// critical-speeds.csv.
std::string critical_table(const ModesReport& report);
/// campbell.csv. A pair at rest is the limit of a backward and a forward wave, and named so.
/// @param n_sectors 0: not cyclic
std::string campbell_table(const std::vector<ModeLine>& modes, int n_sectors);

/// @param run what run.json says: status and message
Json modes_json(const Case& c, const ModesRequest& request, const ModesReport& report,
                const Json& run);

// run.json of `rondo modes`, besides shared_members(). @param spins asked for
void describe_modes(const ModesReport& report, std::size_t spins, Json& json);
void summarise_modes(const ModesReport& report, Json& json);
std::vector<MemberText> modes_members();

}  // namespace rondo::study
