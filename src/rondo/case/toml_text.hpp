// SPDX-License-Identifier: BSD-3-Clause
/// @file  Values as TOML text that reads back bit for bit.
#pragma once
#include <string>
#include <string_view>

namespace rondo::study {

/// Shortest text that reads back to the same double, always a TOML float (10.0, -0.0, 1e+22).
/// @pre value is finite.
std::string toml_number(double value);

/// A basic string, quoted and escaped. @pre text is UTF-8.
std::string toml_string(std::string_view text);

}  // namespace rondo::study
