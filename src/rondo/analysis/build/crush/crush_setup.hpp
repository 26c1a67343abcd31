// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a crush case to what its run needs (docs/theory.md, 6.4).
#pragma once
#include <string>

#include "rondo/analysis/build/crush/crush_path.hpp"
#include "rondo/case/setup.hpp"
#include "rondo/statics/crush.hpp"

namespace rondo::study {

struct CrushSetup {
  CrushPath path;
  mesh::Mesh mesh;
  std::vector<fem::Material> materials;  ///< one for each region of the mesh
  std::vector<double> mass;              ///< (n) [kg/m]
  std::vector<int> free;
  statics::CrushModel model;
  double ground_height = 0.0;  ///< y of the ground                                      [m]
  double touch_height = 0.0;   ///< height of the center over the ground at first touch  [m]
  double reach = 0.0;          ///< largest clearance of the candidates condensed at first [m]
  std::size_t within_reach = 0;
  std::vector<Told> figures;          ///< figures of a physical kind, for `rondo check`
  std::vector<std::string> warnings;  ///< for the user: the caller prints them

  [[nodiscard]] std::size_t n_dofs() const noexcept { return 2 * free.size(); }
  [[nodiscard]] Vec2 center(const statics::CrushState& state) const noexcept {
    return {state.slide, ground_height + touch_height - state.depth};
  }
};

/// Mesh and contact, without the stiffness. @throws InputError: layers that coincide in round-off,
/// more memory than there is.
/// @pre c is a crush
CrushSetup build_crush(const Case& c);

/// At its largest, with the candidates within reach condensed; an estimate [B].
std::size_t crush_memory(const Case& c, const CrushSetup& setup);

/// The stiffness condensed on the candidates within reach. @throws InputError: not definite
void condense(const Case& c, const CrushSetup& setup, statics::Condensation& body);

/// The trouble after an increment; empty while all is well. @param bound of the law's residual
[[nodiscard]] std::string crush_trouble(const statics::CrushReport& report,
                                        const statics::CrushWorks& works, double bound);

/// The trouble where an increment of rubber was not solved.
[[nodiscard]] std::string rubber_not_solved(const statics::CrushReport& report);

}  // namespace rondo::study
