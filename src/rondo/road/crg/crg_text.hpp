// SPDX-License-Identifier: BSD-3-Clause
/// @file  Words and numbers of OpenCRG files, and faults of them.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace rondo::road {

[[nodiscard]] std::string_view without_blanks(std::string_view text) noexcept;
/// ASCII letters only: keywords have no others.
[[nodiscard]] std::string upper_case(std::string_view text);
/// Part of a file for a message: shortened, in ASCII.
[[nodiscard]] std::string shown_part(std::string_view text);
/// A finite number; an exponent may be written with D, or with its sign before the letter. None:
/// the text is not one.
[[nodiscard]] std::optional<double> crg_number(std::string_view text);

/// Where a fault of a header is.
struct HeaderPlace {
  std::string file;
  int line = 0;     ///< from 1; 0: of the whole file
  std::string key;  ///< block and key, "$ROAD_CRG REFERENCE_LINE_INCREMENT"
};

/// @throws InputError
[[noreturn]] void refuse_header(const HeaderPlace& place, std::string_view found,
                                const std::string& message, const std::string& allowed = "");

}  // namespace rondo::road
