// SPDX-License-Identifier: BSD-3-Clause
/// @file  solver.contact_mass: takes the mass from the contact nodes of a model (docs/theory.md,
/// 3.10), or says why it cannot.
#pragma once
#include <string>

#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Model::mass and lumped_mass as solver.contact_mass says; a warning where the outermost layer is
/// thin. @pre mesh, mass, free, bodies and contact of the model are there
/// @throws InputError: a body that nothing holds, a contact node that nothing takes the mass of, a
/// pressure on contact nodes
void make_contact_massless(const Case& c, Setup& s);

/// @throws InputError: parts of the contact boundary could move without strain
/// @pre the stiffness is there
void demand_held_ring(const Case& c, const dynamics::Model& model);

/// "lumped", "singular", "singular-kept".
const char* contact_mass_name(const Case& c) noexcept;

/// The critical step as `rondo check` tells it: where contact nodes have no mass, with what it
/// would be if they had.
std::string told_critical_step(const Setup& s);

}  // namespace rondo::study
