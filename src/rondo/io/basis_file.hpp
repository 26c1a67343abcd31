// SPDX-License-Identifier: BSD-3-Clause
/// @file  basis.h5: fields of a body with which another run may start (docs/results.md).
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <span>

#include "rondo/mesh/mesh.hpp"

namespace rondo::io {

struct Basis {
  mesh::Mesh mesh;        ///< without `clamped`
  Eigen::MatrixXd field;  ///< (2n, b) x, y of each node; b may be 0            [m (J/m)^(-1/2)]
};

/// The file is not written atomically: it belongs in a folder that is renamed once complete.
/// @param mass (n) [kg/m] @pre a plane mesh. @throws FileError
void write_basis(const std::filesystem::path& file, const mesh::Mesh& mesh,
                 std::span<const double> mass, const Eigen::MatrixXd& field);

/// @throws FileError: missing, damaged, not from this program
[[nodiscard]] Basis read_basis(const std::filesystem::path& file);

/// Size in bytes of the file of write_basis().
[[nodiscard]] std::size_t basis_bytes(const mesh::Mesh& mesh,
                                      const Eigen::MatrixXd& field) noexcept;

}  // namespace rondo::io
