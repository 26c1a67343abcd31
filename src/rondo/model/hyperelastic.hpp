// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rubber at finite strain for the general step (docs/rubber.md, sections 2 and 3): one
/// readable pass a term, the reference that the fused step is held to. What is held moves in the
/// turning frame; what nothing holds in the fixed one, without a frame of its own: rotations are no
/// strain.
#pragma once
#include <memory>
#include <span>

#include "rondo/fem/hyperelastic/hyperelasticity.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// For Model::internal_force. Branches are relaxed at u_0. The strain energy of the ledger is what
/// was done against the forces, from the stored energy at u_0 on.
/// @pre of the force: a body that nothing holds is all rubber, and then β = 0
[[nodiscard]] InternalForceMaker hyperelastic_maker(
    std::shared_ptr<const fem::Hyperelasticity> body);

/// For Model::rubber: what the fused step needs of the same. @pre all cells of rubber are
/// quadrilaterals
[[nodiscard]] RubberPart rubber_part(const mesh::Mesh& mesh,
                                     std::span<const fem::Material> materials);

}  // namespace rondo::dynamics
