// SPDX-License-Identifier: BSD-3-Clause
/// @file  The ground's profile from a CSV file: two columns, x and y in m (docs/cases.md,
/// [ground]).
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::study {

/// They stand in the case.toml of the results, which has an end to its length.
inline constexpr std::size_t most_profile_points = 100'000;

struct ProfileFile {
  std::vector<Vec2> points;   ///< as they stand: whether they make a ground is not asked here [m]
  std::vector<int> lines;     ///< of the points, from 1
  std::vector<Fault> faults;  ///< the first few; there are points only where there are none
};

/// What other tools call a road is none of these files. @throws InputError: an OpenCRG file by its
/// name, whose text may be longer than is read
void refuse_road(const std::filesystem::path& file);

/// Lines of two numbers with a comma or white space between them. `#` begins a comment; the first
/// line may be a header, in which nothing is a number. @param name  of the file, for its faults
ProfileFile parse_profile(const std::string& name, std::string_view text);

}  // namespace rondo::study
