// SPDX-License-Identifier: BSD-3-Clause
/// @file  Whether the numbers of a case are those of a body in SI units, and small strains: figures
/// for `rondo check`, and warnings by them (docs/cases.md, Physical figures).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/build/crush/crush_setup.hpp"
#include "rondo/case/setup.hpp"

namespace rondo::study {

// Bounds that no body of rubber, plastic, metal or foam passes: beyond them there is a warning.
inline constexpr double fast_share = 0.5;      ///< share of the slowest shear wave
inline constexpr double deep_share = 0.2;      ///< deflection over thickness
inline constexpr double wide_slip = 0.5;       ///< |slip ratio| where rim and center both move
inline constexpr double slow_sound = 5.0;      ///< sqrt(E/ρ) [m/s]
inline constexpr double fast_sound = 3e4;      ///< sqrt(E/ρ) [m/s]
inline constexpr double least_density = 10.0;  ///< for a material of at least soft_modulus [kg/m3]
inline constexpr double soft_modulus = 1e4;    ///< [Pa]
inline constexpr double largest_density = 2.5e4;  ///< [kg/m3]
inline constexpr double largest_size = 10.0;      ///< half the length of the mesh [m]
inline constexpr double least_size = 1e-4;        ///< half the length of the mesh [m]

/// A round body on a rim: outer radius, and how much of it is not rim [m].
struct Wall {
  double radius = 0.0, thickness = 0.0;
};
/// None where nothing is held, or it is not round.
[[nodiscard]] std::optional<Wall> wall_of(const mesh::Mesh& mesh);

/// Warns of materials and size alone: before modes as well.
void warn_of_units(const Case& c, const mesh::Mesh& mesh,
                   const std::vector<fem::Material>& materials, std::vector<std::string>& warnings);

struct PhysicalFigures {
  std::vector<Told> figures;
  std::vector<std::string> warnings;
};

/// About how hard the wall of a wheel that its tables press down is pressed, as
/// tell_physical_figures() tells it; none: of tyres with air, of loads, and where nothing is
/// pressed down [Pa]
[[nodiscard]] std::optional<double> estimated_pressure(const Case& c, const Setup& s);

/// Fills figures and warnings, but those of units. @pre the fields of the start are set
void tell_physical_figures(const Case& c, Setup& s);
/// With those of units.
void tell_physical_figures(const Case& c, CrushSetup& s);

/// A body on a rim, inflated or not.
struct RoundBody {
  const mesh::Mesh& mesh;
  const std::vector<fem::Material>& materials;
  const std::optional<InflationFigures>& inflation;
};
/// Tells the figures that a steady case gives: no deflection under a load but that of a tyre, no
/// slip ratio under a traction or torque, and no warnings of units.
void tell_physical_figures(const Case& c, const RoundBody& body, PhysicalFigures& told);
/// Tells the figures that the crush of a wheel gives, and no warnings of units.
void tell_physical_figures(const Case& c, const RoundBody& body, const CrushPath& path,
                           PhysicalFigures& told);

}  // namespace rondo::study
