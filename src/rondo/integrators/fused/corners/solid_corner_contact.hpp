// SPDX-License-Identifier: BSD-3-Clause
/// @file  Sharp corners of the ground in the fused steps of wheels in three dimensions
/// (held_contact.hpp): lines across the way, which touch the edges around the wheel
/// (integrators/solid/corner_finder.hpp).
#pragma once
#include <span>
#include <vector>

#include "rondo/integrators/fused/corners/held_contact.hpp"
#include "rondo/integrators/solid/corner_solver.hpp"

namespace rondo::dynamics {

class SolidCornerContact final : public HeldContact {
 public:
  /// @pre has_sharp_corners(model), in three dimensions
  explicit SolidCornerContact(const Model& model);

  void look_out(std::span<StepContext> steps, const CandidateFields& fields) noexcept override;
  [[nodiscard]] bool any_near() const noexcept override { return !near_.empty(); }
  void find(const StepContext& step, const CandidateFields& fields) noexcept override;
  void solve(const StepContext& step, CandidateFields& fields, PartialStep& part) noexcept override;
  [[nodiscard]] contact::KeptImpulses& kept() noexcept override { return kept_; }

 private:
  struct Held {
    std::size_t candidate;
    NodeForcesOf<Vec3> forces;  ///< `elastic` and `change`: K u_n before the step
    Vec3 free{};                ///< v_{n+3/2} without impulse                        [m/s]
  };
  [[nodiscard]] double travel(std::span<const StepContext> steps) const noexcept;
  [[nodiscard]] Vec3 place_of(const FrameStep& frame, std::size_t candidate) const noexcept;
  void hold(const StepContext& step, const CandidateFields& fields, std::size_t candidate);
  void release() noexcept;
  void keep_impulses();

  CornerSolver solver_;
  const GroundFrame ground_;
  std::vector<CornerFinder::Near> near_;
  std::vector<Held> held_;
  contact::KeptImpulses kept_;  ///< of the last step, ascending
};

}  // namespace rondo::dynamics
