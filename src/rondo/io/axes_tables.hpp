// SPDX-License-Identifier: BSD-3-Clause
/// @file  Tables of forces in other axes beside history.csv and results.csv, which the Python
/// package writes: `rondo axes`, and --axes of `rondo run` and `rondo sweep` (docs/conventions.md).
#pragma once
#include <array>
#include <filesystem>
#include <string_view>

namespace rondo::io {

/// The systems of axes, as in rondo.axes.SYSTEMS of the package.
inline constexpr std::array<std::string_view, 7> axes_names{
    "rondo", "iso-w", "tydex-h", "tydex-c", "sae", "adapted-sae", "tydex-w"};

/// Removes those of a table that is written anew, because they would tell of the one before.
/// @param table  "history" or "results". @throws FileError
void remove_axes_tables(const std::filesystem::path& directory, std::string_view table);

}  // namespace rondo::io
