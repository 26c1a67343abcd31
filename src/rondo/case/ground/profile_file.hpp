// SPDX-License-Identifier: BSD-3-Clause
/// @file  The profile of the ground from a CSV file with two columns, x and y in m (docs/cases.md,
/// [ground]).
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::study {

/// The points are written to case.toml of the results, whose length is limited.
inline constexpr std::size_t most_profile_points = 100'000;

struct ProfileFile {
  std::vector<Vec2> points;   ///< as in the file; not checked as a profile here [m]
  std::vector<int> lines;     ///< line of each point, from 1
  std::vector<Fault> faults;  ///< the first few; if there are any, `points` is empty
};

/// A road file is the value of another key. @throws InputError for an OpenCRG file, by its name,
/// because its text may be longer than the limit
void refuse_road(const std::filesystem::path& file);

/// Lines of two numbers separated by a comma or white space. `#` begins a comment; the first line
/// may be a header without numbers. @param name  of the file, for its faults
ProfileFile parse_profile(const std::string& name, std::string_view text);

}  // namespace rondo::study
