// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a case of steady rolling to its body and the harmonics of a sector
/// (docs/theory.md, 11.1): what does not hang on height, speed and friction.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/build/build.hpp"
#include "rondo/statics/steady/rolling_window.hpp"

namespace rondo::study {

struct SteadyBody {
  mesh::Mesh mesh;
  std::vector<fem::Material> materials;  ///< one for each region of the mesh
  std::vector<double> mass;              ///< (n) [kg/m]
  std::vector<int> free;
  fem::SectorStiffness sector;
  std::vector<std::string> warnings;  ///< for the user: the caller prints them
  std::optional<statics::RollingHarmonics> harmonics;
  std::optional<statics::RollingWindow> window;  ///< without pairs: to be copied
  double harmonics_wall_s = 0.0;

  SteadyBody() = default;
  SteadyBody(const SteadyBody&) = delete;  ///< harmonics and window point into it
  SteadyBody& operator=(const SteadyBody&) = delete;
};

/// Without harmonics and window. @throws InputError: layers that coincide in round-off, a curve
/// that is held, more memory than there is
[[nodiscard]] std::shared_ptr<SteadyBody> make_steady_body(const Case& c);

/// Adds harmonics and window, if they are not there. @pre of this case
/// @param threads 0: chosen by size
void find_harmonics(const Case& c, SteadyBody& body, int threads = 1);

/// That of the run before where it fits, harmonics included; else a new one, which is then kept.
/// @param shared null: nothing is kept
[[nodiscard]] std::shared_ptr<SteadyBody> shared_steady_body(const Case& c, SharedBody* shared);

/// At its largest; an estimate [B].
[[nodiscard]] std::size_t steady_memory(const Case& c, const SteadyBody& body);

}  // namespace rondo::study
