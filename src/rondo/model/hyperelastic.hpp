// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rubber at finite strain for the general step (docs/rubber.md, sections 2 and 3): one
/// readable pass per term, the reference for the fused step. Constrained bodies move in the
/// rotating frame, unconstrained ones in the fixed frame without a frame of their own, because
/// rotations cause no strain.
#pragma once
#include <memory>
#include <span>

#include "rondo/fem/hyperelastic/hyperelasticity.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Makes Model::internal_force. Branches are relaxed at u_0. The strain energy in the ledger is the
/// stored energy at u_0 plus the work done against the forces since then.
/// @pre of the force: an unconstrained body is all rubber, and then β = 0
[[nodiscard]] InternalForceMaker hyperelastic_maker(
    std::shared_ptr<const fem::Hyperelasticity> body);

/// Makes Model::rubber: the data that the fused step needs of it. @pre all cells of rubber are
/// quadrilaterals
[[nodiscard]] RubberPart rubber_part(const mesh::Mesh& mesh,
                                     std::span<const fem::Material> materials);

}  // namespace rondo::dynamics
