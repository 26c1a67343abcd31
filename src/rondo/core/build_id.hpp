// SPDX-License-Identifier: BSD-3-Clause
/// @file  Which program this is, to the bit: results of another one are not taken for its own.
#pragma once
#include <string>

namespace rondo {

/// The linker's hash of the running program (its GNU build id), in hexadecimal; empty where it was
/// linked without.
[[nodiscard]] std::string build_id();

}  // namespace rondo
