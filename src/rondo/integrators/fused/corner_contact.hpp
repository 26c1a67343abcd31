// SPDX-License-Identifier: BSD-3-Clause
/// @file  Sharp corners of the ground in the fused steps: the few nodes that a corner holds are
/// left out of a step's own contact and solved after it, all contacts that share nodes together, as
/// the general step does (docs/decisions/026-local-exceptions.md). Where no corner is near, a
/// batch of steps goes on without any of it.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "rondo/integrators/fused/step_context.hpp"
#include "rondo/integrators/general/general_contact.hpp"
#include "rondo/model/pressure.hpp"

namespace rondo::dynamics {

/// Motion of a candidate between two steps, in the co-rotating frame.
struct CandidateMotion {
  Vec2 u;        ///< u_{n+1}                                                         [m]
  Vec2 v;        ///< v_{n+1/2}; with a loaded rim V in the axes of R_n                   [m/s]
  Vec2 force{};  ///< K u_n, with β or a loaded rim                                    [N/m]
  Vec2 moved{};  ///< u_{n+1} - u_n, with a loaded rim                                  [m]
  /// f at u_n, which the last step was made with; with rubber and no loaded rim        [N/m]
  Vec2 internal{};
};

/// Single candidates of a fused integrator, to be seen and changed between two steps.
class CandidateFields {
 public:
  /// @param candidate place in ContactModel::nodes
  [[nodiscard]] virtual CandidateMotion motion_of(std::size_t candidate) const noexcept = 0;
  /// @param u not looked at with a loaded rim, which has not moved yet
  virtual void move(std::size_t candidate, Vec2 v, Vec2 u) noexcept = 0;

 protected:
  ~CandidateFields() = default;
};

class CornerContact {
 public:
  /// @pre has_sharp_corners(model)
  explicit CornerContact(const Model& model);

  /// Before a batch of steps: which corners may touch in it, and which edges. The steps are told
  /// where the held candidates are marked.
  void look_out(std::span<StepContext> steps, const CandidateFields& fields) noexcept;
  [[nodiscard]] bool any_near() const noexcept { return n_near_ > 0; }
  /// After the batch: how far a candidate has come in it, where that is farther than was looked for
  /// and a corner is within it, so that a touch may be missed; else 0                     [m]
  /// @param astray how far the frame was from where it was expected                          [m]
  [[nodiscard]] double unseen(const CandidateFields& fields, double astray) const noexcept;
  /// Candidates that may be held in the batch, and their neighbours.
  [[nodiscard]] std::span<const int> nodes() const noexcept { return nodes_; }

  // Around each step, where corners are near:
  /// Finds what the corners touch, and the candidates that they hold.
  void find(const StepContext& step, const CandidateFields& fields) noexcept;
  /// Impulses on what is held, its velocities and u; sums and contacts of the step.
  void solve(const StepContext& step, CandidateFields& fields, PartialStep& part) noexcept;

  /// Adds the contacts of the last step.
  void save_active(std::vector<ActiveContact>& active) const;
  /// The farthest a candidate is from the center, as last looked for                       [m]
  [[nodiscard]] double farthest() const noexcept { return farthest_; }
  /// See GeneralContact::coupled().
  [[nodiscard]] const contact::CoupledContacts& coupled() const noexcept {
    return contact_.coupled();
  }
  [[nodiscard]] contact::CoupledContacts& coupled() noexcept { return contact_.coupled(); }

 private:
  struct Held {
    std::size_t candidate;
    NodeForces forces;  ///< `elastic` and `change`: K u_n before the step
    Vec2 free{};        ///< v_{n+3/2} without impulse                                [m/s]
  };
  /// How far the boundary may be from where it is during a batch, and from the center [m].
  struct Extent {
    double reach, farthest;
  };
  [[nodiscard]] Extent extent(std::size_t n_steps, const CandidateFields& fields) noexcept;
  void look_at(std::size_t corner, std::span<const StepContext> steps, const Extent& e);
  void add_near(std::size_t corner, const Box& box);
  void set_edge_boxes() noexcept;
  void want(int edge, int layers);
  void release() noexcept;
  [[nodiscard]] Vec2 load_on(const StepContext& step, std::size_t candidate) const noexcept;

  const Model boundary_;  ///< the candidates alone, in their order, on the same ground
  State state_;           ///< state of the candidates; only what is near is kept up
  GeneralContact contact_;
  std::vector<NearCorner> near_;  ///< the first n_near_ count
  std::size_t n_near_ = 0;
  std::vector<Vec2> begin_;      ///< (nb) u where the batch began                           [m]
  std::vector<Box> edge_boxes_;  ///< boxes of the edges there, co-rotating frame         [m]
  double farthest_ = 0.0;        ///< largest distance of a candidate from the center         [m]
  double way_ = 0.0;             ///< way that a candidate may come from there               [m]
  Box around_{};                 ///< box that holds the boundary in the batch, way_ beside it [m]
  std::vector<int> nodes_;       ///< nodes of the near edges and their neighbours
  std::vector<char> wanted_;     ///< (nb) is in nodes_
  std::vector<Held> held_;
  std::vector<char> is_held_;                    ///< (nb)
  std::vector<std::vector<NodalLoad>> load_of_;  ///< (nb), or empty: no loads
};

}  // namespace rondo::dynamics
