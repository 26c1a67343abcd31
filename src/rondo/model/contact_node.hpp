// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of one candidate in one step: the relative velocity that enters the law, the
/// impulse, and the velocity corrected by it (docs/theory.md, section 4). Every integrator solves
/// its contacts with these functions.
#pragma once
#include <array>
#include <span>

#include "rondo/model/ledger.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Result of the contacts of a step. Sums are over the active contacts.
struct ContactReport {
  /// Impulse of the ground on the body: x and y of the fixed frame, in three dimensions (t1, n, t2)
  /// of ground_frame.hpp                                                          [N·s/m], [N·s]
  Vec3 impulse;
  double angular_impulse = 0.0;  ///< about the center, or the axle              [N·s], [N·m·s]
  // Used in three dimensions only:
  double moment_aligning = 0.0;     ///< about n                                       [N·m·s]
  double moment_overturning = 0.0;  ///< about t1 through the ground below the center [N·m·s]
  int nodes = 0;                    ///< candidates with r_n > 0
  int sticking = 0;                 ///< of these, those that stick
  int pairs = 0;                    ///< nodes that touch two facets
  int pairs_not_converged = 0;      ///< of these, those where no case met the law to 1e-12
  int clusters = 0;                 ///< groups of two or more contacts that share nodes
  int clusters_not_converged = 0;
  int cluster_largest = 0;     ///< number of contacts of the largest cluster
  int cluster_iterations = 0;  ///< largest number of one cluster
  int extensions = 0;          ///< of a massless boundary: how often nodes were added
  bool two_facets = false;     ///< massless boundary: a node touches two facets (not supported)
  int between_bodies = 0;      ///< nodes in contact with a segment of a body
  double length = 0.0;         ///< Σ tributary lengths of nodes with r_n > 0 [m]; areas [m²]
  double penetration = 0.0;    ///< largest -gap of an active contact, >= 0             [m]
  double free_velocity = 0.0;  ///< largest |w_free|                                    [m/s]
  double residual = 0.0;       ///< largest law residual over the node's mass           [m/s]
  /// Distance that a node moved in the last steps, if it exceeds the range around the node in which
  /// sharp corners were searched, so that a contact may be missed [m]. 0: none does
  double unseen = 0.0;
  /// Depth of a contact that already existed one step before but was not found then; 0: there is
  /// none                                                                                [m]
  double late = 0.0;
  Vec2 late_at;  ///< position of that contact, fixed frame                                 [m]
  // Works of the impulses (5.3), (5.5) [J/m].
  double work = 0.0;
  double dissipation_friction = 0.0;
  double loss_impact = 0.0;
  double work_rim = 0.0;

  /// Adds the result of another part of the body in the same step.
  void add(const ContactReport& other) noexcept;
  /// Counts a node that at least one of its contacts presses; it sticks if all of these stick.
  /// @param tributary length or area of the node                              [m], [m²]
  void count(std::span<const ActiveContact> contacts, double tributary) noexcept;
};

/// Puts together what a candidate feels, in the order of the candidates; what is of one keeps its
/// order. By insertion, which takes no memory: what comes is nearly sorted, and short.
void sort_by_candidate(std::vector<ActiveContact>& active) noexcept;

/// Copies the works of a step's impulses.
inline void set_contact_works(const ContactReport& report, Works& works) noexcept {
  works.contact = report.work;
  works.dissipation_friction = report.dissipation_friction;
  works.loss_impact = report.loss_impact;
  works.rim = report.work_rim;
}

/// With a loaded rim, only friction and impacts lie between the ground's impulses and their effect
/// (10.5): no work of the rim remains, not even as round-off.
inline void add_contact_works(const ContactReport& report, Works& works) noexcept {
  works.dissipation_friction = report.dissipation_friction;
  works.loss_impact = report.loss_impact;
  works.contact = -report.dissipation_friction - report.loss_impact;
}

/// Data that all contacts of one step share.
struct ContactStep {
  ContactStep(const Model& model, const FrameStep& frame, const VelocityUpdate& update) noexcept;
  /// For absolute velocities in the axes of the co-rotating frame (10.4): w is the velocity itself.
  ContactStep(const Model& model, const FrameStep& frame) noexcept;

  Complex rotation;         ///< R(θ_{n+1})
  Complex rotation_next;    ///< R(θ_{n+2})
  Complex turn;             ///< e^{iΔθ}
  Complex turn_minus_one;   ///< e^{iΔθ} - 1
  Complex turn_back;        ///< e^{-iΔθ⁻} - 1
  Vec2 center;              ///< c_{n+1}                                               [m]
  Vec2 center_rate;         ///< (c_{n+2} - c_{n+1})/Δt                                [m/s]
  Vec2 center_rate_before;  ///< (c_{n+1} - c_n)/Δt                                    [m/s]
  Complex a;                ///< factor of the velocity update (3.5)
  double dt;                ///< [s]
  const contact::Law* law;  ///< of the ground; outlives the step
};

/// A candidate at t_{n+1}; vectors are in the co-rotating frame.
struct ContactNode {
  std::size_t candidate = 0;  ///< index in ContactModel::nodes
  double mass = 0.0;          ///< [kg/m]
  double tributary = 0.0;     ///< [m]
  Vec2 arm;                   ///< X + u_{n+1}                                        [m]
  Vec2 before;                ///< v_{n+1/2}                                          [m/s]
  Vec2 free;                  ///< v_{n+3/2} without contact impulse                  [m/s]
  /// r_n/(Δt ℓ) of each of its contacts in the step before, which a friction law that is no
  /// constant may need                                                               [Pa]
  std::array<double, 2> pressure{};
};

/// Velocity of the next step without v⁺: b of (4.2), fixed frame [m/s]. @param arm X + u_{n+1} [m]
[[nodiscard]] Vec2 drive_of(const ContactStep& step, Vec2 arm) noexcept;

/// (x_{n+1} - x_n)/Δt (4.2a), fixed frame [m/s]. @param before v_{n+1/2}, co-rotating frame [m/s]
[[nodiscard]] Vec2 velocity_before(const ContactStep& step, Vec2 arm, Vec2 before) noexcept;

/// Solves the contacts of a node, one per touch, writes them into `contacts` (equally many), adds
/// them to the report, and returns v_{n+3/2}. @pre touches.count is 1 or 2. Allocates nothing.
[[nodiscard]] Vec2 solve_contacts(const ContactStep& step, const ContactNode& node,
                                  const contact::Touches& touches,
                                  std::span<ActiveContact> contacts,
                                  ContactReport& report) noexcept;

/// Evaluates the impulses of a node's contacts, whatever solver found them: velocities w⁺, works
/// and the rest of the report. @param node its mass is the scale of the residual
/// @param after v_{n+3/2}, co-rotating frame
void report_contacts(const ContactStep& step, const ContactNode& node, Vec2 after,
                     std::span<ActiveContact> contacts, ContactReport& report) noexcept;

}  // namespace rondo::dynamics
