// SPDX-License-Identifier: BSD-3-Clause
/// @file  Detects text that looks like a number or a quoted text but is not valid, as written by
/// spreadsheets, word processors and Fortran, in order to name it as the cause of a fault.
#pragma once
#include <string>
#include <string_view>

namespace rondo::study {

/// Says what is foreign in a value and what to write instead: a decimal comma, an exponent with D,
/// or a non-ASCII character for a minus, a quotation mark, a space, a comma or a point. Empty:
/// nothing is foreign.
std::string foreign_writing(std::string_view value);

/// The result of foreign_writing() for a line of TOML, without its strings and comments.
std::string foreign_writing_in_line(std::string_view line);

/// foreign_writing() as an addition to a message: "; it has ..."; empty: nothing is foreign.
std::string cause_in(std::string_view value);

/// An addition to the message if the number of items is wrong: a comma between two digits may be
/// meant as a decimal point. Empty: there is none.
std::string cause_in_items(std::string_view written);

/// Whether the text may begin a number with a minus other than that of ASCII.
bool begins_with_foreign_minus(std::string_view text);

}  // namespace rondo::study
