// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact nodes without mass, the ring (docs/theory.md, 3.10): where they are at t_{n+2} by
/// the stiffness around them and the contact law on gaps. Both the general and the sparse step
/// use it: what it takes and gives are plain fields. Source: massless boundaries of Khenous,
/// Laborde, Renard, Eur. J. Mech. A 27 (2008) 918; in the step of CD-Lagrange.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "rondo/contact/coupled/coupled_contacts.hpp"
#include "rondo/integrators/massless/ring_matrix.hpp"
#include "rondo/model/contact_node.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// A contact of the ring.
struct RingContact {
  int node = 0;      ///< place in the ring, that is among the candidates
  Vec2 normal;       ///< normal of the ground at the predicted place, fixed frame
  double gap = 0.0;  ///< along it                                                     [m]
  Vec2 free;         ///< (gap, way along t)/Δt without forces of contact              [m/s]
  Vec2 impulse;      ///< Δt λ: of the ground on the node, (normal, tangential)        [N·s/m]
  double friction = 0.0;  ///< μ of the law in the solution at hand; not kept
  double residual = 0.0;  ///< residual of the law, over the node's scale of mass           [m/s]
  contact::Status status = contact::Status::open;
};

/// Contacts at one time, and how they were found.
struct RingContacts {
  std::vector<RingContact> contacts;  ///< by node, ascending
  int iterations = 0;                 ///< iterations of the contact solver
  int extensions = 0;                 ///< times that nodes joined, and all was solved again
  bool converged = true;              ///< the law holds to 1e-12 every time
  bool two_facets = false;  ///< a node is held by two facets, or about to be: not done here
};

/// A node that is held at this place, and has come this way in a step, may be held by a second
/// facet.
/// @param way >= 0                                                                      [m]
[[nodiscard]] bool near_second_facet(const contact::Ground& ground, Vec2 place,
                                     double way) noexcept;

/// The motion of the ring and its surroundings that a step knows, co-rotating frame.
struct RingMotion {
  std::vector<Vec2> place;  ///< (nc + ni) u_{n+1} of the ring, then u_{n+2} of its neighbours [m]
  std::vector<Vec2> rate;   ///< (ni) v_{n+3/2} of the neighbours                              [m/s]
  std::vector<Vec2> before;  ///< (nc) v_{n+1/2} of the ring                                   [m/s]
};

class MasslessContact {
 public:
  /// @pre contact, lumped_mass and the assembled stiffness are there; K_cc is positive definite.
  explicit MasslessContact(const Model& model);

  /// Node numbers of the ring (nc), and of its neighbours (ni).
  [[nodiscard]] std::span<const int> nodes() const noexcept { return matrix_.nodes(); }
  [[nodiscard]] std::span<const int> neighbours() const noexcept { return matrix_.neighbours(); }
  /// To be filled before solve().
  [[nodiscard]] RingMotion& motion() noexcept { return motion_; }

  /// The ring at t_{n+2} (3.10), from motion(); what was next() is now().
  /// @param step of t_{n+1}. Allocates as nodes first come into contact, or more than ever before.
  void solve(const ContactStep& step);
  /// (nc) v_{n+3/2} = (u_{n+2} - u_{n+1})/Δt of the ring, co-rotating frame              [m/s]
  [[nodiscard]] std::span<const Vec2> velocity() const noexcept { return velocity_; }
  /// Takes what another way (RingArc) has found: what was next() is now(), `found` is next().
  void take_over(RingContacts& found) noexcept {
    std::swap(now_, next_);
    std::swap(next_, found);
  }
  /// Then to be filled, at the nodes of now(): motion().place and before, and this.
  [[nodiscard]] std::span<Vec2> velocity() noexcept { return velocity_; }

  /// Works and figures of the contacts at t_{n+1}, once solve() has said where the ring goes.
  /// `active` gets the contacts.
  ContactReport report(const ContactStep& step, Vec2 center,
                       std::vector<ActiveContact>& active) const;

  /// At t_{n+2}: all that a step leaves to the next.
  [[nodiscard]] const RingContacts& next() const noexcept { return next_; }
  [[nodiscard]] const RingContacts& now() const noexcept { return now_; }
  [[nodiscard]] std::vector<double> save() const;
  void restore(std::span<const double> numbers);
  /// Whether `numbers` can be those of save().
  static bool is_saved(std::span<const double> numbers, std::size_t n_candidates) noexcept;

  /// For its difficult problems.
  [[nodiscard]] contact::CoupledContacts& coupled() noexcept { return coupled_; }

 private:
  void load_ring() noexcept;
  void predict();
  void join(int node, const contact::Touch& touch);
  [[nodiscard]] double friction_of(const RingContact& contact) const noexcept;
  void make_problem();
  void solve_law();
  void move_ring(std::span<const RingContact> by, std::span<Vec2> change) noexcept;
  bool extend();
  void finish();
  [[nodiscard]] Vec2 place_after(std::size_t i, Vec2 change) const noexcept;
  [[nodiscard]] Vec2 law_velocity(const RingContact& contact,
                                  std::span<const Vec2> change) const noexcept;

  const Model& model_;
  RingMatrix matrix_;
  const double lag_;  ///< b = β/Δt
  RingMotion motion_;
  const ContactStep* step_ = nullptr;
  Vec2 center_next_;         ///< c_{n+2}                                     [m]
  std::vector<Vec2> star_;   ///< (nc + ni) u_c,n+1; u_i + β v_i              [m]
  std::vector<Vec2> load_;   ///< (nc) - K_c of it                            [N/m]
  std::vector<Vec2> usual_;  ///< (nc) u_{n+1} - u_n                          [m]
  // (nc) u_{n+2} - u_{n+1}, less that: no round-off where nothing changes.
  std::vector<Vec2> free_;       ///< without contact                             [m]
  std::vector<Vec2> predicted_;  ///< with the forces of t_{n+1}                  [m]
  std::vector<Vec2> change_;     ///< with those of t_{n+2}                       [m]
  std::vector<Vec2> velocity_;   ///< (nc)                                        [m/s]
  std::vector<char> joined_;     ///< (nc) node is among the contacts
  RingContacts now_, next_;
  contact::CoupledContacts coupled_;
  std::vector<std::span<const contact::Block>> columns_;  ///< columns of K_cc⁻¹, for the contacts
};

}  // namespace rondo::dynamics
