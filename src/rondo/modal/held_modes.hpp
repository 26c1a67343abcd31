// SPDX-License-Identifier: BSD-3-Clause
/// @file  Modes at rest of a body of N equal sectors of which the ground, or anything else, holds
/// some nodes too: it is then no longer cyclic, but its equations differ from cyclic ones by a few
/// constraints H φ = 0 alone. With A = M^-½ K M^-½, solved harmonic by harmonic,
///   T = A⁻¹ - A⁻¹ Hᵀ (H A⁻¹ Hᵀ)⁻¹ H A⁻¹                                                   (8.8)
/// has the eigenvalues 1/ω². The number of frequencies below σ is that of the body that nothing
/// holds, less the number of negative eigenvalues of H (A - σ²)⁻¹ Hᵀ: no mode is missed.
#pragma once
#include <span>
#include <type_traits>

#include "rondo/modal/modes.hpp"

namespace rondo::modal {

/// A node that does not move along a direction.
template <int D>
struct HeldDirection {
  std::size_t node = 0;                                ///< of the mesh, not clamped
  std::conditional_t<D == 2, Vec2, Vec3> direction{};  ///< of length 1, in the axes of X
};

/// The `count` lowest modes; waves and diameters are not known. @pre the body is clamped, the
/// directions at a node are orthonormal
template <int D>
[[nodiscard]] Modes held_modes(const CyclicBody<D>& body, std::span<const HeldDirection<D>> held,
                               int count);

/// ‖Q (K - ω²M) φ‖ / ‖Q K φ‖, where Q takes out what acts along held directions; or how far a mode
/// moves along one, over its largest component, if that is larger.
template <int D>
[[nodiscard]] double residual(const CyclicBody<D>& body, std::span<const HeldDirection<D>> held,
                              const Mode& mode);

}  // namespace rondo::modal
