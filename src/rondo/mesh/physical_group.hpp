// SPDX-License-Identifier: BSD-3-Clause
/// @file  The line of a Gmsh geometry that defines a physical group, shown to the user in messages.
#pragma once
#include <string>
#include <string_view>

namespace rondo::mesh {

/// "in the .geo: Physical Curve("tread") = {1, 2};"
/// @param kind "Curve" or "Surface"
inline std::string physical_group_line(std::string_view kind, std::string_view name) {
  std::string line = "in the .geo: Physical ";
  line.append(kind).append("(\"").append(name).append("\") = {1, 2};");
  return line +
         (kind == "Curve" ? " with the numbers of its curves" : " with those of its surfaces");
}

}  // namespace rondo::mesh
