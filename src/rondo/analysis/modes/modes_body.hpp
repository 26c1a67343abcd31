// SPDX-License-Identifier: BSD-3-Clause
/// @file  The body whose modes are asked for: mesh, masses, and what follows from them alone.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/case/inflation_figures.hpp"
#include "rondo/fem/elasticity.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/fem/viscosity.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::study {

struct ModesBody {
  mesh::Mesh mesh;           ///< of an inflated wheel: of its state
  std::vector<double> mass;  ///< (n) [kg/m], of a wheel in three dimensions [kg]
  std::vector<fem::Material> materials;
  double largest_frequency = 0.0;       ///< an upper bound [rad/s]
  int free = 0;                         ///< bodies that nothing holds
  bool wide_rows = false;               ///< has_wide_rows()
  std::vector<std::string> warnings{};  ///< warnings of the case and the mesh
  // A wheel in three dimensions has these, about the state of the case:
  fem::SolidSector sector{};
  std::vector<fem::ViscousPart<fem::SolidSector>> viscous{};
  std::optional<InflationFigures> inflation{};

  [[nodiscard]] bool cyclic() const noexcept { return mesh.n_sectors > 0; }
  [[nodiscard]] std::size_t components() const noexcept { return mesh.is_solid() ? 3 : 2; }
};

/// @throws InputError
[[nodiscard]] ModesBody make_modes_body(const Case& c);

}  // namespace rondo::study
