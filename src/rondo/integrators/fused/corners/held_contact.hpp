// SPDX-License-Identifier: BSD-3-Clause
/// @file  Sharp corners of the ground in the fused steps: the few nodes that a corner holds are
/// left out of a step's own contact and solved after it, all contacts that share nodes together, as
/// the general step does (docs/decisions/026-local-exceptions.md). Where no corner is near, a
/// batch of steps goes on without any of it.
#pragma once
#include <span>
#include <vector>

#include "rondo/contact/coupled/coupled_contacts.hpp"
#include "rondo/contact/segment.hpp"
#include "rondo/integrators/fused/step_context.hpp"
#include "rondo/integrators/general/near_edges.hpp"

namespace rondo::dynamics {

/// Motion of a candidate between two steps, in the co-rotating frame.
struct CandidateMotion {
  Vec3 u;        ///< u_{n+1}                                                         [m]
  Vec3 v;        ///< v_{n+1/2}; with a loaded rim V in the axes of R_n                   [m/s]
  Vec3 force{};  ///< K u_n, with β or a loaded rim                              [N/m], [N]
  Vec3 moved{};  ///< u_{n+1} - u_n, with a loaded rim                                  [m]
  /// f at u_n, which the last step was made with; with nonlinear forces and no loaded rim
  Vec3 internal{};  ///<                                                         [N/m], [N]
};

/// Single candidates of a fused integrator, to be seen and changed between two steps.
class CandidateFields {
 public:
  /// @param candidate place in ContactModel::nodes
  [[nodiscard]] virtual CandidateMotion motion_of(std::size_t candidate) const noexcept = 0;
  /// @param u not looked at with a loaded rim, which has not moved yet
  virtual void move(std::size_t candidate, Vec3 v, Vec3 u) noexcept = 0;
  /// Force of the pressures in three dimensions, co-rotating frame                        [N]
  [[nodiscard]] virtual Vec3 pressed_by(const StepContext& /*step*/,
                                        std::size_t /*candidate*/) const noexcept {
    return {};
  }

 protected:
  ~CandidateFields() = default;
};

/// What corners hold, in the plane (corner_contact.hpp) and in three dimensions
/// (solid_corner_contact.hpp).
class HeldContact {
 public:
  virtual ~HeldContact() = default;
  HeldContact(const HeldContact&) = delete;
  HeldContact& operator=(const HeldContact&) = delete;

  /// Before a batch of steps: which corners may touch in it, and which edges. The steps are told
  /// where the held candidates are marked. Of the steps only the frames are looked at.
  virtual void look_out(std::span<StepContext> steps, const CandidateFields& fields) noexcept = 0;
  [[nodiscard]] virtual bool any_near() const noexcept = 0;
  /// After the batch: how far a candidate has come in it, where that is farther than was looked for
  /// and a corner is within it, so that a touch may be missed; else 0                     [m]
  /// @param astray how far the frame was from where it was expected                          [m]
  [[nodiscard]] double unseen(const CandidateFields& fields, double astray) const noexcept;
  /// Candidates that may be held in the batch, and their neighbours.
  [[nodiscard]] std::span<const int> nodes() const noexcept { return nodes_; }

  // Around each step, where corners are near:
  /// Finds what the corners touch, and the candidates that they hold.
  virtual void find(const StepContext& step, const CandidateFields& fields) noexcept = 0;
  /// Impulses on what is held, its velocities and u; sums and contacts of the step.
  virtual void solve(const StepContext& step, CandidateFields& fields,
                     PartialStep& part) noexcept = 0;

  /// Adds the contacts of the last step.
  void save_active(std::vector<ActiveContact>& active) const;
  /// The farthest a candidate is from the center, as last looked for                       [m]
  [[nodiscard]] double farthest() const noexcept { return farthest_; }
  /// Impulses that the next step asks for.
  [[nodiscard]] virtual contact::KeptImpulses& kept() noexcept = 0;
  [[nodiscard]] virtual std::vector<contact::ProblemFile> take_difficult() { return {}; }

 protected:
  explicit HeldContact(const Model& model);

  /// All corners are so far that the boundary, as it was looked at last, will not come to them in
  /// this batch: then there is nothing to look at.
  [[nodiscard]] bool is_far(std::span<const StepContext> steps) noexcept;
  /// How far the boundary may be from where it is during a batch [m]. Sets u of the state.
  /// @param touch how deep a touch may be [m]
  [[nodiscard]] double reach_of(std::size_t n_steps, const CandidateFields& fields,
                                double touch) noexcept;
  /// Box of the boundary in the batch. @param reach beside the farthest candidate [m]
  void look_around(std::span<const StepContext> steps, double reach) noexcept;
  /// That box on the first profile of the ground.
  [[nodiscard]] const Box& around() const noexcept { return around_.front(); }
  /// Whether a corner is above or below that box.
  [[nodiscard]] bool is_beside_corner() const noexcept;
  /// The edge's nodes, and those of as many edges beside it, are in nodes().
  void want(const contact::Boundary& boundary, int edge, int layers);
  void forget_nodes() noexcept;
  [[nodiscard]] bool has_corner_around(double wider) const noexcept;
  [[nodiscard]] Vec3 reference_at(std::size_t candidate) const noexcept {
    return {boundary_.reference[candidate],
            boundary_.solid ? boundary_.solid->axial[candidate] : 0.0};
  }

  const Model boundary_;       ///< the candidates alone, in their order, on the same ground
  State state_;                ///< state of the candidates; only what is near is kept up
  std::vector<Vec3> begin_;    ///< (nb) u where the batch began                           [m]
  double farthest_ = 0.0;      ///< largest distance of a candidate from the center         [m]
  double far_ = 0.0;           ///< from the center, in the batches until the next look    [m]
  int batches_left_ = 0;       ///< that need no look where no corner is nearer
  bool looked_ = false;        ///< at the boundary, for this batch
  double way_ = 0.0;           ///< way that a candidate may come from there               [m]
  std::vector<Box> around_;    ///< (profiles) box that holds the boundary in the batch, way_
                               ///< beside it                                              [m]
  double bend_reach_ = 0.0;    ///< largest of the profiles                                 [m]
  std::vector<int> nodes_;     ///< nodes of the near edges and their neighbours
  std::vector<char> wanted_;   ///< (nb) is in nodes_
  std::vector<char> is_held_;  ///< (nb)
};

}  // namespace rondo::dynamics
