// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a case of steady rolling in three dimensions to its wheel and the harmonics of a
/// sector (docs/wheel3d.md): what does not hang on height, speed, slip angle, camber and friction.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/build/build.hpp"
#include "rondo/statics/steady_solid/solid_window.hpp"

namespace rondo::study {

struct SolidSteadyBody {
  mesh::Mesh mesh;
  std::vector<fem::Material> materials;  ///< one for each region of the mesh
  std::vector<double> mass;              ///< (n) [kg]
  std::size_t dofs = 0;
  fem::SolidSector sector;
  double radius = 0.0;                ///< outer, undeformed [m]
  std::vector<std::string> warnings;  ///< for the user: the caller prints them
  std::optional<statics::SolidHarmonics> harmonics;
  double harmonics_wall_s = 0.0;

  SolidSteadyBody() = default;
  SolidSteadyBody(const SolidSteadyBody&) = delete;  ///< harmonics point into it
  SolidSteadyBody& operator=(const SolidSteadyBody&) = delete;
};

/// Adds harmonics, if they are not there. @pre of this case
/// @param threads 0: chosen by size
void find_harmonics(const Case& c, SolidSteadyBody& body, int threads);

/// That of the run before where it fits, harmonics included; else a new one, which is then kept.
/// @param shared null: nothing is kept
/// @throws InputError: a part of the tread that the rim holds; more memory than there is
[[nodiscard]] std::shared_ptr<SolidSteadyBody> shared_solid_steady_body(const Case& c,
                                                                        SharedBody* shared);

/// At its largest; an estimate [B].
[[nodiscard]] std::size_t steady_memory(const Case& c, const mesh::Mesh& mesh);

}  // namespace rondo::study
