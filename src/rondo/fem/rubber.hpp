// SPDX-License-Identifier: BSD-3-Clause
/// @file  Parameters of rubber at finite strain: an isotropic law in the isochoric invariants, a
/// volumetric energy and viscous branches (docs/rubber.md, section 1).
#pragma once
#include <array>
#include <vector>

namespace rondo::fem {

enum class RubberLaw {
  neo_hooke,      ///< W = c10 (I₁ - 3), μ = 2 c10
  mooney_rivlin,  ///< W = c10 (I₁ - 3) + c01 (I₂ - 3), μ = 2 (c10 + c01)
  yeoh,           ///< W = c10 (I₁ - 3) + c20 (I₁ - 3)² + c30 (I₁ - 3)³, μ = 2 c10
  ogden,  ///< W = Σ μ_i/α_i (λ₁^α_i + λ₂^α_i + λ₃^α_i - 3), μ = ½ Σ μ_i α_i
};

struct OgdenTerm {
  double modulus = 0.0;   ///< μ_i                                                     [Pa]
  double exponent = 0.0;  ///< α_i                                                      [-]
  bool operator==(const OgdenTerm&) const = default;
};

/// A Maxwell branch parallel to the law: of rubber a neo-Hookean one.
struct ViscousBranch {
  /// g: of rubber relative to the shear modulus of slow strains, of linear materials to both moduli
  double relative_modulus = 0.0;
  double time = 0.0;  ///< τ, of relaxation                                 [s]
  bool operator==(const ViscousBranch&) const = default;
};

/// Invariants I and principal stretches λ belong to C̄ = J^(-2/3) C; U = κ/4 (J² - 1 - 2 ln J).
struct Rubber {
  RubberLaw law = RubberLaw::neo_hooke;
  double c10 = 0.0, c01 = 0.0, c20 = 0.0, c30 = 0.0;  ///< those of the law, others 0 [Pa]
  std::vector<OgdenTerm> terms;                       ///< for "ogden"
  double bulk_modulus = 0.0;                          ///< κ                            [Pa]
  std::vector<ViscousBranch> branches;
  bool one_point = false;  ///< quadrilaterals with one point and covariant hourglass stiffness
  bool operator==(const Rubber&) const = default;

  /// μ at small strain, without branches [Pa]
  [[nodiscard]] double shear_modulus() const noexcept {
    if (law != RubberLaw::ogden) return 2.0 * (c10 + c01);
    double sum = 0.0;
    for (const OgdenTerm& t : terms) sum += 0.5 * t.modulus * t.exponent;
    return sum;
  }
  /// 1 + Σ g: the instantaneous shear modulus over the long-term one [-]
  [[nodiscard]] double instantaneous() const noexcept {
    double sum = 1.0;
    for (const ViscousBranch& b : branches) sum += b.relative_modulus;
    return sum;
  }
};

}  // namespace rondo::fem
