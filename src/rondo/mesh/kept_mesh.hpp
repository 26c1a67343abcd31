// SPDX-License-Identifier: BSD-3-Clause
/// @file  A Gmsh mesh as a file that is read without rondo-mesh-reader: a line with the version of
/// the Gmsh format, then what that program wrote (gmsh_stream.hpp), in this machine's number
/// format. FMUs carry it along.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "rondo/mesh/gmsh_raw.hpp"

namespace rondo::mesh {

struct KeptMesh {
  RawMesh mesh;
  bool version_22 = false;  ///< of the Gmsh format
};

/// The bytes of such a file. @throws InputError, FileError: the Gmsh file cannot be read
[[nodiscard]] std::string keep_mesh(const std::filesystem::path& gmsh_file);

/// None: the file does not begin as such a file. @throws InputError: it does, and is damaged
[[nodiscard]] std::optional<KeptMesh> read_kept_mesh(const std::filesystem::path& file);

}  // namespace rondo::mesh
