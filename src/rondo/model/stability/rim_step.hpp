// SPDX-License-Identifier: BSD-3-Clause
/// @file  Critical step of a body on a rim moved by forces (docs/theory.md, 10). With absolute
/// coordinates of nodes and rim the mass matrix is diagonal, and the largest eigenvalue of a
/// positive semidefinite matrix is at most the sum of those of its diagonal blocks: of the body
/// with its rim fixed, and of the rim with the body fixed.
#pragma once
#include <array>
#include <functional>
#include <limits>
#include <span>

#include "rondo/core/vec2.hpp"
#include "rondo/model/stability/critical_step.hpp"

namespace rondo::dynamics {

/// The degrees of freedom x, y and θ of a rim.
struct RimDofs {
  static constexpr double held = std::numeric_limits<double>::infinity();
  /// M, M [kg/m] and I [kg·m], including bonded nodes; `held` if prescribed.
  std::array<double, 3> inertia{held, held, held};
  std::array<double, 2> spring{};  ///< stiffness of the supports along x and y [N/m²]
};

/// Largest eigenvalues of D^-½ Gᵀ A G D^-½, D the inertia of the rim; 0 if it is prescribed.
struct RimValues {
  double translation = 0.0;  ///< the larger one of x and y
  double rotation = 0.0;     ///< of θ
  double largest = 0.0;      ///< of all three, which are coupled if the body is not symmetric
};

struct RimFrequencies {
  RimValues stiffness;  ///< A = K and the springs: squared frequencies with the body fixed [1/s²]
  /// A = M of the free nodes. α damps velocities relative to the rim. A light rim moves faster
  /// against the body; the damping then counts (1 + this) times α [-]
  RimValues mass;
};

/// out = K u, both (n); clamped nodes give 0.
using StiffnessProduct = std::function<void(std::span<const Vec2> u, std::span<Vec2> out)>;

/// G = (e_x, e_y, JX) on the free nodes. @param mass (n) [kg/m], reference (n) X [m]
RimFrequencies rim_frequencies(const StiffnessProduct& k, std::span<const double> mass,
                               std::span<const Vec2> reference, std::span<const int> free,
                               const RimDofs& rim);

/// ω̂² = ω_c² + the largest of the rim, α̂ = α (1 + that of the masses), on any mesh: the bound is
/// valid for K as well as for K Δt/2 + α M. @param held the critical step with the rim fixed
CriticalStep with_rim(const CriticalStep& held, const RimFrequencies& rim, LaggedDamping damping);

/// On a body of equal sectors, translations couple only with harmonic 1 and the rotation only with
/// harmonic 0: ω̂² = max(ω_c², ω_{c,1}² + k_x/M, ω_{c,0}² + k_θ/I). The step is the smallest of the
/// three, each with its own α̂. @param mass (n) of all nodes of the mesh
CriticalStep with_rim(const CriticalStep& held, const fem::SectorStiffness& k,
                      std::span<const double> mass, const RimFrequencies& rim,
                      LaggedDamping damping);

}  // namespace rondo::dynamics
