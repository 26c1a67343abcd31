// SPDX-License-Identifier: BSD-3-Clause
/// @file  Sharp corners of the ground in the fused steps of plane bodies (held_contact.hpp).
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "rondo/integrators/fused/corners/held_contact.hpp"
#include "rondo/integrators/general/general_contact.hpp"
#include "rondo/model/pressure.hpp"

namespace rondo::dynamics {

class CornerContact final : public HeldContact {
 public:
  /// @pre has_sharp_corners(model), in the plane
  explicit CornerContact(const Model& model);

  void look_out(std::span<StepContext> steps, const CandidateFields& fields) noexcept override;
  [[nodiscard]] bool any_near() const noexcept override { return n_near_ > 0; }
  void find(const StepContext& step, const CandidateFields& fields) noexcept override;
  void solve(const StepContext& step, CandidateFields& fields, PartialStep& part) noexcept override;
  [[nodiscard]] contact::KeptImpulses& kept() noexcept override { return contact_.coupled().kept; }
  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() override {
    return contact_.coupled().difficult.take();
  }

 private:
  struct Held {
    std::size_t candidate;
    NodeForces forces;  ///< `elastic` and `change`: K u_n before the step
    Vec2 free{};        ///< v_{n+3/2} without impulse                                [m/s]
  };
  void look_at(std::size_t corner, std::span<const StepContext> steps, double reach);
  void add_near(std::size_t corner, const Box& box);
  void set_edge_boxes() noexcept;
  void release() noexcept;
  [[nodiscard]] Vec2 load_on(const StepContext& step, std::size_t candidate) const noexcept;

  GeneralContact contact_;
  std::vector<NearCorner> near_;  ///< the first n_near_ count
  std::size_t n_near_ = 0;
  std::vector<Box> edge_boxes_;  ///< boxes of the edges there, co-rotating frame         [m]
  std::vector<Held> held_;
  std::vector<std::vector<NodalLoad>> load_of_;  ///< (nb), or empty: no loads
};

}  // namespace rondo::dynamics
