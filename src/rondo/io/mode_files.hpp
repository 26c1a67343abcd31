// SPDX-License-Identifier: BSD-3-Clause
/// @file  Mode shapes: modes.h5 and modes.xdmf (docs/modes.md), with one grid per mode.
#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "rondo/mesh/mesh.hpp"
#include "rondo/modal/modes.hpp"

namespace rondo::io {

/// The modes at one spin.
struct SpinModes {
  double angular_velocity = 0.0;  ///< ω of the case, > 0 rolls towards +x             [rad/s]
  const std::vector<modal::Mode>* modes = nullptr;
};

/// Writes both files, with the modes of all spins one after another, number 1 first.
/// @param mass (n) [kg/m]. @throws FileError
void write_mode_shapes(const std::filesystem::path& directory, const mesh::Mesh& mesh,
                       std::span<const double> mass, std::span<const SpinModes> spins);

}  // namespace rondo::io
