// SPDX-License-Identifier: BSD-3-Clause
/// @file  Isotropic linear elasticity in the plane (docs/theory.md, section 2.2).
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "rondo/fem/rubber.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

enum class Plane { strain, stress };

/// Quadrature of the stiffness. full: 2×2 points of a quadrilateral, one of a triangle. b_bar:
/// these points for the deviator and a mean for the volume, which does not lock near ν = 1/2: the
/// mean over a quadrilateral (Hughes 1980) or over the triangles around a node (NodalDilatation).
enum class Integration { full, b_bar };

struct Material {
  double youngs_modulus = 0.0;  ///< E > 0                                            [Pa]
  double poissons_ratio = 0.0;  ///< -1 < ν < 1/2                                     [-]
  double density = 0.0;         ///< ρ > 0                                            [kg/m3]
  Plane plane = Plane::strain;
  Integration integration = Integration::full;
  /// The law at finite strain; E and ν then describe its small strains without viscous branches.
  std::optional<Rubber> rubber{};
  std::vector<ViscousBranch> branches{};  ///< of a linear material, relative to E
  /// Its resistance against a change of volume is left out: a viscous branch of rubber, with B-bar.
  bool only_shear = false;
};

/// The material of cell `cell`. @param materials one for each of mesh.region_names; one for all if
/// mesh.region is empty.
const Material& material_of(const mesh::Mesh& mesh, std::span<const Material> materials,
                            std::size_t cell);

/// Whether at least one material is rubber at finite strain.
[[nodiscard]] bool has_rubber(std::span<const Material> materials) noexcept;
/// Whether at least one material has viscous branches.
[[nodiscard]] bool has_branches(std::span<const Material> materials) noexcept;
/// Linear materials with the same instantaneous stiffness: with all branches, which of rubber add
/// to its shear modulus and not to its bulk modulus. Used for critical time steps.
[[nodiscard]] std::vector<Material> instantaneous(std::span<const Material> materials);

/// σ = D ε with ε = (ε_xx, ε_yy, γ_xy), D = [[d11, d12, 0], [d12, d11, 0], [0, 0, d33]].
struct Hooke {
  double d11 = 0.0;  ///< λ + 2μ (plane strain), E/(1-ν²) (plane stress)               [Pa]
  double d12 = 0.0;  ///< [Pa]
  double d33 = 0.0;  ///< shear modulus                                                [Pa]
  double zz = 0.0;   ///< σ_zz = zz (σ_xx + σ_yy): ν in plane strain, 0 in plane stress [-]
};

Hooke hooke(const Material& material) noexcept;

/// Stress in an element: D ε at the point, plus the bulk modulus times the element's mean
/// volumetric strain on xx, yy, zz. With full integration D contains everything. With B-bar D is
/// that of the deviator, which has no trace: zz = -1 (docs/theory.md, 2.3). In plane stress the
/// thickness is free to change, nothing locks, and B-bar equals full integration.
struct ElementLaw {
  Hooke point;
  double mean_bulk = 0.0;  ///< [Pa]
};

ElementLaw element_law(const Material& material) noexcept;

struct WaveSpeeds {
  double pressure = 0.0;  ///< √(d11/ρ) [m/s]
  double shear = 0.0;     ///< √(d33/ρ) [m/s]
};

WaveSpeeds wave_speeds(const Material& material) noexcept;

}  // namespace rondo::fem
