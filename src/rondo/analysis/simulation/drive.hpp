// SPDX-License-Identifier: BSD-3-Clause
/// @file  Motion and loads of a case that are set while it runs: its tables in time, led over to a
/// new value.
#pragma once
#include <string>
#include <vector>

#include "rondo/case/case.hpp"

namespace rondo::study {

/// Keys of the case that have a table in time, e.g. "rim.brake", "load.pressure[0].value".
[[nodiscard]] std::vector<std::string> driven_keys(const Case& c);

/// From `from` to `to` linearly to the value, which stays; points of the table from `from` on are
/// dropped. Before `from` the table is what it was, to the bit where it was constant there, else to
/// round-off.
/// @pre from < to                                                                       [s]
[[nodiscard]] dynamics::Table led_over(const dynamics::Table& table, double from, double to,
                                       double value);

/// The table of a key of driven_keys(). @throws InputError: it is none of them, which are named
[[nodiscard]] dynamics::Table& driven_table(Case& c, const std::string& key);

/// Finds it for a value that it is to have. @throws InputError: the value is not allowed there
[[nodiscard]] dynamics::Table& driven_table(Case& c, const std::string& key, double value);

}  // namespace rondo::study
