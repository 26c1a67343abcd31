// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact nodes without mass round a smooth disk (docs/theory.md, 3.10): the same as
/// MasslessContact, in polar components. All sectors have the same blocks, so that the ring without
/// contact is solved by cyclic reduction; the arc in contact is a block-tridiagonal system, solved
/// by Newton's method on statuses.
#pragma once
#include <optional>
#include <vector>

#include "rondo/contact/coupled/coupled.hpp"
#include "rondo/integrators/implicit/circulant.hpp"
#include "rondo/integrators/implicit/node_fields.hpp"
#include "rondo/integrators/massless/ring_contact.hpp"

namespace rondo::dynamics {

class RingArc {
 public:
  /// @pre fits(model)
  RingArc(const Model& model, RingProduct product);
  /// Each sector has one contact node, and these couple with those beside them alone.
  [[nodiscard]] static bool fits(const Model& model);

  /// Rows of the sector's stiffness around the contact nodes, with mass.
  [[nodiscard]] const std::vector<int>& rows_around() const noexcept { return around_rows_; }

  /// u_{n+2} + β v_{n+3/2} of the rows around, to be filled before solve(): x of each, then y of
  /// each                                                                               [m]
  [[nodiscard]] RingRows& around() noexcept { return around_; }

  /// Places of the contact nodes at t_{n+2}, and their contacts there.
  struct Solution {
    PlaneField& place;       ///< (N or more) u_{n+2} of the contact nodes               [m]
    RingContacts& contacts;  ///< at t_{n+2}
  };
  /// @param place (N or more) u_{n+1} of the contact nodes [m]; `now`: contacts at t_{n+1}. False:
  /// the arc is too long or its statuses do not settle, and nothing is solved
  [[nodiscard]] bool solve(const ContactStep& step, const PlaneField& place,
                           const RingContacts& now, Solution solution);

 private:
  using Block = contact::Block;
  /// Gaps above this are closed to round-off                                       [m]
  static constexpr double closed = -1e-14;
  /// A sector of the arc; vectors in polar components.
  struct Node {
    Vec2 normal, tangent;
    Vec2 touched;       ///< normal, fixed frame
    double gap = 0.0;   ///< at the predicted place                                 [m]
    double way = 0.0;   ///< along the tangent to there, from t_{n+1}                [m]
    Vec2 force_before;  ///< λ of t_{n+1}, that the prediction has                  [N/m]
    Vec2 force;         ///< λ of t_{n+2}                                           [N/m]
    Vec2 change;        ///< from the predicted place                               [m]
    Vec2 free;          ///< change where nothing presses                          [m]
    contact::Status status = contact::Status::open;
    double side = 0.0;  ///< side of slip: λ_t = side μ λ_n
  };
  /// One step of Thomas' algorithm: change = solution - next · change of the next node.
  struct Eliminated {
    Block next;
    Vec2 solution;
  };

  void read_blocks(const Model& model);
  void predict(const ContactStep& step, const RingContacts& now);
  [[nodiscard]] bool find_candidates(const ContactStep& step, const RingContacts& now);
  [[nodiscard]] bool cut_arc();
  void set_nodes(const ContactStep& step, const RingContacts& now);
  [[nodiscard]] bool is_finite() const noexcept;
  [[nodiscard]] bool settle(double friction);
  void eliminate(double friction);
  void find_free();
  void find_forces();
  static void judge(Node& node, double friction) noexcept;
  [[nodiscard]] bool update_statuses(double friction, bool all) noexcept;
  [[nodiscard]] contact::Touch touch_of(const ContactStep& step, std::size_t j) const noexcept;
  [[nodiscard]] bool leave_arc(const ContactStep& step);
  [[nodiscard]] bool move_on(const ContactStep& step, std::size_t from, int by,
                             const Block& propagator);
  void give(const ContactStep& step, RingContacts& next) const;
  [[nodiscard]] std::size_t sector(std::size_t i) const noexcept { return (first_ + i) % n_; }
  [[nodiscard]] Vec2 position(const ContactStep& step, std::size_t j) const noexcept;
  [[nodiscard]] Block here_of(std::size_t i) const noexcept;

  const Model& model_;
  std::size_t n_;  ///< sectors
  int row_ = 0;
  std::vector<int> around_rows_;
  double lag_;  ///< b = β/Δt
  bool has_concave_corners_;
  Vec2 reference_;                   ///< X of every sector                                 [m]
  std::vector<int> candidate_;       ///< (N) candidate of each sector
  std::vector<int> sector_of_;       ///< (nb) the reverse
  Block left_{}, here_{}, right_{};  ///< blocks of K_cc                                 [N/m²]
  Block forward_{}, backward_{};     ///< change of a node from that before, after it, without force
  int reach_ = 0;                    ///< nodes after which such a change is below round-off
  std::optional<Circulant> ring_;
  Circulant::Matrix around_left_, around_here_, around_right_;  ///< blocks of -K_ci      [N/m²]
  RingProduct product_;
  const PlaneField* place_ = nullptr;  ///< places of the step in hand
  PlaneField* next_ = nullptr;
  PlaneField predicted_;
  std::vector<double> height_;         ///< (N) of the predicted places               [m]
  std::vector<contact::Touch> touch_;  ///< (N) there, of candidates that the ground touches
  RingRows around_, load_;
  std::vector<int> candidates_;     ///< sectors, ascending
  std::vector<char> is_candidate_;  ///< (N) 1: in candidates_; 2: and touch_ is known
  std::size_t first_ = 0;           ///< sector where the arc begins
  std::vector<Node> arc_;
  std::vector<Eliminated> eliminated_;
  std::vector<contact::Status> statuses_;
  int iterations_ = 0;
};

}  // namespace rondo::dynamics
