// SPDX-License-Identifier: BSD-3-Clause
/// @file  The state about which a wheel in three dimensions is linear: undeformed, or inflated.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/build/tyre/inflated_wheel.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/fem/viscosity.hpp"
#include "rondo/model/model.hpp"

namespace rondo::study {

struct WheelAtRest {
  std::vector<double> mass;  ///< (n) [kg]
  fem::SolidSector sector;
  double frequencies_below = 0.0;  ///< upper bound of ω² [1/s²]
  /// (n_local) the rest of the forces on the nodes of a row, which K u does not have: -s0² m P x of
  /// an inflated wheel, balanced by its spin s0. In the frame of the sector. Empty: none [N]
  std::vector<Vec3> load;
  std::optional<InflationFigures> inflation;   ///< none: undeformed
  std::optional<dynamics::SweptPart> swept{};  ///< none: the motion is linear
  /// K of the stiffest motion, whose bound is then `frequencies_below`: with all cords as stiff as
  /// in tension, where they are nonlinear and some of them resist compression less, and with all
  /// viscous branches. Empty: there is neither.
  std::optional<fem::SolidSector> stiffest{};
  std::vector<fem::ViscousPart<fem::SectorBlocks<3>>>
      viscous{};  ///< relaxed at rest; empty: no material has branches
};

/// If the case has [inflation], this moves the mesh to its equilibrium and takes the laws of rubber
/// out of the materials: strains are then small ones, from the equilibrium on. @throws InputError
[[nodiscard]] WheelAtRest wheel_at_rest(const Case& c, mesh::Mesh& mesh,
                                        std::vector<fem::Material>& materials,
                                        fem::ViscousBy by = fem::ViscousBy::material);

}  // namespace rondo::study
