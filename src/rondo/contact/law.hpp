// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signorini–Coulomb impact law of one contact, solved in closed form (docs/theory.md, 4.3).
/// Contact frame: x is normal (> 0 separates), y is tangential (t = J n); r acts on the node.
/// Method: Moreau, CMAME 177 (1999) 329; Fekak et al., Comput. Mech. 60 (2017) 1.
#pragma once
#include "rondo/contact/friction.hpp"
#include "rondo/core/complex.hpp"

namespace rondo::contact {

/// Which normal velocity an impact ends with (docs/theory.md, 4.3).
enum class Impact {
  moreau,       ///< w_n = -e w_n⁻, whether the node arrives or leaves
  energy_safe,  ///< like moreau for a node that arrives; a node that leaves returns at most
                ///< as fast. r_n > 0 then means w̄_n <= 0: no impact does work on the body
};

struct Law {
  Friction friction;         ///< gives μ of each contact, where its problem is made
  double restitution = 0.0;  ///< e in [0, 1] [-]
  Impact impact = Impact::moreau;
};

/// ε, which joins w_n in the law (4.3): of either sign                                      [m/s]
/// @param before w_n⁻
/// @param neutral the ε with which r_n does no work: w_n⁻, less what else joins w_n in the law
double restitution_shift(const Law& law, double before, double neutral) noexcept;

enum class Status { open, stick, slip };

/// One contact of one step.
struct LocalProblem {
  Vec2 free;            ///< relative velocity without this contact's impulse            [m/s]
  Complex delassus;     ///< W as a complex number: w = free + W r (4.3a)               [m/kg]
  double bounce = 0.0;  ///< ε of restitution_shift(): added to w_n in the law      [m/s]
};

struct LocalSolution {
  Vec2 impulse;  ///< r = (r_n, r_t) of the ground on the node                      [N·s/m]
  Status status = Status::open;
};

/// 0 <= r_n ⊥ w_n + bounce >= 0; |r_t| <= μ r_n, r_t = -μ r_n w_t/|w_t| where w_t ≠ 0   (4.3)
/// @pre Re W > μ |Im W|: one solution.   @post r_n >= 0, |r_t| <= μ r_n (to round-off).
/// @param friction μ of this contact
LocalSolution solve_local(const LocalProblem& problem, double friction) noexcept;

}  // namespace rondo::contact
