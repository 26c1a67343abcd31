// SPDX-License-Identifier: BSD-3-Clause
/// @file  basis.h5: fields of a body that another run may begin with (docs/results.md).
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

/// Not whole at once: into a folder that becomes what it is later. @param mass (n) [kg/m]
/// @pre a plane mesh. @throws FileError
void write_basis(const std::filesystem::path& file, const mesh::Mesh& mesh,
                 std::span<const double> mass, const Eigen::MatrixXd& field);

/// @throws FileError: missing, damaged, not of this program
[[nodiscard]] Basis read_basis(const std::filesystem::path& file);

/// That write_basis() takes.
[[nodiscard]] std::size_t basis_bytes(const mesh::Mesh& mesh,
                                      const Eigen::MatrixXd& field) noexcept;

}  // namespace rondo::io
