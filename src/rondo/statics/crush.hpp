// SPDX-License-Identifier: BSD-3-Clause
/// @file  A body on a rigid rim, pressed without turning onto flat rigid ground and drawn along it,
/// quasi-static:
/// K u = Hᵀ r under Signorini's law on gaps and Coulomb's on increments of slip (docs/theory.md,
/// 6.4). Contact frame: n = (0, 1), t = J n = (-1, 0).
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/core/sum.hpp"
#include "rondo/statics/condensation.hpp"
#include "rondo/statics/condensed_contact.hpp"

namespace rondo::statics {

/// H u of a node: the components of u along n and t.
[[nodiscard]] inline Vec2 in_contact_frame(Vec2 u) noexcept {
  return {u.y, -u.x};
}

/// Fixed while the body is moved.
struct CrushModel {
  std::vector<int> nodes;         ///< (nb) candidates
  std::vector<double> clearance;  ///< (nb) gap of the undeformed body at first touch, >= 0  [m]
  std::vector<Vec2> reference;    ///< (nb) place of the undeformed body, from the center    [m]
  contact::Friction friction;     ///< no function of the slip speed: a crush has no time
  /// (nb) length of the undeformed boundary that belongs to a candidate, which its pressure is
  /// over; empty: friction is constant [m]
  std::vector<double> extent;
  CondensedLimits limits;
  double bound = 1e-10;  ///< of the final residual, computed from the whole field          [-]
};

/// Clearances over ground that touches the lowest candidate.
/// @param reference (n) [m], nodes (nb) candidates, not empty
CrushModel make_crush_model(std::span<const Vec2> reference, std::span<const int> nodes,
                            contact::Friction friction);

/// Works since first touch, (6.4e).                                                      [J/m]
struct CrushWorks {
  double strain = 0.0;     ///< stored: ½ uᵀ K u, computed apart from the works
  double internal = 0.0;   ///< done against the forces of the body: of a linear one `strain`
  double contact = 0.0;    ///< of the ground on the body, in u
  double rim = 0.0;        ///< of the rim by both its travels
  double friction = 0.0;   ///< dissipated
  double impact = 0.0;     ///< the rest: gaps that close or open within an increment
  double residual = 0.0;   ///< internal - contact
  double exchanged = 0.0;  ///< largest strain + |contact| so far
  double relative = 0.0;   ///< largest |residual| / exchanged so far [-]
};

/// After an increment.
struct CrushState {
  double depth = 0.0;                   ///< of the center below first touch               [m]
  double slide = 0.0;                   ///< of the center along +x since first touch      [m]
  std::vector<Vec2> u;                  ///< (n) displacement, fixed axes                  [m]
  std::vector<Vec2> force;              ///< (nb) normal, tangential                       [N/m]
  std::vector<Vec2> slip;               ///< (nb) gap, increment of slip                   [m]
  std::vector<contact::Status> status;  ///< (nb)
  CrushWorks works;
  std::array<CompensatedSum, 3> sums;  ///< of rim, friction, impact: for the next increment
};

/// An equilibrium of a linear body: what the next state is made of.
struct CrushEquilibrium {
  double depth = 0.0;                   ///< [m]
  double slide = 0.0;                   ///< [m]
  std::vector<Vec2> u;                  ///< (n) [m]
  std::vector<Vec2> force;              ///< (nb) normal, tangential [N/m]
  std::vector<contact::Status> status;  ///< (nb)
  double strain = 0.0;                  ///< ½ uᵀ K u [J/m]
};

/// μ of some candidates in an increment from a state on: that of their pressure and place in it.
/// The slip speed counts as 0. @param set candidates
/// @pre the model has extents, unless friction is constant
[[nodiscard]] CandidateFriction friction_from(const CrushModel& model, const CrushState& state,
                                              std::span<const std::size_t> set);

/// The state that follows, its works by mean forces of the increment (6.4e).
[[nodiscard]] CrushState next_state(const CrushModel& model, const CrushState& before,
                                    CrushEquilibrium found);

/// Adds the works of the increment between two states by mean forces (6.4e). @pre the energies of
/// the later one, and `internal`, are there
void add_works(const CrushModel& model, const CrushState& before, CrushState& after);

/// At first touch: all zero.
CrushState start_crush(const CrushModel& model, std::size_t n_nodes);

/// Outcome of one increment.
struct CrushReport {
  bool converged = false;  ///< residual within the model's bound; else the state is as it was
  double residual = 0.0;   ///< of the law, from the whole field (6.4d)                   [-]
  double equilibrium = 0.0;  ///< ‖K u - Hᵀ r‖ / ‖Hᵀ r‖                                      [-]
  double penetration = 0.0;  ///< largest -gap of all candidates, >= 0                      [m]
  int sweeps = 0;            ///< of all solves of the increment
  int pivots = 0;            ///< likewise
  Pivoting pivoting = Pivoting::none;  ///< of the last solve that needed it
  std::size_t appended = 0;            ///< candidates that had to be added to the set
};

/// Adds the candidates to the set whose clearance is at most `reach` [m]; how many.
std::size_t append_within(const CrushModel& model, double reach, Condensation& body);

/// Brings the center to `depth` below first touch and `slide` along +x [m] in one increment.
[[nodiscard]] CrushReport bring_to(const CrushModel& model, double depth, double slide,
                                   Condensation& body, CrushState& state);

}  // namespace rondo::statics
