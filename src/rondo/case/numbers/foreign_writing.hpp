// SPDX-License-Identifier: BSD-3-Clause
/// @file  What looks like a number or a quoted text and is none, as spreadsheets, word processors
/// and Fortran write them: named as the cause of a fault.
#pragma once
#include <string>
#include <string_view>

namespace rondo::study {

/// Says what is foreign in the writing of a value, and what to write instead: a decimal comma, an
/// exponent with D, or a character beyond ASCII that stands for a minus, a quotation mark, a space,
/// a comma or a point. Empty: nothing is.
std::string foreign_writing(std::string_view value);

/// What foreign_writing() finds in a line of TOML outside its strings and comments.
std::string foreign_writing_in_line(std::string_view line);

/// foreign_writing() behind what is wrong with a value: "; it has ..."; empty: none.
std::string cause_in(std::string_view value);

/// Where items are more or fewer than there must be: a comma between two digits may be meant as the
/// point of a number. To be added to the message; empty: there is none.
std::string cause_in_items(std::string_view written);

/// A number may begin so, with a minus that is not ASCII's.
bool begins_with_foreign_minus(std::string_view text);

}  // namespace rondo::study
